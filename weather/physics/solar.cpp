#include "weather/physics/solar.h"

#include "weather/physics/constants.h"
#include "weather/physics/detail/formulas.h"

namespace petrichor::weather {

namespace {

double radians(double degrees)
{
    return degrees * (kPi / 180.0);
}

// Sun on a plane that faces it through very clear mountain air: 0.78^(m^0.678) in the manner of
// Meinel 1976, air mass m by Rozenberg 1966.
double clearest_beam_w_m2(double sine_elevation, double extraterrestrial_w_m2)
{
    const double air_mass =
        1.0 / (sine_elevation + 0.025 * detail::exponential(-11.0 * sine_elevation));
    const double path = detail::exponential(0.678 * detail::logarithm(air_mass));
    return extraterrestrial_w_m2 * detail::exponential(path * -0.2484613592984996);  // ln 0.78
}

// Days since 2000-01-01 12:00 UTC; 946728000 s after 1970.
double days_since_2000(std::int64_t unix_us)
{
    return (static_cast<double>(unix_us) * 1e-6 - 946728000.0) / 86400.0;
}

// The sun on its yearly way.
struct Ecliptic {
    double sin_longitude, cos_longitude;
    double cos_tilt;
    double sin_declination, cos_declination;
    double distance_au;
};

// Of 23.439 degrees - 4e-7 a day, for some centuries: by the angle sums, the change is below a thousandth.
detail::SinCos tilt(double days)
{
    constexpr double kSin = 0.39777249434045, kCos = 0.9174840831023592;  // 23.439 degrees
    const double change = 4.0e-7 * (kPi / 180.0) * days;
    const double sin = change * (1.0 - change * change * (1.0 / 6.0));
    const double cos = 1.0 - 0.5 * change * change;
    return {kSin * cos - kCos * sin, kCos * cos + kSin * sin};
}

Ecliptic ecliptic(double days)
{
    const double mean_longitude = 280.460 + 0.9856474 * days;
    const auto anomaly = detail::sine_cosine(radians(357.528 + 0.9856003 * days));
    const double sin_2g = 2.0 * anomaly.sin * anomaly.cos;
    const auto longitude =
        detail::sine_cosine(radians(mean_longitude + 1.915 * anomaly.sin + 0.020 * sin_2g));
    const auto tilted = tilt(days);
    Ecliptic sun;
    sun.sin_longitude = longitude.sin;
    sun.cos_longitude = longitude.cos;
    sun.cos_tilt = tilted.cos;
    sun.sin_declination = tilted.sin * longitude.sin;
    sun.cos_declination = std::sqrt(1.0 - sun.sin_declination * sun.sin_declination);
    sun.distance_au =
        1.00014 - 0.01671 * anomaly.cos - 0.00014 * (2.0 * anomaly.cos * anomaly.cos - 1.0);
    return sun;
}

// The sky turns so many degrees a day.
constexpr double kSiderealDegrees = 360.98564737;

// Angle from the meridian to the vernal equinox.
detail::SinCos sidereal_time(double days, double longitude_deg)
{
    const double turns = (280.46062 + kSiderealDegrees * days + longitude_deg) / 360.0;
    return detail::sine_cosine(2.0 * kPi * (turns - std::floor(turns)));
}

// .. of a small angle, to 1e-14 up to 0.3 rad.
detail::SinCos small_sine_cosine(double x)
{
    if (!(std::abs(x) < 0.3)) return detail::sine_cosine(x);
    const double z = x * x;
    const double s = ((z * (1.0 / 362880.0) - 1.0 / 5040.0) * z + 1.0 / 120.0) * z - 1.0 / 6.0;
    const double c = (((z * (-1.0 / 3628800.0) + 1.0 / 40320.0) * z - 1.0 / 720.0) * z + 1.0 / 24.0) * z - 0.5;
    return {s * z * x + x, c * z + 1.0};
}

}  // namespace

Observer::Observer(double latitude_deg, double longitude) : longitude_deg(longitude)
{
    const auto latitude = detail::sine_cosine(radians(latitude_deg));
    sin_latitude = latitude.sin;
    cos_latitude = latitude.cos;
}

SunDirection sun_direction(std::int64_t unix_us, double latitude_deg, double longitude_deg)
{
    return SunNear(unix_us, Observer(latitude_deg, longitude_deg)).at(unix_us);
}

SunNear::SunNear(std::int64_t middle_us, const Observer& observer)
    : middle_us_(middle_us),
      sin_latitude_(observer.sin_latitude),
      cos_latitude_(observer.cos_latitude)
{
    const double days = days_since_2000(middle_us);
    const Ecliptic sun = ecliptic(days);
    sin_declination_ = sun.sin_declination;
    cos_declination_ = sun.cos_declination;
    // Right ascension enters only through its sine and cosine: no arc tangent is needed.
    const double cos_ascension = sun.cos_longitude / sun.cos_declination;
    const double sin_ascension = sun.cos_tilt * sun.sin_longitude / sun.cos_declination;
    const auto sidereal = sidereal_time(days, observer.longitude_deg);
    cos_hour_ = sidereal.cos * cos_ascension + sidereal.sin * sin_ascension;
    sin_hour_ = sidereal.sin * cos_ascension - sidereal.cos * sin_ascension;
    extraterrestrial_w_m2_ = 1361.0 / (sun.distance_au * sun.distance_au);
}

SunDirection SunNear::at(std::int64_t unix_us) const
{
    constexpr double kTurn_us = kSiderealDegrees * (kPi / 180.0) / 86400.0e6;
    const auto later = small_sine_cosine(static_cast<double>(unix_us - middle_us_) * kTurn_us);
    const double cos_hour = cos_hour_ * later.cos - sin_hour_ * later.sin;
    const double sin_hour = sin_hour_ * later.cos + cos_hour_ * later.sin;
    SunDirection sun;
    sun.east = -cos_declination_ * sin_hour;
    sun.north = cos_latitude_ * sin_declination_ - sin_latitude_ * cos_declination_ * cos_hour;
    sun.up = sin_latitude_ * sin_declination_ + cos_latitude_ * cos_declination_ * cos_hour;
    sun.extraterrestrial_w_m2 = extraterrestrial_w_m2_;
    return sun;
}

SunDirection sun_by_solar_time(double day_of_year, double solar_hour, double latitude_deg)
{
    // Noon of that day in 2001, a year between two leap years; hours past midnight are other days.
    const double days = 366.0 - 0.5 + (day_of_year - 1.0) + solar_hour / 24.0;
    const auto hour = detail::sine_cosine(radians(15.0 * (solar_hour - 12.0)));
    const auto latitude = detail::sine_cosine(radians(latitude_deg));
    const Ecliptic at = ecliptic(days);
    SunDirection sun;
    sun.east = -at.cos_declination * hour.sin;
    sun.north = latitude.cos * at.sin_declination - latitude.sin * at.cos_declination * hour.cos;
    sun.up = latitude.sin * at.sin_declination + latitude.cos * at.cos_declination * hour.cos;
    sun.extraterrestrial_w_m2 = 1361.0 / (at.distance_au * at.distance_au);
    return sun;
}

double sine_of_elevation(double latitude_rad, double declination_rad, double solar_hour)
{
    const auto latitude = detail::sine_cosine(latitude_rad);
    const auto declination = detail::sine_cosine(declination_rad);
    return latitude.sin * declination.sin +
           latitude.cos * declination.cos *
               detail::sine_cosine(radians(15.0 * (solar_hour - 12.0))).cos;
}

double clear_sky_w_m2(double sine_elevation)
{
    if (!(sine_elevation > 0.0)) return 0.0;
    return 1098.0 * sine_elevation * detail::exponential(-0.057 / sine_elevation);
}

namespace {

double sky_w_m2(double sine_elevation, double cloud_fraction, double most_taken)
{
    const double cloud = cloud_fraction > 0.0 ? detail::power(cloud_fraction, 3.4) : 0.0;
    return clear_sky_w_m2(sine_elevation) * (1.0 - most_taken * cloud);
}

}  // namespace

double cloudy_sky_w_m2(double sine_elevation, double cloud_fraction)
{
    return sky_w_m2(sine_elevation, cloud_fraction, 0.75);
}

double rainy_sky_w_m2(double sine_elevation, double cloud_fraction)
{
    return sky_w_m2(sine_elevation, cloud_fraction, 0.84);
}

double cloud_fraction_of(double shortwave_w_m2, double sine_elevation)
{
    const double clear = clear_sky_w_m2(sine_elevation);
    if (!(clear > 0.0)) return 0.0;
    const double lost = detail::unit_clamped((1.0 - shortwave_w_m2 / clear) / 0.75);
    return lost > 0.0 ? detail::power(lost, 1.0 / 3.4) : 0.0;
}

double cloud_fraction_of_diffuse(double diffuse_share)
{
    return std::sqrt(detail::unit_clamped((diffuse_share - 0.3) / 0.7));
}

double erbs_diffuse_fraction(double kt)
{
    if (kt <= 0.22) return 1.0 - 0.09 * kt;
    if (kt > 0.80) return 0.165;
    return 0.9511 + kt * (-0.1604 + kt * (4.388 + kt * (-16.638 + kt * 12.336)));
}

double diffuse_fraction(double shortwave_w_m2, double sine_elevation, double extraterrestrial_w_m2)
{
    // Near the horizon the index is meaningless: everything is diffuse.
    if (!(sine_elevation > 0.05) || !(shortwave_w_m2 > 0.0)) return 1.0;
    const double kt =
        detail::smaller(shortwave_w_m2 / (extraterrestrial_w_m2 * sine_elevation), 1.0);
    const double diffuse = erbs_diffuse_fraction(kt);
    // A hill that faces a low sun must not see more of it than very clear air lets through.
    const double beam = clearest_beam_w_m2(sine_elevation, extraterrestrial_w_m2);
    return detail::larger(diffuse, 1.0 - beam * sine_elevation / shortwave_w_m2);
}

}  // namespace petrichor::weather
