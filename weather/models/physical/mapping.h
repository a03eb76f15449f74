#ifndef PETRICHOR_WEATHER_MODELS_PHYSICAL_MAPPING_H
#define PETRICHOR_WEATHER_MODELS_PHYSICAL_MAPPING_H

#include "weather/physics/cell_state.h"
#include "weather/physics/stores.h"
#include "weather/physics/surfaces.h"

namespace petrichor::weather {

/// Constants of the maps between SI and the renderer's 0..1.
struct MappingParams {
    double rain_low_mm_h = 1.0;    ///< P0 > 0: where the logarithm begins to bend
    double rain_full_mm_h = 50.0;  ///< P1 > P0: rainfall 1
    double film_scale_kg_m2 = 0.25;
    double snow_scale_m = 0.05;
};

// Each map is monotone, clamped to 0..1 and has its inverse beside it. The inverse of 1 is where
// the map first reaches 1 to double precision (film, snow: 38 scales).

/// R = ln(1 + p/P0) / ln(1 + P1/P0).
double rainfall_of_rate(const MappingParams& params, double rate_mm_h);
double rate_of_rainfall_mm_h(const MappingParams& params, double rainfall);

/// W = 1 - exp(-w / scale), liquid film only.
double wetness_of_film(const MappingParams& params, double film_kg_m2);
double film_of_wetness_kg_m2(const MappingParams& params, double wetness);

/// S = 1 - exp(-D / scale).
double snow_of_depth(const MappingParams& params, double depth_m);
double depth_of_snow_m(const MappingParams& params, double snow);

/// Level of water in a relief over its depth; uniform heights: sqrt(w / capacity).
double level_of_store(const Hypsometry& relief, double stored_kg_m2);
double store_of_level_kg_m2(const Hypsometry& relief, double level);

/// What the renderer reads, each 0..1.
struct WeatherMasks {
    double rainfall = 0.0;  ///< all precipitation
    double rain = 0.0, snowfall = 0.0;
    double wetness = 0.0;
    double cracks = 0.0, puddles = 0.0;  ///< liquid and ice: a frozen puddle still fills its hollow
    double water_to_snow = 0.0;          ///< frozen share of all surface water
    double snow = 0.0;
};

/// Masks of a state whose last step took `step_s` seconds.
WeatherMasks weather_masks(const MappingParams& params, const Surface& surface,
                           const CellState& state, double step_s);

/// A cell that shows these masks: stores filled, snow at 100 kg/m3, everything else as in `base`.
/// weather_masks of the result gives back wetness, cracks, puddles and snow. Water is liquid, or
/// ice when water_to_snow is above 0.5.
CellState state_of_masks(const MappingParams& params, const Surface& surface,
                         const WeatherMasks& masks, const CellState& base);

}  // namespace petrichor::weather

#endif
