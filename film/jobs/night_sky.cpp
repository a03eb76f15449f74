#include "film/jobs/night_sky.h"

#include <algorithm>
#include <cmath>

namespace petrichor::film {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;

double sin_deg(double degrees)
{
    return std::sin(degrees * kDegree);
}
double cos_deg(double degrees)
{
    return std::cos(degrees * kDegree);
}

// Days since 2000-01-01 12:00.
double days_of(std::int64_t utc_us)
{
    return static_cast<double>(utc_us) / 86400e6 - 10957.5;
}

double sidereal_deg(double days, double longitude_deg)
{
    return std::fmod(280.46062 + 360.98564737 * days + longitude_deg, 360.0);
}

// Elevation and azimuth of an hour angle (west of south) and a declination.
weather::SunAngles angles_of(double hour_rad, double declination_rad, double latitude_rad)
{
    const double up = std::sin(latitude_rad) * std::sin(declination_rad) +
                      std::cos(latitude_rad) * std::cos(declination_rad) * std::cos(hour_rad);
    const double south = std::sin(latitude_rad) * std::cos(declination_rad) * std::cos(hour_rad) -
                         std::cos(latitude_rad) * std::sin(declination_rad);
    const double west = std::cos(declination_rad) * std::sin(hour_rad);
    double azimuth = std::atan2(-west, -south);
    if (azimuth < 0.0) azimuth += 2.0 * kPi;
    return {std::asin(std::clamp(up, -1.0, 1.0)), azimuth};
}

}  // namespace

double moon_lux(double illuminated)
{
    const double phase_deg = std::acos(std::clamp(2.0 * illuminated - 1.0, -1.0, 1.0)) / kDegree;
    const double magnitude = -12.73 + 0.026 * phase_deg + 4e-9 * std::pow(phase_deg, 4.0);
    return std::pow(10.0, -0.4 * (magnitude + 14.18));
}

MoonAt moon_by_place(std::int64_t utc_us, double latitude_deg, double longitude_deg)
{
    const double d = days_of(utc_us);
    const double mean = 218.316 + 13.176396 * d;     // longitude
    const double anomaly = 134.963 + 13.064993 * d;  // of the moon
    const double from_node = 93.272 + 13.229350 * d;
    const double from_sun = 297.850 + 12.190749 * d;  // mean elongation
    const double sun_anomaly = 357.529 + 0.98560028 * d;
    const double longitude = mean + 6.289 * sin_deg(anomaly) +
                             1.274 * sin_deg(2.0 * from_sun - anomaly) +
                             0.658 * sin_deg(2.0 * from_sun) + 0.214 * sin_deg(2.0 * anomaly) -
                             0.186 * sin_deg(sun_anomaly) - 0.114 * sin_deg(2.0 * from_node);
    const double latitude = 5.128 * sin_deg(from_node) + 0.281 * sin_deg(anomaly + from_node) +
                            0.278 * sin_deg(anomaly - from_node) +
                            0.173 * sin_deg(2.0 * from_sun - from_node);
    const double sun_longitude =
        280.460 + 0.9856474 * d + 1.915 * sin_deg(sun_anomaly) + 0.020 * sin_deg(2.0 * sun_anomaly);
    MoonAt moon;
    const double elongation = cos_deg(latitude) * cos_deg(longitude - sun_longitude);
    moon.illuminated = 0.5 * (1.0 - elongation);

    const double tilt = 23.439;
    const double x = cos_deg(latitude) * cos_deg(longitude);
    const double y =
        cos_deg(tilt) * cos_deg(latitude) * sin_deg(longitude) - sin_deg(tilt) * sin_deg(latitude);
    const double z =
        sin_deg(tilt) * cos_deg(latitude) * sin_deg(longitude) + cos_deg(tilt) * sin_deg(latitude);
    const double ascension = std::atan2(y, x);
    const double declination = std::asin(std::clamp(z, -1.0, 1.0));
    const double hour = sidereal_deg(d, longitude_deg) * kDegree - ascension;
    moon.angles = angles_of(hour, declination, latitude_deg * kDegree);
    // Seen from the surface, not from the middle of the earth.
    moon.angles.elevation_rad -= 0.9507 * kDegree * std::cos(moon.angles.elevation_rad);
    moon.lux = moon_lux(moon.illuminated);
    return moon;
}

double sidereal_rad(std::int64_t utc_us, double longitude_deg)
{
    return sidereal_deg(days_of(utc_us), longitude_deg) * kDegree;
}

NightSky night_sky_at(const ScenarioMoon& keys, const ScenarioSun& sun,
                      const weather::Moment& moment, const weather::SunAngles& sun_angles,
                      double time_s)
{
    NightSky sky;
    const bool placed = moment.utc_us && moment.latitude_deg && moment.longitude_deg;
    sky.latitude_rad = (placed ? *moment.latitude_deg : sun.latitude_degrees) * kDegree;
    if (placed) {
        sky.moon = moon_by_place(*moment.utc_us, *moment.latitude_deg, *moment.longitude_deg);
        sky.sidereal_rad = sidereal_rad(*moment.utc_us, *moment.longitude_deg);
    } else {
        // The sun's hour angle, and where on the ecliptic it is on that day.
        const double e = sun_angles.elevation_rad;
        const double a = sun_angles.azimuth_rad;
        const double west = -std::cos(e) * std::sin(a);
        const double south = -std::cos(e) * std::cos(a);
        const double high =
            std::sin(e) * std::cos(sky.latitude_rad) + south * std::sin(sky.latitude_rad);
        const double longitude = (sun.day_of_year - 80.0) * 0.98565 * kDegree;
        const double ascension =
            std::atan2(cos_deg(23.439) * std::sin(longitude), std::cos(longitude));
        sky.sidereal_rad = std::atan2(west, high) + ascension;
    }
    if (keys.elevation_degrees.given() || keys.azimuth_degrees.given() ||
        keys.illuminated.given()) {
        MoonAt moon = sky.moon.value_or(MoonAt{{30.0 * kDegree, 180.0 * kDegree}, 1.0, 0.0});
        moon.angles.elevation_rad =
            value_at(keys.elevation_degrees, time_s, moon.angles.elevation_rad / kDegree) * kDegree;
        moon.angles.azimuth_rad =
            value_at(keys.azimuth_degrees, time_s, moon.angles.azimuth_rad / kDegree) * kDegree;
        moon.illuminated = value_at(keys.illuminated, time_s, moon.illuminated);
        moon.lux = moon_lux(moon.illuminated);
        sky.moon = moon;
    }
    return sky;
}

}  // namespace petrichor::film
