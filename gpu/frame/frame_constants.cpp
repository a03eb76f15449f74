#include "gpu/frame/frame_constants.h"

#include <algorithm>
#include <cmath>

namespace petrichor::gpu {

namespace {

constexpr float kSunAngularRadius = 0.00465f;

}  // namespace

shared::FrameConstants frame_constants(const Frame& frame, const Sun& sun, const Bounds& scene,
                                       std::uint32_t sample_index)
{
    const FrameSettings& s = frame.settings;
    const SurfaceWeather& w = frame.weather;
    shared::FrameConstants c{};
    set_camera(c, frame.camera, s.width, s.height, sample_offset(sample_index, s.seed), scene);
    c.time_s = static_cast<float>(s.time_s);
    c.sample_index = sample_index;
    c.sun_direction = sun.direction;
    c.sun_illuminance = sun.illuminance;
    c.flood = {w.flood_cracks, w.flood_puddles};
    c.film = {w.film_albedo, w.film_smoothness};
    c.rain = w.rain;
    c.snow_amount = w.snow_amount;
    c.water_to_snow = w.water_to_snow;
    c.freeze_exp = w.freeze_exp;
    c.melt = w.melt;
    c.melt_exp = w.melt_exp;
    c.snow_start_m = w.snow_start_height_m;
    c.snow_blend_m = w.snow_height_blend_m;
    c.frost = w.frost;
    c.snow_color = w.snow_color;
    c.ripple_tiling = 0.8f;
    c.ripple_refraction = 0.5f;
    c.snow_tiling = {0.35f, 1.7f, 0.09f, 0.83f};
    c.wind_m_s = w.wind_m_s;
    const float size_m = glm::length(scene.high - scene.low);
    c.ao_radius_m = std::clamp(0.03f * size_m, 0.01f, 0.7f);
    c.ao_strength = 1.0f;
    c.shelter_spread_m = std::clamp(0.01f * size_m, 0.001f, 0.18f);
    c.ambient_scale = s.image_based_light ? 1.0f : 0.0f;
    c.sky_scale = 1.0f;
    // Koschmieder: 2 % contrast is left at the visibility. The veil is skylight: none without it.
    c.fog_per_m = s.image_based_light ? 3.912f / std::max(w.visibility_m, 1.0f) : 0.0f;
    c.emissive_scale = frame.emissive_scale;
    c.bounce = 0.22f + 0.25f * std::clamp(w.snow_amount, 0.0f, 1.0f);
    c.exposure = s.exposure;
    c.exposure_bias = std::exp2(s.exposure_bias_stops);
    c.samples = static_cast<float>(s.samples);
    c.sun_angular_cos = std::cos(kSunAngularRadius);
    const auto flag = [&c](bool on, std::uint32_t bit) { c.flags |= on ? bit : 0u; };
    flag(s.draw_sky, FRAME_SKY);
    flag(s.tone_map, FRAME_TONE_MAP);
    flag(s.shelter, FRAME_SHELTER);
    flag(sun.disc, FRAME_SUN_DISC);
    return c;
}

VisibleWeather visible_weather(const Frame& frame, bool scene_has_constant_weather)
{
    const SurfaceWeather& w = frame.weather;
    VisibleWeather visible;
    visible.snow = scene_has_constant_weather || w.snow_amount > 0.0f;
    visible.water = scene_has_constant_weather || w.flood_cracks > 0.0f || w.flood_puddles > 0.0f;
    visible.any = visible.snow || visible.water || w.rain > 0.0f || w.film_albedo > 0.0f ||
                  w.film_smoothness > 0.0f || w.frost > 0.0f;
    return visible;
}

}  // namespace petrichor::gpu
