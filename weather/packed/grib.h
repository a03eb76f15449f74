#ifndef PETRICHOR_WEATHER_PACKED_GRIB_H
#define PETRICHOR_WEATHER_PACKED_GRIB_H

#include <cstddef>
#include <span>

#include "weather/packed/point_series.h"

namespace petrichor::weather::packed {

bool is_grib(std::span<const std::byte> bytes);

/// Makes the library read its tables, which it otherwise does when a message first needs them:
/// later no file can be opened.
void load_grib_tables();

/// Reads one point of all messages of a GRIB file (editions 1 and 2) in memory: fields at the
/// ground, 2 m and 10 m, one series a parameter, over their valid times.
///   throws  Error for what is missing or not understood
PointSeries read_grib(std::span<const std::byte> bytes, const Point& point);

}  // namespace petrichor::weather::packed

#endif
