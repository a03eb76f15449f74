#include "gpu/frame/sun.h"

#include <algorithm>
#include <cmath>

#include "formulas/light/atmosphere.h"
#include "gpu/frame/view.h"

namespace petrichor::gpu {

namespace {

float cloud_shadow(float cover)
{
    return 1.0f - glm::smoothstep(0.25f, 0.95f, cover);
}

glm::vec3 direction_of(float elevation_rad, float azimuth_rad)
{
    const float level = std::cos(elevation_rad);
    return {level * std::sin(azimuth_rad), std::sin(elevation_rad),
            -level * std::cos(azimuth_rad)};
}

}  // namespace

glm::vec3 sun_direction(const Sky& sky)
{
    return direction_of(sky.sun_elevation_rad, sky.sun_azimuth_rad);
}

glm::vec3 toward_sun_disc(const glm::vec3& middle, std::uint32_t sample, int samples, std::uint32_t seed)
{
    const glm::vec2 at = lens_offset(sample, samples, seed + 7u) * std::tan(kSunAngularRadius);
    const glm::vec3 side =
        glm::normalize(glm::cross(middle, std::abs(middle.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
    return glm::normalize(middle + side * at.x + glm::cross(middle, side) * at.y);
}

glm::vec3 moon_direction(const Sky& sky)
{
    return direction_of(sky.moon_elevation_rad, sky.moon_azimuth_rad);
}

glm::vec3 moonlight_at_ground(const Sky& sky)
{
    const float up = std::sin(sky.moon_elevation_rad);
    if (!(sky.moon_lux > 0.0f) || up <= -0.01f) return glm::vec3(0.0f);
    return shared::air_transmittance(2.0f, std::max(up, 0.0f), sky.turbidity) *
           (sky.moon_lux * glm::smoothstep(-0.01f, 0.015f, up));
}

glm::vec3 sunlight_at_ground(const Sky& sky)
{
    const float up = std::sin(sky.sun_elevation_rad);
    const float risen = glm::smoothstep(-0.01f, 0.015f, up);
    return shared::air_transmittance(2.0f, std::max(up, 0.0f), sky.turbidity) *
           (sky.sun_illuminance * risen);
}

Sun sun_of(const Sky& sky, const Light* scene_sun, bool has_environment)
{
    Sun sun;
    sun.shadow_strength = sky.sun_shadow_strength;
    if (sky.analytic_sun) {
        sun.direction = sun_direction(sky);
        sun.illuminance = sunlight_at_ground(sky) * cloud_shadow(sky.cloud_cover);
        sun.disc = !has_environment;
        sun.analytic = !has_environment;
        sun.kind = LightFacts::Direct::Sun;
        if (sun.illuminance == glm::vec3(0.0f) && !has_environment && sky.sun_elevation_rad < 0.0f) {
            sun.direction = moon_direction(sky);
            sun.illuminance = moonlight_at_ground(sky) * cloud_shadow(sky.cloud_cover);
            sun.disc = false;
            sun.kind = LightFacts::Direct::Moon;
        }
    } else if (scene_sun) {
        sun.direction = -scene_sun->direction;
        sun.illuminance = scene_sun->color * scene_sun->intensity;
        sun.shadow_strength *= scene_sun->shadow_strength;
        sun.kind = LightFacts::Direct::Scene;
    }
    if (sun.illuminance == glm::vec3(0.0f)) sun.kind = LightFacts::Direct::None;
    return sun;
}

}  // namespace petrichor::gpu
