#ifndef PETRICHOR_TEXPROC_STUDY_DETAIL_MADE_SURFACE_H
#define PETRICHOR_TEXPROC_STUDY_DETAIL_MADE_SURFACE_H

#include <cmath>
#include <cstdint>
#include <string>

#include "texproc/image/raw_image.h"
#include "texproc/study/scored_maps.h"

// What materials made from code for the yardstick share: random numbers by place, and maps from
// slopes.
namespace petrichor::texproc::detail {

inline std::uint32_t place_hash(std::uint32_t x, std::uint32_t y, std::uint32_t which)
{
    std::uint32_t h = x * 0x9e3779b9u ^ y * 0x85ebca6bu ^ which * 0xc2b2ae35u;
    h ^= h >> 15;
    h *= 0x2c1b3c6du;
    h ^= h >> 12;
    h *= 0x297a2d39u;
    return h ^ (h >> 15);
}

/// A stream of random numbers for a place, by number.
struct Place {
    std::uint32_t x, y;
    float uniform(std::uint32_t which) const
    {
        return static_cast<float>(place_hash(x, y, which) >> 8) / 16777216.0f;
    }
    float gaussian(std::uint32_t which) const
    {
        return std::sqrt(-2.0f * std::log(1.0f - uniform(2 * which))) *
               std::cos(6.2831853f * uniform(2 * which + 1));
    }
};

inline Place place(int x, int y)
{
    return {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
}

struct MadeTexel {
    float slope_x = 0.0f, slope_y = 0.0f, p = 0.5f;
};

/// surface(x, y) -> MadeTexel
template <class Surface>
ScoredMaps made_material(std::string name, int width, int height, const Surface& surface)
{
    Image n(width, height, 3, ColorSpace::Data), r(width, height, 1, ColorSpace::Data);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const MadeTexel t = surface(x, y);
            const float length = std::sqrt(1.0f + t.slope_x * t.slope_x + t.slope_y * t.slope_y);
            n.at(x, y, 0) = 0.5f - 0.5f * t.slope_x / length;
            n.at(x, y, 1) = 0.5f - 0.5f * t.slope_y / length;
            n.at(x, y, 2) = 0.5f + 0.5f / length;
            r.at(x, y, 0) = t.p;
        }
    }
    return {std::move(name), to_raw(n, PixelType::U16), to_raw(r, PixelType::U16)};
}

}  // namespace petrichor::texproc::detail

#endif
