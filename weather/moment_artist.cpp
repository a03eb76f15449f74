// The artist model as moments: its published values, and what they stand for in SI.
#include <algorithm>
#include <cmath>

#include "weather/moment.h"
#include "weather/physics/constants.h"

namespace petrichor::weather {
namespace {

constexpr double kMicroseconds = 1e6;
constexpr double kFreshSnow_kg_m3 = 100.0;  // as state_of_masks

double saturate(double x)
{
    return std::clamp(x, 0.0, 1.0);
}

float narrow(double value)
{
    return static_cast<float>(value);
}

double temperature_c(const Timeline& timeline, double time_s)
{
    return value_at(timeline.temperature_c, time_s * kMicroseconds);
}

double rainfall(const Timeline& timeline, double time_s)
{
    return value_at(timeline.rainfall, time_s * kMicroseconds);
}

// What the 0..1 values stand for.
void set_si(shared::WeatherMoment& m, const ArtistState& state)
{
    const MappingParams map;
    const Surface surface = surface_preset("asphalt");
    const double falling = saturate(state.rain + state.snowfall);
    const double rate_kg_m2_s = rate_of_rainfall_mm_h(map, falling) / 3600.0;
    const double share = falling > 0.0 ? saturate(state.snowfall / falling) : 0.0;
    m.snow_fraction = narrow(share);
    m.rain_kg_m2_s = narrow(rate_kg_m2_s * (1.0 - share));
    m.snowfall_kg_m2_s = narrow(rate_kg_m2_s * share);
    const double frozen = saturate(state.water_to_snow);
    m.film_mm = narrow(film_of_wetness_kg_m2(map, state.wetness * (1.0 - frozen)));
    m.crack_water_depth_m = narrow(state.cracks * surface.cracks.depth_mm * 1e-3);
    m.puddle_depth_m = narrow(state.puddles * surface.puddles.depth_mm * 1e-3);
    m.ice_kg_m2 = narrow(frozen * (store_of_level_kg_m2(surface.cracks, state.cracks) +
                                   store_of_level_kg_m2(surface.puddles, state.puddles)));
    const double depth_m = depth_of_snow_m(map, static_cast<double>(m.snow_amount));
    m.snow_depth_m = narrow(depth_m);
    m.swe_kg_m2 = narrow(depth_m * kFreshSnow_kg_m3);
}

// While states are set by hand the model passes all rainfall on as rain and as snow, as its original does. Here it falls as one of
// them: as ice as far as what lies is set to, and none of it through air above 3 C.
ArtistState falling_by_hand(ArtistState state, double rainfall, double temperature_c)
{
    state.snowfall = rainfall * saturate(state.water_to_snow) * std::clamp(0.5 * (3.0 - temperature_c), 0.0, 1.0);
    state.rain = rainfall - state.snowfall;
    return state;
}

}  // namespace

double frost_at(const Timeline& timeline, double time_s, double time_scale)
{
    constexpr double kStep_s = 0.25;
    constexpr double kWindow_s = 60.0;
    constexpr double kGrowth_1_s = 1.0 / 12.0;
    const double window_s = kWindow_s / std::max(0.1, time_scale);
    const double step_s = kStep_s / std::max(0.1, time_scale);
    const double first = std::max(0.0, std::floor((time_s - window_s) / step_s));
    double frost = 0.0;
    // Growth and melt of one step; the last step is cut at the time.
    for (double i = first; i * step_s < time_s; i += 1.0) {
        const double from_s = i * step_s;
        const double dt_s = std::min(step_s, time_s - from_s) * time_scale;
        const double cold = -temperature_c(timeline, from_s + 0.5 * step_s) / 10.0;
        if (cold > 0.0) {
            const double dry = saturate(1.0 - 4.0 * rainfall(timeline, from_s + 0.5 * step_s));
            frost += kGrowth_1_s * std::min(cold, 2.0) * dry * dt_s;
        } else {
            frost += 4.0 * kGrowth_1_s * std::max(cold, -2.0) * dt_s;
        }
        frost = saturate(frost);
    }
    return frost;
}

double cloud_cover_at(const Timeline& timeline, double time_s)
{
    const double reach_s = std::max(1.0, to_seconds(timeline.end()) / 12.0);
    constexpr int kSamples = 12;  // to each side
    double sum = 0.0;
    double weights = 0.0;
    for (int i = -kSamples; i <= kSamples; ++i) {
        const double weight = 1.0 - std::abs(i) / (kSamples + 1.0);
        sum += weight * saturate(3.0 * rainfall(timeline, time_s + reach_s * i / kSamples));
        weights += weight;
    }
    return 0.12 + 0.83 * sum / weights;
}

Moment artist_moment(const ArtistTimeline& weather, const Timeline& timeline,
                     const SkyChannels& sky, double time_s)
{
    const TimeUs time = to_time_us(time_s);
    const ArtistOutputs published = weather.outputs_at(time);
    const ArtistParams params = weather.params_at(time);
    const ArtistState state = params.script_controlled
                                  ? weather.state_at(time)
                                  : falling_by_hand(weather.state_at(time), rainfall(timeline, time_s), published.temperature_c);
    const auto now = [&](const Channel& channel) {
        return value_at(channel, static_cast<double>(time));
    };
    Moment moment;
    shared::WeatherMoment& m = moment.values;
    m.rain = narrow(state.rain);
    m.snowfall = narrow(state.snowfall);
    m.flood_cracks = narrow(published.flood_cracks);
    m.flood_puddles = narrow(published.flood_puddles);
    m.film_albedo = narrow(published.film_albedo);
    m.film_smoothness = narrow(published.film_smoothness);
    m.snow_amount = narrow(published.snow_amount);
    m.water_to_snow = narrow(saturate(state.water_to_snow));
    m.freeze_exp = narrow(published.freeze_exp);
    m.melt = narrow(published.melt);
    m.melt_exp = narrow(published.melt_exp);
    m.snow_start_height_m = narrow(params.snow_start_height_m);
    m.snow_height_blend_m = narrow(params.snow_height_blending_km * 1000.0);
    m.frost = narrow(frost_at(timeline, time_s, params.time_scale));
    m.air_temperature_k = narrow(published.temperature_c + kZeroCelsiusK);
    m.cloud_fraction =
        narrow(sky.cloud_cover.empty() ? cloud_cover_at(timeline, time_s) : now(sky.cloud_cover));
    m.wind_m_s = wind_vector_m_s(now(sky.wind_m_s), now(sky.wind_from_deg));
    m.visibility_m = narrow(sky.visibility_m.empty() ? visibility_in_m(state.rain, state.snowfall)
                                                     : now(sky.visibility_m));
    set_si(m, state);
    return moment;
}

}  // namespace petrichor::weather
