#include "weather/moment.h"

#include <algorithm>
#include <cmath>

#include "formulas/weather/visibility.h"
#include "weather/physics/constants.h"
#include "weather/physics/solar.h"

namespace petrichor::weather {

namespace {

SunAngles angles_of(const SunDirection& sun)
{
    const double azimuth = std::atan2(sun.east, sun.north);
    return {std::asin(std::clamp(sun.up, -1.0, 1.0)),
            azimuth < 0.0 ? azimuth + 2.0 * kPi : azimuth};
}

}  // namespace

SunAngles sun_angles(std::int64_t utc_us, double latitude_deg, double longitude_deg)
{
    return angles_of(sun_direction(utc_us, latitude_deg, longitude_deg));
}

SunAngles sun_angles_by_solar_time(double day_of_year, double solar_hour, double latitude_deg)
{
    return angles_of(sun_by_solar_time(day_of_year, solar_hour, latitude_deg));
}

void set_clock(Moment& moment, std::int64_t utc_us, const Site& site)
{
    moment.utc_us = utc_us;
    if (std::isfinite(site.elevation_m)) moment.elevation_m = site.elevation_m;
    if (!std::isfinite(site.latitude_deg) || !std::isfinite(site.longitude_deg)) return;
    moment.latitude_deg = site.latitude_deg;
    moment.longitude_deg = site.longitude_deg;
    moment.sun = sun_angles(utc_us, site.latitude_deg, site.longitude_deg);
}

bool has_every_row(const ForcingTable& table, Field field)
{
    return table.has(field) && std::none_of(table[field].begin(), table[field].end(),
                                            [](double v) { return std::isnan(v); });
}

void set_measured(shared::WeatherMoment& m, const ForcingTable& table, std::int64_t us)
{
    const auto at = [&](Field field) { return value_at(table, field, us); };
    const auto narrow = [](double value) { return static_cast<float>(value); };
    m.relative_humidity = narrow(at(Field::RelHumidity) / 100.0);
    m.pressure_pa = narrow(at(Field::Pressure));
    m.longwave_down_w_m2 = narrow(at(Field::Longwave));
    const Site& site = table.site;
    if (has_every_row(table, Field::Direct) && has_every_row(table, Field::Diffuse)) {
        m.direct_normal_w_m2 = narrow(at(Field::Direct));
        m.diffuse_horizontal_w_m2 = narrow(at(Field::Diffuse));
    } else if (has_every_row(table, Field::Shortwave) && std::isfinite(site.latitude_deg) &&
               std::isfinite(site.longitude_deg)) {
        const SunDirection sun = sun_direction(us, site.latitude_deg, site.longitude_deg);
        const double global = std::max(at(Field::Shortwave), 0.0);
        const double share = diffuse_fraction(global, sun.up, sun.extraterrestrial_w_m2);
        m.diffuse_horizontal_w_m2 = narrow(global * share);
        m.direct_normal_w_m2 = narrow(sun.up > 0.0 ? global * (1.0 - share) / sun.up : 0.0);
    }
}

glm::vec2 wind_vector_m_s(double speed_m_s, double from_deg)
{
    const double angle = from_deg * kPi / 180.0;
    return {static_cast<float>(-speed_m_s * std::sin(angle)),
            static_cast<float>(speed_m_s * std::cos(angle))};
}

double visibility_in_m(double rain, double snowfall)
{
    const double extinction_1_m = KOSCHMIEDER_2_PERCENT / 20000.0 +
                                  rain * (KOSCHMIEDER_2_PERCENT / 3500.0) +
                                  snowfall * (KOSCHMIEDER_2_PERCENT / 620.0);
    return KOSCHMIEDER_2_PERCENT / extinction_1_m;
}

}  // namespace petrichor::weather
