#ifndef PETRICHOR_WEATHER_READERS_HORIZON_TEXT_H
#define PETRICHOR_WEATHER_READERS_HORIZON_TEXT_H

#include <string>
#include <string_view>

#include "weather/physics/horizon.h"

namespace petrichor::weather {

/// A horizon from text: lines "azimuth elevation" in degrees (blanks, commas or semicolons between
/// them, # begins a comment, a line of words is a heading), in any order; it becomes 360 equal
/// azimuths.
///   name    of the file, for errors
///   throws  Error for numbers out of range, an azimuth twice, or fewer than two lines
Horizon read_horizon(std::string_view text, const std::string& name);

}  // namespace petrichor::weather

#endif
