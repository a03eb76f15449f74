// Surfaces over the cells of a grid, sorted from below: what the ground is chosen from.
#ifndef PETRICHOR_SCENE_BASINS_DETAIL_COLUMNS_H
#define PETRICHOR_SCENE_BASINS_DETAIL_COLUMNS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/basins/height_field.h"

namespace petrichor::scene::detail {

// A triangle in world space, as far as the ground is concerned.
struct GroundTriangle {
    std::array<glm::dvec3, 3> corner;
    bool up, down;  // faces up, faces down; both for double-sided ones
    bool closed;    // of a mesh that encloses a volume
    GroundUse use;
};

struct GroundTriangles {
    std::vector<GroundTriangle> all;
    std::size_t not_finite = 0, turned = 0;
    bool upside_down = false;  // nothing faced up: what faces down was taken
};
// Vertical and degenerate triangles are left out: they have no area from above.
GroundTriangles ground_triangles(const Scene& scene, const GroundOptions& options);

struct Layer {
    float height_m;
    std::uint8_t up, down, closed, ground;
};
// Height of the ground in a column, or kNoGround_m, or kSolid_m. `layers` in any order; sorted on
// return.
float ground_of_column(std::vector<Layer>& layers, const GroundOptions& options);

}  // namespace petrichor::scene::detail

#endif
