#ifndef PETRICHOR_WEATHER_PACKED_NETCDF_H
#define PETRICHOR_WEATHER_PACKED_NETCDF_H

#include <cstddef>
#include <span>

#include "weather/packed/point_series.h"

namespace petrichor::weather::packed {

/// Whether bytes begin as NetCDF (classic, 64-bit, HDF5) does.
bool is_netcdf(std::span<const std::byte> bytes);

/// Reads one point of a NetCDF file in memory.
///
/// A coordinate of time with CF units ("hours since 1900-01-01"), or WRF's Times; latitude and
/// longitude as axes, as scalars, at stations or as fields. Packed values (scale_factor,
/// add_offset), missing values; of ERA5's two experiments (expver) whichever has a value. A file
/// with one point needs no place; a grid wants one inside it.
///   throws  Error for what is missing or not understood
PointSeries read_netcdf(std::span<const std::byte> bytes, const Point& point);

}  // namespace petrichor::weather::packed

#endif
