#include "weather/patches/place_factors.h"

#include <algorithm>

#include "weather/patches/driving_rain.h"
#include "weather/physics/constants.h"
#include "weather/physics/detail/portable_math.h"
#include "weather/physics/solar.h"

namespace petrichor::weather {

namespace {

constexpr double kBlockedWind = 0.75;  // of the wind that full blocking takes
constexpr double kNoShare = 1e-6;
constexpr double kDeepestShade = 0.2;  // of the freezing in the open: under a roof too it freezes

// Sun of a day on the patch over that on open flat ground, at most 1.
double sun_share(const WeatherPatch& patch, const SunPath& path)
{
    double here = 0.0, open = 0.0;
    for (std::size_t i = 0; i < SunPath::kHours; ++i) {
        const Direction& towards = path.towards[i];
        if (!(towards.y > 0.0)) continue;
        open += towards.y;
        here += std::max(0.0, dot(patch.normal, towards)) * visible_share(patch.visible, path.at[i]);
    }
    return open > 0.0 ? std::min(1.0, here / open) : 1.0;
}

}  // namespace

SunPath sun_path(const PlaceClimate& climate)
{
    SunPath path{};
    const auto north = detail::sine_cosine(climate.north_deg * (kPi / 180.0));
    for (std::size_t i = 0; i < SunPath::kHours; ++i) {
        const SunDirection sun = sun_by_solar_time(
            climate.day_of_year, 6.5 + static_cast<double>(i), climate.latitude_deg);
        path.towards[i] = {sun.east * north.cos + sun.north * north.sin, sun.up,
                           sun.east * north.sin - sun.north * north.cos};
        if (sun.up > 0.0) path.at[i] = visible_lookup(path.towards[i]);
    }
    return path;
}

PlaceFactors place_factors(const WeatherPatch& patch, const PatchKind& kind,
                           const PlaceClimate& climate)
{
    const WeightedClimate alone{climate, 1.0};
    return place_factors(patch, kind, std::span(&alone, 1), sun_path(climate));
}

PlaceFactors place_factors(const WeatherPatch& patch, const PatchKind& kind,
                           std::span<const WeightedClimate> climates, const SunPath& path)
{
    const SkyShares shares = sky_shares(patch.visible, patch.normal);
    const auto blocked = wind_blocking(patch.visible);
    const double up = std::clamp(patch.normal.y, 0.0, 1.0);
    const double holds = kind.holds_by_tilt ? snow_holds(detail::arc_cosine(up)) : 1.0;
    PlaceFactors f{0.0, 0.0, 0.0, 0.0};
    for (const WeightedClimate& one : climates) {
        const PlaceClimate& climate = one.climate;
        const double from = (climate.wind_from_deg + climate.north_deg) * (kPi / 180.0);
        const auto around = detail::sine_cosine(from);
        const double wind_x = -climate.wind_m_s * around.sin, wind_z = climate.wind_m_s * around.cos;
        const double wind = 1.0 - kBlockedWind * blocking_from(blocked, from);
        // A drop that has passed the roof upwind falls the rest of its way in the wind behind it: drops
        // take the speed of the air within a second. In a gale a street would be dry else.
        const double rain = rain_on_plane(patch.normal, wind_x, wind_z, climate.rain_mm_h);
        if (rain > 0.0) {
            const RainFan fan = rain_fan(wind * wind_x, wind * wind_z, climate.rain_mm_h);
            const double share = rain_share(patch.visible, fan);
            // Parts of what is hidden add up to one but for a float's rounding.
            if (share > kNoShare) f.rain += one.weight * rain * share * patch.wall_factor;
        }
        f.drying += one.weight * wind;
        f.snow += one.weight *
                  visible_share(patch.visible, visible_lookup(snow_direction(wind_x, wind_z)));
    }
    f.drying = 0.5 * (sun_share(patch, path) + f.drying);
    const double sky = patch.sky_share < 0.0 ? shares.sky : patch.sky_share;
    f.freezing = kDeepestShade + (1.0 - kDeepestShade) * std::min(1.0, sky);
    f.snow = up * holds * (0.5 * f.snow + 0.5 * shares.zenith);
    return f;
}

}  // namespace petrichor::weather
