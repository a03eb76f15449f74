#ifndef PETRICHOR_WEATHER_MODELS_PHYSICAL_OBSERVED_START_H
#define PETRICHOR_WEATHER_MODELS_PHYSICAL_OBSERVED_START_H

#include <cstdint>
#include <span>

#include "weather/models/physical/physical.h"

namespace petrichor::weather {

/// Measured temperatures of a road, C; NaN where nothing was measured.
struct RoadTemperatures {
    std::span<const std::int64_t> time_us;  ///< increasing
    std::span<const double> surface_c;
    std::span<const double> subsurface_c;  ///< as many, or none
    double subsurface_depth_m = 0.4;
};

/// The cell that a run begins with, at the last of the measured times: dry, its ground as the
/// measured surface has left it.
///
/// As METRo couples: heat is conducted with the surface held at what was measured, from a line
/// between the first surface and sub-surface temperatures. Below the sub-surface thermometer, and
/// as the temperature far below, its own temperature is taken where `params` do not say.
///   throws  Error when no surface temperature is between -90 and 100 C: nothing is clamped
CellState observed_start(const ForcingTable& table, const PhysicalParams& params,
                         const RoadTemperatures& measured);

}  // namespace petrichor::weather

#endif
