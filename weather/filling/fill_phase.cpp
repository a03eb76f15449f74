#include "weather/filling/fill_phase.h"

#include <cmath>

namespace petrichor::weather {

void phase_from_depth(ForcingTable& table, ReadReport& report)
{
    if (!table.has(Field::SnowDepth) || !table.has(Field::Precip) || table.has(Field::Rain) ||
        table.has(Field::Snow))
        return;
    constexpr std::int64_t kDay_us = 86400LL * 1000000;
    constexpr double kRise_m = 0.0099;     // depths are often given in whole centimetres
    constexpr double kWarmest_k = 277.15;  // wet snow falls up to about 4 C
    const auto& depth = table[Field::SnowDepth];
    const auto& air = table[Field::AirTemp];
    auto& share = table[Field::SnowShare];
    share.resize(table.rows(), kMissing);
    std::size_t last = 0, told = 0;
    bool have_last = false;
    for (std::size_t i = 0; i < depth.size(); ++i) {
        if (std::isnan(depth[i])) continue;
        const bool rose = have_last && depth[i] - depth[last] >= kRise_m &&
                          table.time_us[i] - table.time_us[last] <= kDay_us;
        for (std::size_t k = last; rose && k < i; ++k) {
            const double fell = table[Field::Precip][k];
            const bool cold = air.empty() || std::isnan(air[k]) || air[k] < kWarmest_k;
            if (std::isnan(fell) || fell <= 0.0 || !cold || !std::isnan(share[k])) continue;
            share[k] = 1.0;
            ++told;
        }
        last = i;
        have_last = true;
    }
    note_filled(report, field_info(Field::SnowShare).name, told,
                "snow, as the observed depth rose");
}

}  // namespace petrichor::weather
