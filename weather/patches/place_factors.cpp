#include "weather/patches/place_factors.h"

#include <algorithm>

#include "weather/patches/driving_rain.h"
#include "weather/physics/constants.h"
#include "weather/physics/detail/portable_math.h"
#include "weather/physics/solar.h"

namespace petrichor::weather {

namespace {

constexpr double kBlockedWind = 0.75;  // of the wind that full blocking takes
constexpr double kDeepestShade = 0.2;  // of the freezing in the open: under a roof too it freezes
constexpr int kHours = 12;

// Sun of a day on the patch over that on open flat ground, at most 1.
double sun_share(const WeatherPatch& patch, const PlaceClimate& climate)
{
    const auto north = detail::sine_cosine(climate.north_deg * (kPi / 180.0));
    double here = 0.0, open = 0.0;
    for (int i = 0; i < kHours; ++i) {
        const SunDirection sun = sun_by_solar_time(
            climate.day_of_year, 6.5 + static_cast<double>(i), climate.latitude_deg);
        if (!(sun.up > 0.0)) continue;
        const Direction towards{sun.east * north.cos + sun.north * north.sin, sun.up,
                                sun.east * north.sin - sun.north * north.cos};
        open += sun.up;
        here += std::max(0.0, dot(patch.normal, towards)) *
                visible_share(patch.visible, visible_lookup(towards));
    }
    return open > 0.0 ? std::min(1.0, here / open) : 1.0;
}

}  // namespace

PlaceFactors place_factors(const WeatherPatch& patch, const PatchKind& kind,
                           const PlaceClimate& climate)
{
    const double from = (climate.wind_from_deg + climate.north_deg) * (kPi / 180.0);
    const auto around = detail::sine_cosine(from);
    const double wind_x = -climate.wind_m_s * around.sin, wind_z = climate.wind_m_s * around.cos;
    const SkyShares shares = sky_shares(patch.visible, patch.normal);
    PlaceFactors f;
    f.rain = rain_on_plane(patch.normal, wind_x, wind_z, climate.rain_mm_h) *
             rain_share(patch.visible, rain_fan(wind_x, wind_z, climate.rain_mm_h)) *
             patch.wall_factor;
    const double wind = 1.0 - kBlockedWind * blocking_from(wind_blocking(patch.visible), from);
    f.drying = 0.5 * (sun_share(patch, climate) + wind);
    const double sky = patch.sky_share < 0.0 ? shares.sky : patch.sky_share;
    f.freezing = kDeepestShade + (1.0 - kDeepestShade) * std::min(1.0, sky);
    const double up = std::clamp(patch.normal.y, 0.0, 1.0);
    const double holds = kind.holds_by_tilt ? snow_holds(detail::arc_cosine(up)) : 1.0;
    f.snow = up * holds *
             (0.5 * visible_share(patch.visible, visible_lookup(snow_direction(wind_x, wind_z))) +
              0.5 * shares.zenith);
    return f;
}

}  // namespace petrichor::weather
