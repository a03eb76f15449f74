#ifndef PETRICHOR_FILM_JOBS_NIGHT_SKY_H
#define PETRICHOR_FILM_JOBS_NIGHT_SKY_H

#include <optional>

#include "film/scenario/scenario.h"
#include "weather/moment.h"

namespace petrichor::film {

/// The moon over a place.
struct MoonAt {
    weather::SunAngles angles;
    double illuminated = 1.0;  ///< share of its disc, 0..1
    double lux = 0.0;          ///< above the air, on a plane that faces it
};

/// Lux of a moon with this share of its disc lit: Krisciunas and Schaefer 1991, 0.26 when full.
double moon_lux(double illuminated);

/// Of a UTC time and a place, good to about half a degree (Meeus 1998, the largest terms; parallax
/// is in).
MoonAt moon_by_place(std::int64_t utc_us, double latitude_deg, double longitude_deg);

/// Turns of the sky: where the vernal equinox stands in the local sky, radians, west of south.
double sidereal_rad(std::int64_t utc_us, double longitude_deg);

/// What stands in the night sky of a frame.
struct NightSky {
    std::optional<MoonAt> moon;
    double latitude_rad = 0.0;
    double sidereal_rad = 0.0;
};

/// From the keys of [moon], else from clock and place of the weather. Without a clock there is no
/// moon but that of the keys, and the stars stand as the sun says: by its hour angle at the day of
/// the year of [sun].
NightSky night_sky_at(const ScenarioMoon& moon, const ScenarioSun& sun,
                      const weather::Moment& moment, const weather::SunAngles& sun_angles,
                      double time_s);

}  // namespace petrichor::film

#endif
