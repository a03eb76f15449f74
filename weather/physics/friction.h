#ifndef PETRICHOR_WEATHER_PHYSICS_FRICTION_H
#define PETRICHOR_WEATHER_PHYSICS_FRICTION_H

#include "weather/physics/cell_state.h"

namespace petrichor::weather {

/// Friction between a winter tyre and the road, 0..1.
///
/// The ends of the scale lie in the intervals of Wallman & Astrom 2001 (VTI meddelande 911A), which
/// stand here: dry bare road 0.82 (0.8 to 1.0; the least of it, where the optical sensors of Juga
/// et al. 2013 (Meteorol. Appl. 20, 318) stop), wet bare 0.70 (0.7 to 0.8), slush 0.35 (0.20 to
/// 0.50), packed snow 0.25 (0.20 to 0.30), black ice 0.20 (0.15 to 0.30), wet black ice 0.08 (0.05
/// to 0.10). Between them friction falls as an exponential of what covers the texture, half of the
/// way at 0.07 mm of water, 0.035 mm of ice or 0.35 mm of snow (as water): chosen, as the published
/// regressions on such layers hold for one sensor only.
///   throws  nothing; any state gives 0.08..0.82
double wheel_friction(const CellState& state);

/// Clear ice on the ground (glaze, black ice, frost), mm; of film and cracks, not below snow.
double glaze_mm(const CellState& state);

/// Ice that is not seen: at least 0.01 mm of clear ice and no snow on it, at 0 C or below.
bool black_ice(const CellState& state);

/// METRo's condition of a road, by its rules and numbers (Crevier & Delage 2001): less than 0.2 mm
/// of water or ice is dry, dew or frost; melting snow is snow that melts as it falls.
enum class RoadCondition {
    Dry = 1,
    Wet = 2,
    IceOrSnow = 3,
    WaterAndSnow = 4,
    Dew = 5,
    MeltingSnow = 6,
    Frost = 7,
    IcingRain = 8,
};
RoadCondition road_condition(const CellState& state);

}  // namespace petrichor::weather

#endif
