#include "weather/filling/fill_precipitation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace petrichor::weather {

namespace {

// A sky from which it may well fall. Humidity alone must be higher where the sight is not known.
bool sky_for_precipitation(const ForcingTable& table, std::size_t row)
{
    const auto& sight = table[Field::Visibility];
    const bool sight_known = !sight.empty() && !std::isnan(sight[row]) && sight[row] < 700.0e3;
    return table[Field::Cloud][row] >= 0.95 &&
           table[Field::RelHumidity][row] >= (sight_known ? 85.0 : 92.0) &&
           (!sight_known || sight[row] < 16.0e3);
}

}  // namespace

std::vector<bool> known_precipitation(const ForcingTable& table)
{
    std::vector<bool> known(table.rows(), false);
    for (std::size_t i = 0; i < known.size(); ++i) {
        for (const Field f : {Field::Precip, Field::Rain, Field::Snow}) {
            if (table.has(f) && !std::isnan(table[f][i])) known[i] = true;
        }
    }
    return known;
}

void fill_precipitation(ForcingTable& table, ReadReport& report)
{
    const std::size_t n = table.rows();
    auto& total = table[Field::Precip];
    const auto& rain = table[Field::Rain];
    const auto& snow = table[Field::Snow];
    if (!rain.empty() || !snow.empty()) {
        total.resize(n, kMissing);
        std::size_t summed = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const double sum = (rain.empty() ? 0.0 : rain[i]) + (snow.empty() ? 0.0 : snow[i]);
            if (std::isnan(total[i])) {
                total[i] = sum;
                ++summed;
            }
        }
        note_filled(report, field_info(Field::Precip).name, summed, "rain plus snow");
    } else if (total.empty()) {
        total.assign(n, 0.0);
        note_filled(report, field_info(Field::Precip).name, n,
                    "no precipitation in the file, taken as 0");
    }
}

void estimate_precipitation(ForcingTable& table, ReadReport& report, const std::vector<bool>& known)
{
    auto& precip = table[Field::Precip];
    double fallen = 0.0;
    std::size_t skies = 0, filled = 0;
    for (std::size_t i = 0; i < precip.size(); ++i) {
        if (!known[i]) continue;
        fallen += precip[i];
        skies += sky_for_precipitation(table, i);
    }
    const bool from_file = skies >= 10 && fallen > 0.0;
    const double rate = from_file ? fallen / static_cast<double>(skies) : 0.5 / 3600.0;
    for (std::size_t i = 0; i < precip.size(); ++i) {
        if (known[i] || !sky_for_precipitation(table, i)) continue;
        precip[i] = rate;
        ++filled;
    }
    char how[160];
    std::snprintf(how, sizeof how,
                  "of these, estimated as %.2f mm/h under overcast, humid, hazy sky%s",
                  rate * 3600.0, from_file ? ", the rate of the rows with an amount" : "");
    note_filled(report, field_info(Field::Precip).name, filled, how);
}

void warn_of_dry_gaps(ReadReport& report, const std::vector<bool>& known, bool estimated)
{
    // Amounts of the past leave the last row open: nothing falls after the end.
    if (known.size() < 2) return;
    const auto unknown =
        static_cast<std::size_t>(std::count(known.begin(), known.end() - 1, false));
    if (unknown == 0) return;
    report.add({ReadNote::Kind::Warning, 0, "precipitation",
                std::to_string(unknown) + " of " + std::to_string(known.size()) +
                    " rows have no amount in the file: " +
                    (estimated ? "estimated from cloud, humidity and sight" : "taken as dry")});
}

}  // namespace petrichor::weather
