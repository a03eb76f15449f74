#ifndef PETRICHOR_WEATHER_PHYSICS_SOLAR_H
#define PETRICHOR_WEATHER_PHYSICS_SOLAR_H

#include <cstdint>

namespace petrichor::weather {

/// Where the sun stands. East is +x, north is +y, up is +z.
struct SunDirection {
    double east = 0.0, north = 0.0, up = 0.0;  ///< unit vector; `up` is the sine of the elevation
    double extraterrestrial_w_m2 = 1361.0;     ///< on a plane facing the sun, outside the air
};

/// Sun for a UTC time (microseconds since 1970) and place. Good to 0.1 degrees from 1950 to 2050.
///   latitude, longitude  degrees, north and east positive
///   source               low-precision solar coordinates of the Astronomical Almanac
SunDirection sun_direction(std::int64_t unix_us, double latitude_deg, double longitude_deg);

/// Where the sun is looked at from.
struct Observer {
    Observer(double latitude_deg, double longitude_deg);
    double sin_latitude, cos_latitude;
    double longitude_deg;
};

/// The sun about a moment, for many times within an hour of it: where sun_direction has it, to 0.05
/// degrees, at a tenth of the cost.
class SunNear {
public:
    SunNear(std::int64_t middle_us, const Observer& observer);
    SunDirection at(std::int64_t unix_us) const;

private:
    std::int64_t middle_us_;
    double sin_latitude_, cos_latitude_, sin_declination_, cos_declination_;
    double sin_hour_, cos_hour_;  // of the angle from the meridian, at the middle
    double extraterrestrial_w_m2_;
};

/// Sun by solar time (12 = noon, the sun in the south or north; hours beyond 0..24 are other days)
/// on a day of the year (1..366), with the declination that the function above has at that noon.
SunDirection sun_by_solar_time(double day_of_year, double solar_hour, double latitude_deg);

/// Sine of the solar elevation from the declination and the solar time in hours (12 = noon).
double sine_of_elevation(double latitude_rad, double declination_rad, double solar_hour);

/// Clear-sky shortwave on flat ground, Haurwitz 1945: 1098 s exp(-0.057/s); 0 at night.
double clear_sky_w_m2(double sine_elevation);
/// The same under clouds, Kasten & Czeplak 1980: G0 (1 - 0.75 N^3.4).
double cloudy_sky_w_m2(double sine_elevation, double cloud_fraction);
/// The same where something falls, from nimbostratus, which lets 0.16 of the clear sky's light
/// through where other overcast lets 0.25 (their table 2): G0 (1 - 0.84 N^3.4).
double rainy_sky_w_m2(double sine_elevation, double cloud_fraction);
/// The inverse: cloud fraction 0..1 from measured shortwave; 0 at or above the clear sky.
double cloud_fraction_of(double shortwave_w_m2, double sine_elevation);

/// Cloud fraction 0..1 from the share of shortwave that is diffuse, 0..1: the inverse of 0.3 + 0.7 N^2
/// (Kasten & Czeplak 1980). Unlike that of shortwave it does not depend on how clear the air is.
double cloud_fraction_of_diffuse(double diffuse_share);

/// Share of shortwave that is diffuse, 0..1, by the clearness index, >= 0 (Erbs, Klein & Duffie
/// 1982).
double erbs_diffuse_fraction(double clearness);
/// Share of shortwave that is diffuse, 0..1, from the clearness index (Erbs et al. 1982), and so
/// much that the direct beam stays below that of very clear air: sensors catch light from a low sun
/// that the index takes for a fierce beam.
double diffuse_fraction(double shortwave_w_m2, double sine_elevation, double extraterrestrial_w_m2);

}  // namespace petrichor::weather

#endif
