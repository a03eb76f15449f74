// Col de Porte: forcing and observations of two winters, and the scores of a run against them.
#ifndef PETRICHOR_TESTS_WEATHER_WINTERS_H
#define PETRICHOR_TESTS_WEATHER_WINTERS_H

#include <cmath>
#include <string>
#include <vector>

#include "tests/weather/reading.h"
#include "weather/models/physical/physical.h"
#include "weather/readers/read_weather.h"
#include "weather/readers/text.h"

namespace petrichor::weather::testing_winters {

using testing_reading::asset;

// NaN where nothing was observed.
struct Observation {
    std::int64_t day_us = 0;
    double albedo = kMissing, depth_m = kMissing, swe_kg_m2 = kMissing, surface_c = kMissing;
};
struct Winter {
    ForcingTable table;
    std::vector<Observation> observations;
};
struct Scores {
    double depth_m = 0, swe_kg_m2 = 0, surface_k = 0, albedo = 0, peak_swe = 0;
};

inline ReadOptions col_de_porte()
{
    ReadOptions options;
    options.site.latitude_deg = 45.30;
    options.site.longitude_deg = 5.77;
    options.site.elevation_m = 1325;
    options.site.temp_height_m = 1.5;
    options.site.wind_height_m = 10;
    options.heights_given = true;
    return options;
}
inline PhysicalParams meadow()
{
    PhysicalParams params;
    params.surface = surface_preset("grass");
    return params;
}

inline Winter winter_2005()
{
    Winter w;
    w.table = read_weather(asset("met_CdP_0506.txt"), col_de_porte()).table;
    const std::string text = asset("obs_CdP_0506.txt");
    Lines lines(text);
    while (const auto line = lines.next()) {
        const auto f = words(*line);
        if (f.size() != 9) continue;
        const auto value = [&](std::size_t i) {
            const double v = *to_number(f[i]);
            return v <= -99 ? kMissing : v;
        };
        w.observations.push_back(
            {days_from_civil(*to_integer(f[0]), static_cast<int>(*to_integer(f[1])),
                             static_cast<int>(*to_integer(f[2]))) *
                 86400000000LL,
             value(3), value(5), value(6), value(7)});
    }
    return w;
}
inline Winter winter_2001()
{
    Winter w;
    w.table = read_weather(asset("col_de_porte_2001_02_met_hourly.csv"), col_de_porte()).table;
    const std::string text = asset("col_de_porte_2001_02_obs_daily.csv");
    Lines lines(text);
    while (const auto line = lines.next()) {
        const auto f = split(*line, ',');
        const auto day = us_from_iso(f[0]);
        if (!day || f.size() != 3) continue;
        w.observations.push_back({*day, kMissing, to_number(f[1]).value_or(kMissing),
                                  to_number(f[2]).value_or(kMissing), kMissing});
    }
    return w;
}

// Depth and SWE at 12 h; surface temperature and albedo as daily means where snow lies deeper than
// 0.1 m.
inline Scores score(const Winter& winter, const PhysicalParams& params)
{
    const PhysicalTimeline timeline(winter.table, params);
    constexpr std::int64_t kHour = 3600000000LL;
    const auto states = timeline.series(timeline.begin_us(), timeline.end_us(), kHour);
    const auto index = [&](std::int64_t us) { return (us - timeline.begin_us()) / kHour; };
    const auto count = static_cast<std::int64_t>(states.size());
    double sums[4] = {}, numbers[4] = {};
    const auto add = [&](int i, double error) {
        sums[i] += error * error;
        numbers[i] += 1;
    };
    Scores s;
    for (const CellState& c : states) s.peak_swe = std::max(s.peak_swe, diagnostics(c).swe_kg_m2);
    for (const Observation& o : winter.observations) {
        const std::int64_t noon = index(o.day_us + 12 * kHour);
        if (noon < 0 || noon >= count) continue;
        const auto d = diagnostics(states[static_cast<std::size_t>(noon)]);
        if (!std::isnan(o.depth_m)) add(0, d.snow_depth_m - o.depth_m);
        if (!std::isnan(o.swe_kg_m2)) add(1, d.swe_kg_m2 - o.swe_kg_m2);
        const std::int64_t first = index(o.day_us);
        if (!(o.depth_m > 0.1) || first < 0 || first + 24 > count) continue;
        double warm = 0, reflected = 0, sun = 0;
        for (std::int64_t i = first; i < first + 24; ++i) {
            const auto& c = states[static_cast<std::size_t>(i)];
            const double sw =
                value_at(winter.table, Field::Shortwave, timeline.begin_us() + i * kHour);
            warm += c.surface_temp_c / 24;
            reflected += sw * c.snow_albedo;
            sun += sw;
        }
        if (!std::isnan(o.surface_c)) add(2, warm - o.surface_c);
        if (!std::isnan(o.albedo) && sun > 0) add(3, reflected / sun - o.albedo);
    }
    double* out[] = {&s.depth_m, &s.swe_kg_m2, &s.surface_k, &s.albedo};
    for (int i = 0; i < 4; ++i) *out[i] = numbers[i] > 0 ? std::sqrt(sums[i] / numbers[i]) : 0;
    return s;
}

}  // namespace petrichor::weather::testing_winters

#endif
