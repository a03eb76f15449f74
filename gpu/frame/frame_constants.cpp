#include "gpu/frame/frame_constants.h"

#include <algorithm>
#include <cmath>

#include "formulas/color/srgb.h"
#include "formulas/color/white_balance.h"
#include "formulas/light/fog.h"
#include "formulas/light/mist.h"
#include "formulas/light/sun_cookie.h"
#include "formulas/weather/visibility.h"
#include "gpu/frame/sun.h"
#include "scene/basins/water.h"
#include "scene/scene.h"

namespace petrichor::gpu {

namespace {

static_assert(static_cast<int>(FogMode::Metres) == FOG_METRES &&
              static_cast<int>(FogMode::Exp) == FOG_EXP &&
              static_cast<int>(FogMode::Exp2) == FOG_EXP2 &&
              static_cast<int>(FogMode::Linear) == FOG_LINEAR);

}  // namespace

namespace {

// Where moon and stars stand; the lighting pass draws them.
void set_night(shared::FrameConstants& c, const Sky& sky)
{
    c.moon_direction = moon_direction(sky);
    const float solid_angle = 6.42e-5f;
    const float lit = std::max(sky.moon_illuminated, 0.01f);
    c.moon_radiance = moonlight_at_ground(sky) / (solid_angle * lit);
    // Towards the sun, turned so that as much of the disc is lit as is said.
    const glm::vec3 sun = sun_direction(sky);
    const glm::vec3 side = sun - c.moon_direction * glm::dot(sun, c.moon_direction);
    const float length = glm::length(side);
    const float facing = 2.0f * sky.moon_illuminated - 1.0f;
    const glm::vec3 across = length > 1e-4f ? side / length : glm::vec3(0.0f, 1.0f, 0.0f);
    c.moon_lit_from = -c.moon_direction * facing +
                      across * std::sqrt(std::max(1.0f - facing * facing, 0.0f));

    const glm::vec3 south(-std::sin(sky.north_rad), 0.0f, std::cos(sky.north_rad));
    const glm::vec3 west(-std::cos(sky.north_rad), 0.0f, -std::sin(sky.north_rad));
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    const glm::vec3 meridian = std::sin(sky.latitude_rad) * south + std::cos(sky.latitude_rad) * up;
    c.stars_x = std::cos(sky.sidereal_rad) * meridian + std::sin(sky.sidereal_rad) * west;
    c.stars_y = std::sin(sky.sidereal_rad) * meridian - std::cos(sky.sidereal_rad) * west;
    c.stars_z = std::sin(sky.latitude_rad) * up - std::cos(sky.latitude_rad) * south;
}

}  // namespace

float fog_per_m(const Frame& frame)
{
    switch (frame.fog.mode) {
        case FogMode::Off:
            return 0.0f;
        case FogMode::Metres:
            // Koschmieder: 2 % contrast is left at the visibility.
            return static_cast<float>(KOSCHMIEDER_2_PERCENT) /
                   std::max(frame.weather.visibility_m, 1.0f);
        case FogMode::Linear:
            return 1.0f;
        default:
            return frame.fog.per_m;
    }
}

float lens_wetness(const Frame& frame)
{
    const shared::WeatherMoment& w = frame.weather;
    // A lens that was just rained on dries as the ground does; ice on the ground wets none.
    return frame.settings.wet_lens *
           std::clamp((2.0f * w.rain + 0.5f * w.film_albedo) * (1.0f - w.water_to_snow), 0.0f, 1.0f);
}

bool is_white_balanced(const FrameSettings& s)
{
    return s.white_light != glm::vec3(0.0f) || s.white_balance_k > 0.0f;
}

glm::vec3 white_gains(const FrameSettings& s)
{
    if (s.white_light != glm::vec3(0.0f)) return shared::white_balance_gains_of_light(s.white_light, s.white_share);
    return s.white_balance_k > 0.0f ? shared::white_balance_gains(s.white_balance_k) : glm::vec3(1.0f);
}

shared::WeatherMoment with_closed_film(shared::WeatherMoment weather)
{
    // Lux's 0.85 and 0.5 of a wet hour.
    weather.film_albedo = 0.85f;
    weather.film_smoothness = 0.5f;
    return weather;
}

shared::FrameConstants frame_constants(const Frame& frame, const Sun& sun, const Bounds& scene,
                                       std::uint32_t sample_index)
{
    const FrameSettings& s = frame.settings;
    const shared::WeatherMoment& w = frame.weather;
    shared::FrameConstants c{};
    const Camera& camera =
        frame.shutter.empty() ? frame.camera : frame.shutter[sample_index].camera;
    set_camera(c, camera, s.width, s.height, sample_offset(sample_index, s.seed), scene,
               lens_offset(sample_index, s.samples, s.seed) * frame.lens.radius_m, frame.lens.focus_m);
    c.time_s = static_cast<float>(s.time_s);
    c.sample_index = sample_index;
    c.sun_direction = sun.direction;
    c.sun_illuminance = sun.illuminance;
    const glm::vec3 right = shared::sun_cookie_right(sun.direction);
    const float size = frame.sun_cookie.size_m;
    c.cookie_right = right / size;
    c.cookie_down = glm::cross(right, sun.direction) / size;
    c.cookie_texel = frame.sun_cookie.first_texel;
    c.cookie_texel_m = size / scene::kLightProfileSide;
    c.weather = w;
    c.look = frame.look;
    if (frame.place && frame.place->shape->grid.levels > 0) {
        c.weather = with_closed_film(w);
    }
    const float size_m = glm::length(scene.high - scene.low);
    c.ao_radius_m = std::clamp(0.03f * size_m, 0.01f, 0.7f);
    c.ao_strength = 1.0f;
    c.shelter_spread_m = std::clamp(0.01f * size_m, 0.001f, 0.18f);
    c.ambient_scale = s.image_based_light ? 1.0f : 0.0f;
    c.sky_scale = 1.0f;
    // Haze of the weather is skylight: none without it. A fog that was asked for stays.
    const bool veils = s.image_based_light || frame.fog.mode != FogMode::Metres;
    c.fog_per_m = veils ? fog_per_m(frame) : 0.0f;
    c.fog_mode = static_cast<int>(frame.fog.mode);
    c.fog_start_m = frame.fog.start_m;
    c.fog_end_m = frame.fog.end_m;
    c.fog_height_m = frame.fog.height_m;
    c.fog_base_m = scene.low.y;
    c.mist_per_m = veils ? frame.fog.mist_per_m : 0.0f;
    const glm::dvec2 gone = glm::mod(frame.falling.air_m, glm::dvec2(shared::kMistPeriod_m));
    c.mist_air_m = glm::vec2(gone);
    c.white_gains = white_gains(s);
    c.bloom = s.bloom;
    c.wet_lens = lens_wetness(frame);
    c.emissive_scale = frame.emissive_scale;
    c.occlusion_direct = s.occlusion_direct;
    c.horizon_fade = s.horizon_fade;
    // Samples show the variance between them; each is as wide as its share of the pixel.
    c.specular_aa = 0.5f * s.specular_aa / static_cast<float>(std::max(s.samples, 1));
    c.specular_aa_limit = s.specular_aa_limit;
    c.grain_dither = {s.anisotropic_dither, s.anisotropic_dither_distance_m,
                      s.anisotropic_dither_fade_m};
    c.bounce = 0.22f + 0.25f * std::clamp(w.snow_amount, 0.0f, 1.0f);
    c.exposure = s.exposure;
    c.exposure_bias = std::exp2(s.exposure_bias_stops);
    c.samples = static_cast<float>(s.samples);
    c.sun_angular_cos = std::cos(kSunAngularRadius);
    const auto flag = [&c](bool on, std::uint32_t bit) { c.flags |= on ? bit : 0u; };
    flag(s.dither, FRAME_DITHER);
    flag(is_white_balanced(s), FRAME_WHITE_BALANCE);
    flag(s.shelter, FRAME_SHELTER);
    flag(sun.disc, FRAME_SUN_DISC);
    flag(s.gamma, FRAME_GAMMA);
    if (s.gamma) {
        c.look.snow_color = shared::srgb_codes(c.look.snow_color);
        c.look.snow_specular = shared::srgb_codes(c.look.snow_specular);
    }
    set_night(c, frame.sky);
    return c;
}

VisibleWeather visible_weather(const Frame& frame, bool scene_has_constant_weather)
{
    const shared::WeatherMoment& w = frame.weather;
    VisibleWeather visible;
    visible.ground_varies = frame.look.ground_variation > 0.0f;
    visible.snow = scene_has_constant_weather || w.snow_amount > 0.0f;
    visible.frost = w.frost > 0.0f;
    visible.water = scene_has_constant_weather || w.flood_cracks > 0.0f || w.flood_puddles > 0.0f;
    visible.any = visible.snow || visible.water || w.rain > 0.0f || w.film_albedo > 0.0f ||
                  w.film_smoothness > 0.0f || w.frost > 0.0f;
    if (!frame.place) return visible;
    const PlaceWeather& place = *frame.place;
    bool film = false;
    for (std::size_t i = 0; i < place.states.size(); i += PLACE_STATE_TEXELS) {
        const glm::vec4& shown = place.states[i];
        film = film || shown.x > 0.0f || place.states[i + 3].z > 0.0f;
        visible.water = visible.water || shown.y > 0.0f || shown.z > 0.0f;
        visible.snow = visible.snow || shown.w > 0.0f;
        visible.frost = visible.frost || place.states[i + 1].x > 0.0f;
    }
    if (!place.open.empty()) {
        film = film || place.open[0].x > 0.0f || place.open[3].z > 0.0f;
        visible.water = visible.water || place.open[0].y > 0.0f || place.open[0].z > 0.0f;
        visible.snow = visible.snow || place.open[0].w > 0.0f;
        visible.frost = visible.frost || place.open[1].x > 0.0f;
    }
    // Hollows may hold water where no patch does.
    for (std::size_t pit = 1; pit < place.levels_m.size(); ++pit)
        visible.water = visible.water || place.levels_m[pit] > scene::kDry_m;
    // Where all is dry nobody asks where it is.
    visible.any = visible.any || film || visible.water || visible.snow || visible.frost;
    visible.place = visible.any;
    return visible;
}

}  // namespace petrichor::gpu
