#ifndef PETRICHOR_WEATHER_PACKED_POINT_SERIES_H
#define PETRICHOR_WEATHER_PACKED_POINT_SERIES_H

#include <cstdint>
#include <string>
#include <vector>

// What NetCDF and GRIB files have in common once a point is chosen: named variables over time.
// Lives in the helper program that reads such files.
namespace petrichor::weather::packed {

/// One variable at one point, in the file's own units; NaN where it has no value.
struct PointVariable {
    std::string name;           ///< "t2m", "airtemp", "T2", as in the file
    std::string standard_name;  ///< CF, may be empty
    std::string units;
    std::vector<double> values;  ///< one a time
};

struct PointSeries {
    std::string kind;                   ///< "NetCDF", "GRIB"
    std::vector<std::int64_t> time_us;  ///< since 1970 UTC, increasing
    bool ends_of_intervals = false;     ///< the file says that means and sums end at their time
    double latitude_deg = 0.0, longitude_deg = 0.0, elevation_m = 0.0;  ///< NaN: not known
    std::vector<PointVariable> variables;
    std::vector<std::string> notes;
};

/// Where to read a grid.
struct Point {
    double latitude_deg, longitude_deg;  ///< NaN: not given
    bool bilinear = true;                ///< between the four points around; else the nearest
};

/// The series as plain CSV with its place and notes in comments: what read_forcing_csv reads.
///
/// Names of ERA5, ERA5-Land, ALMA, CMIP, SUMMA, WRF and HRRR, and CF standard names. Accumulations
/// (J/m2, m of water) become rates of the interval before their time; those of ERA5-Land, which add
/// up through the day, are told by never falling but after midnight and are taken apart.
///   throws  Error when the series has no air temperature, too many times or none
std::string csv_of(const PointSeries& series);

}  // namespace petrichor::weather::packed

#endif
