#ifndef PETRICHOR_WEATHER_PATCHES_VISIBILITY_H
#define PETRICHOR_WEATHER_PATCHES_VISIBILITY_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace petrichor::weather {

/// A direction of the world: x and z horizontal, y up (renderer's axes, not east and north).
struct Direction {
    double x = 0.0, y = 1.0, z = 0.0;
};
inline double dot(const Direction& a, const Direction& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// From an azimuth, clockwise from north, and an elevation. `north_rad` turns the scene: the
/// azimuth, clockwise from its -z, in which north lies.
Direction direction_of(double azimuth_rad, double elevation_rad, double north_rad = 0.0);

/// What a patch sees of the upper hemisphere: 16 x 16 bits on an octahedron about +y, bit
/// `y * 16 + x` of `visible_texel` (x, y), 1 where a ray leaves the scene. Bits of directions that
/// the patch faces away from are 0.
using VisibleBits = std::array<std::uint32_t, 8>;
inline constexpr int kVisibleAcross = 16;
inline constexpr int kVisibleBits = kVisibleAcross * kVisibleAcross;

inline bool sees(const VisibleBits& bits, int texel)
{
    return ((bits[static_cast<std::size_t>(texel >> 5)] >> (texel & 31)) & 1u) != 0u;
}
/// Direction of a bit, unit, and the solid angle it stands for; all of them add up to 2 pi.
Direction visible_direction(int texel);
double visible_solid_angle_sr(int texel);
/// All of the sky: what the open plane of a normal sees.
VisibleBits open_sky(const Direction& normal);

/// Where a direction is looked up: four bits and their weights, which add up to 1; none below the
/// horizon.
struct VisibleLookup {
    std::array<std::int16_t, 4> texel{};
    std::array<float, 4> weight{};
    bool above = false;  ///< the horizon
};
VisibleLookup visible_lookup(const Direction& direction);
inline double visible_share(const VisibleBits& bits, const VisibleLookup& at)
{
    if (!at.above) return 0.0;
    float blocked = 0.0f;  // so that open sky is exactly 1
    for (std::size_t i = 0; i < 4; ++i)
        if (!sees(bits, at.texel[i])) blocked += at.weight[i];
    return 1.0 - static_cast<double>(blocked);
}

/// Shares of a hemisphere that weather asks for, all from the bits and the normal.
struct SkyShares {
    double sky = 1.0;         ///< (1/pi) integral of V (n.w)+ over the sky: flat and open 1
    double horizon = 1.0;     ///< V over elevations 0..7 degrees, weighted by (n.w)+
    double zenith = 1.0;      ///< V within 30 degrees of the zenith
    double log_secant = 0.5;  ///< mean of ln sec z over the sky that is seen; 1/2 flat and open
};
SkyShares sky_shares(const VisibleBits& bits, const Direction& normal);

/// Azimuths of the wind for which its blocking is kept.
inline constexpr std::size_t kWindClasses = 16;
/// Share of directions within 45 degrees of upwind and below 27 degrees that is blocked, by where
/// the wind comes from: class i is azimuth i * 22.5 degrees, clockwise from the scene's -z. Weight:
/// cosine of the difference in azimuth.
std::array<float, kWindClasses> wind_blocking(const VisibleBits& bits);
/// Between two classes.
double blocking_from(const std::array<float, kWindClasses>& blocked, double azimuth_rad);

}  // namespace petrichor::weather

#endif
