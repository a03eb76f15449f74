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

/// What lies between the surface and the sub-surface thermometer at the first measurement, which
/// nobody measured.
enum class FirstProfile : std::uint8_t {
    Line,        ///< a line
    /// METRo's: 7.5 K of a daily wave whose crest is at six by the sun, and a line for what is left;
    /// while the surface is measured, the depth of the thermometer below is held at what that
    /// measured. No sun makes that wave; for what is held against METRo.
    Metro,
    DayAndLine,  ///< the wave that a day of that sun sends down, and a line for what is left
};

/// The wave of a day in the ground: mean + amplitude_k exp(-z / damping_m) cos(w (t - warmest) - z
/// / damping_m), w a turn a day (Carslaw & Jaeger 1959, 2.6).
struct DayWave {
    double amplitude_k = 0.0, damping_m = 0.1,
           warmest_s = 0.0;  ///< seconds of the day, by the mean sun
    double at(double depth_m, double second_of_sun) const;
};
/// That of a surface under the sun of a day: the first harmonic of a clear sky's light at that
/// latitude under the cloud that there is, less what is reflected, drives a half-space that gives
/// 20 W m-2 K-1 back to air (15, a light wind) and sky (5).
///   time_us  by the mean sun of the place
DayWave day_wave(const Surface& surface, double latitude_deg, std::int64_t time_us, double cloud);

/// The cell that a run begins with, at the last of the measured times: dry, its ground as the
/// measured surface has left it.
///
/// As METRo couples: heat is conducted with the surface held at what was measured, from a profile
/// between the first surface and sub-surface temperatures. Below the sub-surface thermometer, and
/// as the temperature far below, its own temperature is taken where `params` do not say.
///   first   Line where the place is not known, whatever is asked
///   throws  Error when no surface temperature is between -90 and 100 C: nothing is clamped
CellState observed_start(const ForcingTable& table, const PhysicalParams& params,
                         const RoadTemperatures& measured,
                         FirstProfile first = FirstProfile::DayAndLine);

}  // namespace petrichor::weather

#endif
