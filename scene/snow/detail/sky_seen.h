// How much of the sky the ground below the snow sees.
#ifndef PETRICHOR_SCENE_SNOW_DETAIL_SKY_SEEN_H
#define PETRICHOR_SCENE_SNOW_DETAIL_SKY_SEEN_H

#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <unordered_map>

#include "scene/patches/tracer.h"
#include "scene/subdivide/subdivide.h"

namespace petrichor::scene::detail {

struct PlaceHash {
    std::size_t operator()(const glm::vec3& p) const
    {
        std::size_t h = 0;
        for (const float v : {p.x, p.y, p.z}) h = h * 0x9e3779b97f4a7c15ull + std::bit_cast<std::uint32_t>(v + 0.0f);
        return h ^ (h >> 29);
    }
};

/// What has been seen of the sky from a place (world, m), by its bits: a share, 0..1.
using SkySeen = std::unordered_map<glm::vec3, float, PlaceHash>;

/// Share of the sky overhead that points see, 0..1, into w of _WEATHER, but for those `seen` already; fills `seen`. A corner
/// is looked at a bit within its triangle: it may lie in a wall. Points within a solid have what points beside it see: snow
/// goes on into what stands in it.
void look_up(CutMesh& mesh, const Tracer& tracer, SkySeen& seen);

}  // namespace petrichor::scene::detail

#endif
