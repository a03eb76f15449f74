#ifndef PETRICHOR_WEATHER_MODELS_PHYSICAL_OBSERVED_WATER_H
#define PETRICHOR_WEATHER_MODELS_PHYSICAL_OBSERVED_WATER_H

#include "weather/models/physical/observed_start.h"

namespace petrichor::weather {

/// Liquid water on a road, kg/m2.
struct RoadWater {
    double film = 0.0, crack = 0.0, puddle = 0.0;
    double sum() const { return film + crack + puddle; }
};

/// What the measured hours have left on the road, which was dry before them, or had a full film where
/// it rains at the first of them: the model goes through `weather` from the first measured
/// temperature to the last. Liquid alone: what lies there as ice
/// has been salted or worn off, or not, and no thermometer tells.
///   weather  filled, over the measured hours (observed_weather has their rain)
///   throws   as observed_start
RoadWater observed_water(const ForcingTable& weather, const PhysicalParams& params,
                         const RoadTemperatures& measured);

/// A start on a road with that water.
CellState with_water(CellState start, const RoadWater& water);

}  // namespace petrichor::weather

#endif
