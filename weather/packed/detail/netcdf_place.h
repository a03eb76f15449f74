#ifndef PETRICHOR_WEATHER_PACKED_DETAIL_NETCDF_PLACE_H
#define PETRICHOR_WEATHER_PACKED_DETAIL_NETCDF_PLACE_H

#include <string>
#include <utility>
#include <vector>

#include "weather/packed/detail/netcdf_file.h"
#include "weather/packed/point_series.h"

namespace petrichor::weather::packed::detail {

/// Some cell of the horizontal dimensions and what it counts.
struct Corner {
    std::vector<std::pair<int, std::size_t>> at;  ///< dimension and index
    double weight = 1.0;
};
/// A point of a file: the cells whose weighted sum is its value.
struct Place {
    std::vector<Corner> corners;  ///< at least one
    double latitude_deg = kNone, longitude_deg = kNone;
    std::string note;  ///< which points were taken, for the log
};

/// The point in a file with axes, stations, a field of places, or no place at all.
///   time_dimension  id; WRF repeats its places along it
///   throws          Error when the point is not given or not inside
Place find_place(const File& file, int time_dimension, const Point& point);

}  // namespace petrichor::weather::packed::detail

#endif
