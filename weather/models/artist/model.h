#ifndef PETRICHOR_WEATHER_MODELS_ARTIST_MODEL_H
#define PETRICHOR_WEATHER_MODELS_ARTIST_MODEL_H

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace petrichor::weather {

// The artist model: weather as a state of numbers in 0..1, steered by temperature and rainfall.
// This header holds its state, its parameters, one explicit step and the values that shaders see.
// exact.h solves the same equations in closed form, for any time in any order.
// Source: the weather script of Lux 2.02, every rule and quirk of it (docs/lux.md, 1 to 5).

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
    bool script_controlled = true;                 ///< false: the state stays as set by hand
    double time_scale = 1.0;                       ///< S, 0.1..4
    double water_to_snow_time_scale = 1.0;         ///< P, 0.01..1; slows freezing, melting and W
    double accumulation_rate_wetness = 0.35;       ///< 1/s at full rain, 0..1
    double accumulation_rate_cracks = 0.25;        ///< 1/s at full rain, 0..1
    double accumulation_rate_puddles = 0.20;       ///< 1/s at full rain, 0..1
    double accumulation_rate_snow = 0.10;          ///< 1/s at full snowfall, 0..0.5
    double evaporation_rate_wetness = 0.075;       ///< 1/s at 40 C, 0..0.5
    double evaporation_rate_cracks = 0.20;         ///< 1/s at 40 C, 0..0.5
    double evaporation_rate_puddles = 0.10;        ///< 1/s at 40 C, 0..0.5
    double wetness_influence_on_albedo = 0.85;     ///< 0..1
    double wetness_influence_on_smoothness = 0.5;  ///< 0..1
    std::vector<CurveKey> water_to_snow_curve{{0.0, 0.25, 0.0, 0.0}, {1.0, 1.0, 0.0, 0.0}};
    double snow_start_height_m = -100.0;    ///< -100..8000
    double snow_height_blending_km = 0.01;  ///< 0..1
    double max_rain_particles_s = 3000.0;   ///< >= 0
    double max_snow_particles_s = 3000.0;   ///< >= 0
};

/// One number of ArtistParams: its name in files and columns, its place, the slider's range.
struct ArtistParameter {
    std::string_view name;
    double ArtistParams::*member;
    double low;
    double high;
};
/// All numbers of ArtistParams, in the order of the struct (the switch and the curve are not
/// numbers).
std::span<const ArtistParameter> artist_parameters();

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

    bool operator==(const ArtistState&) const = default;
};

/// What shaders see (docs/lux.md, 3).
struct ArtistOutputs {
    double temperature_c = 0.0;
    double rainfall = 0.0;
    double freeze_exp = 0.0;  ///< 1 - 2^(-10 W)
    double melt = 0.0;        ///< 1 - C(W)
    double melt_exp = 0.0;    ///< 1 - 2^(-10 melt)
    double snow_melt = 0.0;   ///< 1 - W
    double flood_cracks = 0.0;
    double flood_puddles = 0.0;
    double film_albedo = 0.0;      ///< m ka (1 - W)
    double film_smoothness = 0.0;  ///< m ks (1 - W)
    double snow_amount = 0.0;      ///< s W
    double rain_particles_s = 0.0;
    double snow_particles_s = 0.0;
};

/// One explicit step of `dt_s` seconds (any length >= 0) with temperature and rainfall held.
///
/// Uses `before.rain`, `before.snowfall` and, below zero, `before.water`: the intensities of the
/// step before, as the original does. Depends on the step length; sub-step, or use exact.h,
/// where that matters. T <= 0 is cold. Drying needs rainfall == 0 exactly. With script_controlled
/// off, rain = snowfall = rainfall and nothing else changes. Accepts any finite input.
ArtistState step(const ArtistState& before, const ArtistParams& params, double temperature_c,
                 double rainfall, double dt_s);

/// The published values of a state; temperature and rainfall are passed through.
/// The curve sees W before it is clamped to 0..1, everything else after.
ArtistOutputs outputs(const ArtistState& state, const ArtistParams& params, double temperature_c,
                      double rainfall);

/// Cubic Hermite interpolation of keys sorted by time; constant outside them; 0 without keys.
/// A segment with an infinite slope at either end is constant at its first value.
double curve_value(std::span<const CurveKey> keys, double time);

/// The keys with slopes chosen so that the curve passes through every value and never overshoots:
/// flat at the first and last key and at local extremes, else the weighted harmonic mean of the two
/// secants (Fritsch & Butland 1984, as in PCHIP).
std::vector<CurveKey> automatic_tangents(std::vector<CurveKey> keys);

/// 64-bit hash over the bit patterns of a state (-0 counts as 0). Chain states through `seed`.
std::uint64_t state_hash(const ArtistState& state, std::uint64_t seed = 0);

}  // namespace petrichor::weather

#endif
