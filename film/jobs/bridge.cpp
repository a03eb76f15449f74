#include "film/jobs/bridge.h"

#include <algorithm>
#include <cmath>

namespace petrichor::film {
namespace {

constexpr double kMicroseconds = 1e6;
constexpr double kZeroCelsiusK = 273.15;

double saturate(double x)
{
    return std::clamp(x, 0.0, 1.0);
}

// A channel that no file has touched.
bool same(const weather::Channel& a, const weather::Channel& b)
{
    return a.times == b.times && a.values == b.values;
}

double temperature_c(const weather::Timeline& timeline, double time_s)
{
    return weather::value_at(timeline.temperature_c, time_s * kMicroseconds);
}

double rainfall(const weather::Timeline& timeline, double time_s)
{
    return weather::value_at(timeline.rainfall, time_s * kMicroseconds);
}

}  // namespace

double frost_at(const weather::Timeline& timeline, double time_s, double time_scale)
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

double cloud_cover_at(const weather::Timeline& timeline, double time_s)
{
    const double reach_s = std::max(1.0, weather::to_seconds(timeline.end()) / 12.0);
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

double visibility_m(double rain, double snowfall)
{
    constexpr double kKoschmieder = 3.912;  // -ln(0.02)
    const double extinction_1_m =
        kKoschmieder / 20000.0 + rain * (kKoschmieder / 3500.0) + snowfall * (kKoschmieder / 620.0);
    return kKoschmieder / extinction_1_m;
}

glm::vec2 wind_vector_m_s(double speed_m_s, double from_deg)
{
    const double angle = from_deg * 3.14159265358979323846 / 180.0;
    return {static_cast<float>(-speed_m_s * std::sin(angle)),
            static_cast<float>(speed_m_s * std::cos(angle))};
}

WeatherMoment weather_moment(const WeatherScript& script, const weather::ArtistTimeline& weather,
                             double time_s)
{
    const weather::TimeUs time = weather::to_time_us(time_s);
    const weather::ArtistState state = weather.state_at(time);
    const weather::ArtistOutputs published = weather.outputs_at(time);
    const weather::ArtistParams params = weather.params_at(time);
    const auto now = [&](const weather::Channel& channel) {
        return weather::value_at(channel, static_cast<double>(time));
    };
    const WeatherScript defaults;
    WeatherMoment moment;
    const auto narrow = [](double value) { return static_cast<float>(value); };
    shared::WeatherMoment& surface = moment.surface;
    surface.air_temperature_k = narrow(published.temperature_c + kZeroCelsiusK);
    surface.cloud_fraction = narrow(same(script.cloud_cover, defaults.cloud_cover)
                                        ? cloud_cover_at(script.timeline, time_s)
                                        : now(script.cloud_cover));
    surface.rain = narrow(state.rain);
    surface.snowfall = narrow(state.snowfall);
    surface.flood_cracks = narrow(published.flood_cracks);
    surface.flood_puddles = narrow(published.flood_puddles);
    surface.film_albedo = narrow(published.film_albedo);
    surface.film_smoothness = narrow(published.film_smoothness);
    surface.snow_amount = narrow(published.snow_amount);
    surface.water_to_snow = narrow(saturate(state.water_to_snow));
    surface.freeze_exp = narrow(published.freeze_exp);
    surface.melt = narrow(published.melt);
    surface.melt_exp = narrow(published.melt_exp);
    surface.snow_start_height_m = narrow(params.snow_start_height_m);
    surface.snow_height_blend_m = narrow(params.snow_height_blending_km * 1000.0);
    surface.frost = narrow(frost_at(script.timeline, time_s, params.time_scale));
    surface.wind_m_s = wind_vector_m_s(now(script.wind_m_s), now(script.wind_from_deg));
    surface.visibility_m = narrow(same(script.visibility_m, defaults.visibility_m)
                                      ? visibility_m(state.rain, state.snowfall)
                                      : now(script.visibility_m));
    return moment;
}

}  // namespace petrichor::film
