#include "film/jobs/sun.h"

#include <algorithm>
#include <cmath>

#include "gpu/frame/sun.h"

namespace petrichor::film {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;
constexpr float kBrightest_lux = 200000.0f;  // as [sun] illuminance_lux

}  // namespace

weather::SunAngles direction_against(const glm::vec3& travel, double north_rad)
{
    const glm::dvec3 to_sun = -glm::normalize(glm::dvec3(travel));
    double azimuth = std::atan2(to_sun.x, -to_sun.z) - north_rad;
    if (azimuth < 0.0) azimuth += 2.0 * kPi;
    return {std::asin(std::clamp(to_sun.y, -1.0, 1.0)), azimuth};
}

weather::SunAngles sun_at(const ScenarioSun& sun, const scene::Scene& scene,
                          const weather::Moment& moment, double north_rad, double time_s,
                          const scene::Posture* posture)
{
    weather::SunAngles direction{35.0 * kDegree, 140.0 * kDegree};
    for (const scene::Light& light : scene.lights) {
        if (light.kind == scene::LightKind::Directional) {
            const scene::Light here = posture ? scene::carried(light, *posture) : light;
            direction = direction_against(here.direction, north_rad);
            break;
        }
    }
    if (moment.sun) direction = *moment.sun;
    if (sun.yields && moment.sun && !moment.utc_us) return direction;
    if (sun.time_of_day_hours.given()) {
        direction = weather::sun_angles_by_solar_time(
            sun.day_of_year, value_at(sun.time_of_day_hours, time_s), sun.latitude_degrees);
    }
    if (sun.elevation_degrees.given()) {
        direction.elevation_rad = value_at(sun.elevation_degrees, time_s) * kDegree;
    }
    if (sun.azimuth_degrees.given()) {
        direction.azimuth_rad = value_at(sun.azimuth_degrees, time_s) * kDegree;
    }
    return direction;
}

std::optional<float> illuminance_of_scene(const scene::Scene& scene, const gpu::Sky& sky)
{
    const auto light =
        std::find_if(scene.lights.begin(), scene.lights.end(), [](const scene::Light& l) {
            return l.kind == scene::LightKind::Directional;
        });
    if (light == scene.lights.end()) return std::nullopt;
    const glm::vec3 weights(0.2126f, 0.7152f, 0.0722f);
    const float lux = light->intensity * glm::dot(light->color, weights);
    if (!(lux > 0.0f)) return std::nullopt;
    gpu::Sky clear = sky;
    clear.sun_illuminance = 1.0f;
    clear.sun_elevation_rad =
        static_cast<float>(std::max(direction_against(light->direction).elevation_rad, 10.0 * kDegree));
    return std::min(lux / glm::dot(gpu::sunlight_at_ground(clear), weights), kBrightest_lux);
}

}  // namespace petrichor::film
