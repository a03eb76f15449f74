#include "film/jobs/sun.h"

#include <algorithm>
#include <cmath>

namespace petrichor::film {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;

}  // namespace

SunDirection solar_position(double latitude_rad, double day_of_year, double hours)
{
    const double declination =
        23.45 * kDegree * std::sin(2.0 * kPi * (284.0 + day_of_year) / 365.0);
    const double hour_angle = (hours - 12.0) * 15.0 * kDegree;  // positive in the afternoon
    const double sin_elevation =
        std::sin(latitude_rad) * std::sin(declination) +
        std::cos(latitude_rad) * std::cos(declination) * std::cos(hour_angle);
    // East and north components of the direction to the sun.
    const double east = -std::cos(declination) * std::sin(hour_angle);
    const double north = std::cos(latitude_rad) * std::sin(declination) -
                         std::sin(latitude_rad) * std::cos(declination) * std::cos(hour_angle);
    double azimuth = std::atan2(east, north);
    if (azimuth < 0.0) azimuth += 2.0 * kPi;
    return {std::asin(std::clamp(sin_elevation, -1.0, 1.0)), azimuth};
}

SunDirection direction_against(const glm::vec3& travel)
{
    const glm::dvec3 to_sun = -glm::normalize(glm::dvec3(travel));
    double azimuth = std::atan2(to_sun.x, -to_sun.z);
    if (azimuth < 0.0) azimuth += 2.0 * kPi;
    return {std::asin(std::clamp(to_sun.y, -1.0, 1.0)), azimuth};
}

SunDirection sun_at(const ScenarioSun& sun, const scene::Scene& scene, double time_s)
{
    SunDirection direction{35.0 * kDegree, 140.0 * kDegree};
    for (const scene::Light& light : scene.lights) {
        if (light.kind == scene::LightKind::Directional) {
            direction = direction_against(light.direction);
            break;
        }
    }
    if (sun.time_of_day_hours.given()) {
        direction = solar_position(sun.latitude_degrees * kDegree, sun.day_of_year,
                                   value_at(sun.time_of_day_hours, time_s));
    }
    if (sun.elevation_degrees.given()) {
        direction.elevation_rad = value_at(sun.elevation_degrees, time_s) * kDegree;
    }
    if (sun.azimuth_degrees.given()) {
        direction.azimuth_rad = value_at(sun.azimuth_degrees, time_s) * kDegree;
    }
    return direction;
}

}  // namespace petrichor::film
