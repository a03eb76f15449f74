#ifndef PETRICHOR_WEATHER_READERS_DAYS_H
#define PETRICHOR_WEATHER_READERS_DAYS_H

#include <cstddef>
#include <cstdint>
#include <map>

#include "weather/readers/collector.h"

namespace petrichor::weather {

/// What a file of days knows of one of them.
struct DayOfWeather {
    double low_c = kMissing, high_c = kMissing, mean_c = kMissing, precip_mm = kMissing,
           wind_m_s = kMissing, depth_m = kMissing, dew_c = kMissing, pressure_pa = kMissing,
           visibility_m = kMissing;
    double snow_share = kMissing;  ///< of the precipitation, 0..1
    std::size_t line = 0;
};
/// By their beginnings, microseconds since 1970 on the clock of the place.
using DaysOfWeather = std::map<std::int64_t, DayOfWeather>;

/// Makes eight rows of each day, and says so: temperature swings between its minimum at 6 and its
/// maximum at 15 o'clock of a clock `zone_h` ahead of UTC, the rest is spread evenly.
void put_days(const DaysOfWeather& days, double zone_h, RowCollector& rows);

}  // namespace petrichor::weather

#endif
