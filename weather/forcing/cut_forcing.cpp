#include "weather/forcing/cut_forcing.h"

#include <algorithm>
#include <cassert>

namespace petrichor::weather {

ForcingTable cut_forcing(const ForcingTable& table, std::int64_t begin_us, std::int64_t end_us)
{
    assert(begin_us < end_us);
    const auto& t = table.time_us;
    const auto first = std::upper_bound(t.begin(), t.end(), begin_us) - t.begin();
    const auto last = std::lower_bound(t.begin() + first, t.end(), end_us) - t.begin();
    ForcingTable cut;
    cut.site = table.site;
    cut.time_us.push_back(begin_us);
    cut.time_us.insert(cut.time_us.end(), t.begin() + first, t.begin() + last);
    cut.time_us.push_back(end_us);
    const auto at = [&](Field field, std::int64_t time_us) {
        if (!field_info(field).is_rate) return value_at(table, field, time_us);
        const auto next = std::upper_bound(t.begin(), t.end(), time_us) - t.begin();
        return next > 0 ? table[field][static_cast<std::size_t>(next - 1)] : 0.0;
    };
    for (std::size_t f = 0; f < kFieldCount; ++f) {
        const auto field = static_cast<Field>(f);
        if (!table.has(field)) continue;
        const auto& from = table[field];
        cut[field].push_back(at(field, begin_us));
        cut[field].insert(cut[field].end(), from.begin() + first, from.begin() + last);
        cut[field].push_back(at(field, end_us));
    }
    return cut;
}

}  // namespace petrichor::weather
