#ifndef PETRICHOR_WEATHER_PACKED_DETAIL_POINT_NAMES_H
#define PETRICHOR_WEATHER_PACKED_DETAIL_POINT_NAMES_H

#include <optional>

#include "weather/packed/point_series.h"

namespace petrichor::weather::packed::detail {

/// What a variable of a weather model's output is.
enum class What {
    AirTemp,
    DewPoint,
    SpecificHumidity,
    RelHumidity,
    Wind,
    WindEast,
    WindNorth,
    WindFrom,
    Pressure,
    Shortwave,
    NetShortwave,
    Longwave,
    Direct,
    Cloud,
    Precip,
    PrecipMore,  // the other half of a sum: convective beside large scale
    Rain,
    Snow,
    SnowDepth,
    SnowWater,
    SurfaceTemp,
    Reflected,
    Visibility,
    Height,  // geopotential or metres, of the ground
};

/// From the names that ERA5, WRF, GFS, ICON and the CF standard give; nothing for others.
std::optional<What> what_of(const PointVariable& variable);

}  // namespace petrichor::weather::packed::detail

#endif
