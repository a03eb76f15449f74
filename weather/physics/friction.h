#ifndef PETRICHOR_WEATHER_PHYSICS_FRICTION_H
#define PETRICHOR_WEATHER_PHYSICS_FRICTION_H

#include "weather/physics/cell_state.h"

namespace petrichor::weather {

/// Friction between a winter tyre and the road, 0..1.
///
/// The ends of the scale are measured classes (Wallman & Astrom 2001, VTI meddelande 911A): bare
/// dry 0.82 (middle of 0.8 to 1.0 as the FMI's model caps it, Juga et al. 2013), bare wet 0.70,
/// slush 0.35, packed snow 0.25, black ice 0.20, wet ice 0.08. Between them friction falls as an
/// exponential of what covers the texture: half of the way at 0.07 mm of water, 0.035 mm of ice or
/// 0.35 mm of snow (as water).
///   throws  nothing; any state gives 0.08..0.82
double wheel_friction(const CellState& state);

/// Clear ice on the ground (glaze, black ice, frost), mm; of film and cracks, not below snow.
double glaze_mm(const CellState& state);

/// METRo's condition of a road.
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
