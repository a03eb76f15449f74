#include "weather/models/artist/model.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/cubic.h"
#include "weather/models/artist/detail/math.h"

namespace petrichor::weather {
namespace {

double saturate(double x)
{
    return std::clamp(x, 0.0, 1.0);
}

// d C/dt is not needed anywhere, only the value: the two ends, their slopes, u in 0..1.
double between(const CurveKey& a, const CurveKey& b, double time)
{
    if (std::isinf(a.slope_out) || std::isinf(b.slope_in)) return a.value;
    const double span = b.time - a.time;
    return hermite(a.value, b.value, a.slope_out, b.slope_in, span, (time - a.time) / span);
}

std::uint64_t mix(std::uint64_t hash, std::uint64_t word)
{
    hash = (hash ^ word) * 0x9e3779b97f4a7c15ull;
    return hash ^ (hash >> 29);
}

}  // namespace

std::span<const ArtistParameter> artist_parameters()
{
    using P = ArtistParams;
    static constexpr std::array<ArtistParameter, 15> kAll{{
        {"time_scale", &P::time_scale, 0.1, 4.0},
        {"water_to_snow_time_scale", &P::water_to_snow_time_scale, 0.01, 1.0},
        {"accumulation_rate_wetness", &P::accumulation_rate_wetness, 0.0, 1.0},
        {"accumulation_rate_cracks", &P::accumulation_rate_cracks, 0.0, 1.0},
        {"accumulation_rate_puddles", &P::accumulation_rate_puddles, 0.0, 1.0},
        {"accumulation_rate_snow", &P::accumulation_rate_snow, 0.0, 0.5},
        {"evaporation_rate_wetness", &P::evaporation_rate_wetness, 0.0, 0.5},
        {"evaporation_rate_cracks", &P::evaporation_rate_cracks, 0.0, 0.5},
        {"evaporation_rate_puddles", &P::evaporation_rate_puddles, 0.0, 0.5},
        {"wetness_influence_on_albedo", &P::wetness_influence_on_albedo, 0.0, 1.0},
        {"wetness_influence_on_smoothness", &P::wetness_influence_on_smoothness, 0.0, 1.0},
        {"snow_start_height_m", &P::snow_start_height_m, -100.0, 8000.0},
        {"snow_height_blending_km", &P::snow_height_blending_km, 0.0, 1.0},
        {"max_rain_particles_s", &P::max_rain_particles_s, 0.0, 1e9},
        {"max_snow_particles_s", &P::max_snow_particles_s, 0.0, 1e9},
    }};
    return kAll;
}

ArtistState step(const ArtistState& before, const ArtistParams& params, double temperature_c,
                 double rainfall, double dt_s)
{
    ArtistState next = before;
    if (!params.script_controlled) {
        next.rain = rainfall;
        next.snowfall = rainfall;
        return next;
    }
    const double h = dt_s * params.time_scale;
    const double g = h * params.water_to_snow_time_scale;
    const double drive = saturate(std::abs(temperature_c) / 40.0);
    if (temperature_c > 0.0) {
        next.water_to_snow = saturate(before.water_to_snow - drive * g);
        const double melt = saturate((1.0 - next.water_to_snow) * before.snow * g * 4.0);
        const double fallen = before.rain * h;
        next.wetness += fallen * params.accumulation_rate_wetness + melt;
        next.cracks += fallen * params.accumulation_rate_cracks;
        next.puddles += fallen * params.accumulation_rate_puddles;
        if (rainfall == 0.0) {
            next.wetness -= params.evaporation_rate_wetness * drive * h;
            next.cracks -= params.evaporation_rate_cracks * drive * h;
            next.puddles -= params.evaporation_rate_puddles * drive * h;
        }
        next.snow -= melt;
    } else {
        next.water_to_snow = saturate(before.water_to_snow + drive * g);
        const double frozen = next.water_to_snow * g;
        next.snow +=
            before.snowfall * params.accumulation_rate_snow * h + frozen * saturate(before.water);
        next.wetness -= frozen;
        next.cracks -= frozen;
        next.puddles -= frozen;
    }
    next.snow = saturate(next.snow);
    next.wetness = saturate(next.wetness);
    next.cracks = saturate(next.cracks);
    next.puddles = saturate(next.puddles);
    next.water = std::max(next.cracks, next.puddles);
    next.snowfall = rainfall * next.water_to_snow;
    next.rain = rainfall - next.snowfall;
    return next;
}

ArtistOutputs outputs(const ArtistState& state, const ArtistParams& params, double temperature_c,
                      double rainfall)
{
    const double frozen = saturate(state.water_to_snow);
    ArtistOutputs out;
    out.temperature_c = temperature_c;
    out.rainfall = rainfall;
    out.freeze_exp = 1.0 - portable_exp2(-10.0 * frozen);
    out.melt = 1.0 - curve_value(params.water_to_snow_curve, state.water_to_snow);
    out.melt_exp = 1.0 - portable_exp2(-10.0 * out.melt);
    out.snow_melt = 1.0 - frozen;
    out.flood_cracks = state.cracks;
    out.flood_puddles = state.puddles;
    out.film_albedo = state.wetness * params.wetness_influence_on_albedo * (1.0 - frozen);
    out.film_smoothness = state.wetness * params.wetness_influence_on_smoothness * (1.0 - frozen);
    out.snow_amount = state.snow * frozen;
    out.rain_particles_s = params.max_rain_particles_s * state.rain;
    out.snow_particles_s = params.max_snow_particles_s * state.snowfall;
    return out;
}

double curve_value(std::span<const CurveKey> keys, double time)
{
    if (keys.empty()) return 0.0;
    if (!(time > keys.front().time)) return keys.front().value;
    if (time >= keys.back().time) return keys.back().value;
    const auto after = std::upper_bound(keys.begin(), keys.end(), time,
                                        [](double t, const CurveKey& key) { return t < key.time; });
    return between(*(after - 1), *after, time);
}

std::vector<CurveKey> automatic_tangents(std::vector<CurveKey> keys)
{
    for (std::size_t i = 0; i < keys.size(); ++i) {
        double slope = 0.0;
        if (i > 0 && i + 1 < keys.size()) {
            const double before = keys[i].time - keys[i - 1].time;
            const double after = keys[i + 1].time - keys[i].time;
            slope = monotone_slope(before, (keys[i].value - keys[i - 1].value) / before, after,
                                   (keys[i + 1].value - keys[i].value) / after);
        }
        keys[i].slope_in = slope;
        keys[i].slope_out = slope;
    }
    return keys;
}

std::uint64_t state_hash(const ArtistState& state, std::uint64_t seed)
{
    std::uint64_t hash = mix(0x243f6a8885a308d3ull, seed);
    for (double value : {state.water_to_snow, state.wetness, state.cracks, state.puddles,
                         state.water, state.snow, state.rain, state.snowfall}) {
        hash = mix(hash, std::bit_cast<std::uint64_t>(value + 0.0));  // -0 + 0 is +0
    }
    return hash;
}

}  // namespace petrichor::weather
