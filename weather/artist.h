#ifndef PETRICHOR_WEATHER_ARTIST_H
#define PETRICHOR_WEATHER_ARTIST_H

#include <vector>

namespace petrichor::weather {

/// One key of a cubic Hermite curve.
struct CurveKey {
    double time = 0.0;
    double value = 0.0;
    double slope_in = 0.0;
    double slope_out = 0.0;
};

/// Parameters of the artist model (Lux 2.02). Ranges are those of the original's sliders; the model
/// itself accepts any finite value and clamps the state.
struct ArtistParams {
    bool script_controlled = true;
    double time_scale = 1.0;                 ///< S
    double water_to_snow_time_scale = 1.0;   ///< P
    double accumulation_rate_wetness = 0.35;  ///< 1/s at full rain
    double accumulation_rate_cracks = 0.25;
    double accumulation_rate_puddles = 0.20;
    double accumulation_rate_snow = 0.10;
    double evaporation_rate_wetness = 0.075;  ///< 1/s at 40 C
    double evaporation_rate_cracks = 0.20;
    double evaporation_rate_puddles = 0.10;
    double wetness_influence_on_albedo = 0.85;
    double wetness_influence_on_smoothness = 0.5;
    std::vector<CurveKey> water_to_snow_curve{{0.0, 0.25, 0.0, 0.0}, {1.0, 1.0, 0.0, 0.0}};
    double snow_start_height_m = -100.0;
    double snow_height_blending_km = 0.01;
    double max_rain_particles_s = 3000.0;
    double max_snow_particles_s = 3000.0;
};

/// State of the artist model, each 0..1.
struct ArtistState {
    double water_to_snow = 0.01;  ///< W: 0 everything liquid, 1 everything frozen
    double wetness = 0.0;         ///< m
    double cracks = 0.0;          ///< c
    double puddles = 0.0;         ///< p
    double water = 0.0;           ///< max(c, p) as of the last step
    double snow = 0.0;            ///< s
    double rain = 0.0;            ///< r, intensity of rain
    double snowfall = 0.0;        ///< f, intensity of snowfall
};

/// What shaders see: lux-weather "published values".
struct ArtistOutputs {
    double temperature_c = 0.0;
    double rainfall = 0.0;
    double freeze_exp = 0.0;       ///< 1 - 2^(-10 W)
    double melt = 0.0;             ///< 1 - C(W)
    double melt_exp = 0.0;         ///< 1 - 2^(-10 melt)
    double snow_melt = 0.0;        ///< 1 - W
    double flood_cracks = 0.0;
    double flood_puddles = 0.0;
    double film_albedo = 0.0;      ///< m ka (1 - W)
    double film_smoothness = 0.0;  ///< m ks (1 - W)
    double snow_amount = 0.0;      ///< s W
    double rain_particles_s = 0.0;
    double snow_particles_s = 0.0;
};

}  // namespace petrichor::weather

#endif
