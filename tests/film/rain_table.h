// Weather files for tests: an overcast day, so much rain.
#ifndef PETRICHOR_TESTS_FILM_RAIN_TABLE_H
#define PETRICHOR_TESTS_FILM_RAIN_TABLE_H

#include <cstddef>
#include <cstdint>
#include <limits>

#include "weather/forcing/forcing.h"
#include "weather/physics/constants.h"

namespace petrichor::film {

/// Hourly rows at 12 C under cloud: rain of mm_h in the first `rainy` hours, then none and `later_c`.
inline weather::ForcingTable rain_table(
    std::size_t hours, double mm_h, double wind_m_s, double from_deg,
    std::size_t rainy = std::numeric_limits<std::size_t>::max(), double later_c = 12.0)
{
    weather::ForcingTable t;
    t.site = {46.0, 8.0, 600.0};
    for (std::size_t i = 0; i < hours; ++i) {
        t.time_us.push_back(1431000000LL * 1000000 + static_cast<std::int64_t>(i) * 3600000000LL);
        t[weather::Field::AirTemp].push_back(weather::kZeroCelsiusK + (i < rainy ? 12.0 : later_c));
        t[weather::Field::RelHumidity].push_back(90);
        t[weather::Field::Wind].push_back(wind_m_s);
        t[weather::Field::WindFrom].push_back(from_deg);
        t[weather::Field::Precip].push_back(i < rainy ? mm_h / 3600.0 : 0.0);
        t[weather::Field::Cloud].push_back(1);
    }
    weather::ReadReport report;
    weather::fill_forcing(t, report);
    return t;
}

}  // namespace petrichor::film

#endif
