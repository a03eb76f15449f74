#ifndef PETRICHOR_WEATHER_FORCING_FORCING_H
#define PETRICHOR_WEATHER_FORCING_FORCING_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "weather/forcing/read_report.h"

namespace petrichor::weather {

/// What is not known is NaN until fill_forcing has run.
inline constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// Columns of a forcing table, SI. "at" values hold at the time of the row and are linear between
/// rows; "rate" values are means from this row to the next.
enum class Field : std::uint8_t {
    AirTemp,       ///< K, at
    RelHumidity,   ///< percent over water, at
    Wind,          ///< m/s, at
    Pressure,      ///< Pa at the station, at
    Shortwave,     ///< W/m2 on flat ground, at
    Longwave,      ///< W/m2 from the sky, at
    Cloud,         ///< fraction 0..1, at
    Precip,        ///< kg m-2 s-1, all phases, rate
    Rain,          ///< kg m-2 s-1, rate; only where the file separates phases
    Snow,          ///< kg m-2 s-1, rate; likewise
    DewPoint,      ///< K, at; only to derive humidity
    WindFrom,      ///< degrees clockwise from north where the wind comes from, at
    Visibility,    ///< m, at
    SnowDepth,     ///< m, as observed, at; never used as input, only compared
    Direct,        ///< W/m2 on a plane facing the sun, at
    Diffuse,       ///< W/m2 on flat ground, at
    NetShortwave,  ///< W/m2 that the ground takes up, rate; only where a file has no Shortwave
    SnowShare,     ///< of the precipitation of a row, 0..1, rate; where a file tells the phase
    SurfaceTemp,   ///< K, of the surface, as observed, at; never used as input, only compared
    Reflected,     ///< W/m2 that come back from the ground, as observed, at; only compared
    SnowWater,     ///< kg/m2 of snow on the ground, as observed, at; only compared
    Condition,     ///< RoadCondition (physics/friction.h) of a road or runway, as observed, at
    Friction,      ///< coefficient, as measured on a road or runway, at; only compared
    Count
};
inline constexpr std::size_t kFieldCount = static_cast<std::size_t>(Field::Count);

/// Name, unit and accepted range of a field; values outside are refused by the readers and
/// reported.
struct FieldInfo {
    const char* name;
    const char* unit;
    double low, high;
    bool is_rate;
    double noise = 0.0;  ///< so far below `low` a sensor may say and mean it; taken as `low`
    bool observed = false;  ///< of the ground, to compare with: never used as input
};
const FieldInfo& field_info(Field field);

/// Where and how the values were measured.
struct Site {
    double latitude_deg = kMissing;
    double longitude_deg = kMissing;
    double elevation_m = kMissing;
    double temp_height_m = 2.0;
    double wind_height_m = 10.0;
    double utc_offset_h = kMissing;  ///< of the clock that people at the place read; east positive
    std::string name{};
};

/// Weather over time. Times are microseconds since 1970-01-01 UTC, strictly increasing; every
/// column that is present is as long as `time_us`.
struct ForcingTable {
    Site site;
    std::vector<std::int64_t> time_us;
    std::array<std::vector<double>, kFieldCount> columns;

    std::size_t rows() const { return time_us.size(); }
    const std::vector<double>& operator[](Field f) const
    {
        return columns[static_cast<std::size_t>(f)];
    }
    std::vector<double>& operator[](Field f) { return columns[static_cast<std::size_t>(f)]; }
    bool has(Field f) const { return !(*this)[f].empty(); }
};

/// What to do where a file gives no amount of precipitation.
enum class MissingPrecip : std::uint8_t {
    Dry,       ///< 0, with a warning in the report
    Estimate,  ///< a rate where the sky is overcast and the air near saturation; see fill_forcing
};
struct FillOptions {
    MissingPrecip missing_precip = MissingPrecip::Dry;
    std::int64_t longest_gap_us =
        6LL * 3600 * 1000000;  ///< bridged by a line; longer gaps are noted
};

/// Makes a table complete: after it AirTemp, RelHumidity, Wind, Pressure, Shortwave, Longwave,
/// Cloud and Precip have a finite value in every row (Rain and Snow where the file separates
/// phases).
///
/// Order: short gaps by a line between neighbours (rates: 0); humidity from the dew point, else 70
/// %; pressure from the elevation; cloud from shortwave, else from longwave, else from humidity; shortwave from sun and
/// cloud; longwave from humidity and cloud (Dilley & O'Brien 1998). Every fill is added to the report.
/// Where the sun has to be made, rows further apart than an hour are divided into hours, so that
/// noon is not missed; net shortwave keeps its mean and follows the made sun.
///
/// Precipitation without an amount is 0 and warned of, or estimated: in rows with cloud of 0.95 or
/// more, humidity of 85 % or more and visibility below 16 km (humidity of 92 % where that is
/// unknown), at the rate that the rows of the file with a known amount have under the same sky,
/// else 0.5 mm/h.
///   throws  Error when there are no rows, times do not increase, or air temperature is missing
///   throughout
void fill_forcing(ForcingTable& table, ReadReport& report, const FillOptions& options = {});

/// Value of an "at" field at any time, linear between rows and constant outside.
double value_at(const ForcingTable& table, Field field, std::int64_t time_us);

}  // namespace petrichor::weather

#endif
