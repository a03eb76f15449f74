#ifndef PETRICHOR_SCENE_DRIPS_DRIP_POINTS_H
#define PETRICHOR_SCENE_DRIPS_DRIP_POINTS_H

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/patches/tracer.h"

namespace petrichor::scene {

/// A point of an edge that lets water go, drop by drop.
struct DripPoint {
    glm::vec3 from_m{0.0f};         ///< where drops come off: below what the water runs down over the edge
    float ground_m = 0.0f;          ///< height of what is met straight below
    float drained_m2 = 0.0f;        ///< in plan: what is open to the sky and runs off here
    std::uint32_t number = 0;       ///< follows from its place: what is hashed
    std::uint32_t gutter = 0;       ///< 1: what catches it takes the water away; where that is frozen it runs over there
    glm::vec2 out{0.0f};            ///< away from the surface above, unit, world x and z
};

struct DripOptions {
    std::size_t most_points = 16384;             ///< those of the longest edges
    bool gutters = false;                          ///< points below the outer sides of what catches the water, too
    std::span<const std::uint8_t> left_out = {};  ///< by material, 1: lets no drops go, as leaves; may be shorter
};

/// Where water drips from: the nearly level lower edges of what faces up and is open to the sky, as of
/// roofs, awnings, sills, beams. None where something lies within 0.3 m below (a gutter, the next row of
/// tiles, the ground), where a wall goes on below, where a roof is above all that would drain there, and where
/// nothing lies within 30 m below: the rim of the scene.
///
/// The longest edges first, a point every 4 cm in the mean. Alike for any order of asking: made by one thread.
std::vector<DripPoint> drip_points(const Tracer& tracer, const DripOptions& options = {});

}  // namespace petrichor::scene

#endif
