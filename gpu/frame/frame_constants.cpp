#include "gpu/frame/frame_constants.h"

#include <algorithm>
#include <cmath>

#include "formulas/color/srgb.h"
#include "formulas/weather/visibility.h"

namespace petrichor::gpu {

namespace {

constexpr float kSunAngularRadius = 0.00465f;

}  // namespace

shared::FrameConstants frame_constants(const Frame& frame, const Sun& sun, const Bounds& scene,
                                       std::uint32_t sample_index)
{
    const FrameSettings& s = frame.settings;
    const shared::WeatherMoment& w = frame.weather;
    shared::FrameConstants c{};
    set_camera(c, frame.camera, s.width, s.height, sample_offset(sample_index, s.seed), scene);
    c.time_s = static_cast<float>(s.time_s);
    c.sample_index = sample_index;
    c.sun_direction = sun.direction;
    c.sun_illuminance = sun.illuminance;
    c.weather = w;
    c.look = frame.look;
    const float size_m = glm::length(scene.high - scene.low);
    c.ao_radius_m = std::clamp(0.03f * size_m, 0.01f, 0.7f);
    c.ao_strength = 1.0f;
    c.shelter_spread_m = std::clamp(0.01f * size_m, 0.001f, 0.18f);
    c.ambient_scale = s.image_based_light ? 1.0f : 0.0f;
    c.sky_scale = 1.0f;
    // Koschmieder: 2 % contrast is left at the visibility. The veil is skylight: none without it.
    c.fog_per_m = s.image_based_light
                      ? static_cast<float>(KOSCHMIEDER_2_PERCENT) / std::max(w.visibility_m, 1.0f)
                      : 0.0f;
    c.emissive_scale = frame.emissive_scale;
    c.occlusion_direct = s.occlusion_direct;
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
    flag(s.gamma, FRAME_GAMMA);
    if (s.gamma) {
        c.look.snow_color = shared::srgb_codes(c.look.snow_color);
        c.look.snow_specular = shared::srgb_codes(c.look.snow_specular);
    }
    return c;
}

VisibleWeather visible_weather(const Frame& frame, bool scene_has_constant_weather)
{
    const shared::WeatherMoment& w = frame.weather;
    VisibleWeather visible;
    visible.snow = scene_has_constant_weather || w.snow_amount > 0.0f;
    visible.water = scene_has_constant_weather || w.flood_cracks > 0.0f || w.flood_puddles > 0.0f;
    visible.any = visible.snow || visible.water || w.rain > 0.0f || w.film_albedo > 0.0f ||
                  w.film_smoothness > 0.0f || w.frost > 0.0f;
    return visible;
}

}  // namespace petrichor::gpu
