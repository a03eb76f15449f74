#ifndef PETRICHOR_SCENE_BASINS_HEIGHT_FIELD_H
#define PETRICHOR_SCENE_BASINS_HEIGHT_FIELD_H

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace petrichor::scene {

/// Height of a cell that is no ground: water that comes here falls out of the scene.
inline constexpr float kNoGround_m = std::numeric_limits<float>::quiet_NaN();
/// Height of a cell that something solid fills: no water comes here.
inline constexpr float kSolid_m = std::numeric_limits<float>::infinity();

/// The ground as water sees it from above: a grid of heights, row 0 at the least z. Cell (x, z) has
/// its centre at `corner + (x + 0.5, z + 0.5) cell_m`.
struct HeightField {
    std::size_t width = 0, depth = 0;  ///< cells along x and along z; 0: the scene has no ground
    double cell_m = 1.0;               ///< > 0
    glm::dvec2 corner_m{0.0};          ///< world x and z
    std::vector<float> height_m;       ///< world y, or kNoGround_m or kSolid_m; row by row
    std::vector<std::string> notes;    ///< what was guessed or left out, a line each

    std::size_t cells() const { return width * depth; }
    bool empty() const { return cells() == 0; }
    std::size_t cell_of(std::size_t x, std::size_t z) const { return z * width + x; }
};
/// Index of the cell that holds a world position, or `cells()` outside.
std::size_t cell_at(const HeightField& field, double x_m, double z_m);

/// What a material has to do with the ground.
enum class GroundUse : std::uint8_t {
    Auto,    ///< ground where it lies lowest
    Ground,  ///< ground wherever it is uppermost among what is not `Never`, roofs too
    Never,   ///< neither ground nor solid: leaves, hanging signs, the glass of a lantern
};

struct GroundOptions {
    std::size_t most_cells = 1024;  ///< along the longer side, 2..8192
    double least_cell_m = 0.01;     ///< cells are never smaller, > 0
    /// What rises so far above the ground that it starts from is a building, not a step, m.
    double solid_above_m = 2.0;
    /// Air below a surface that is thinner than this holds no water, m.
    double least_air_m = 0.05;
    /// A sheet over the ground that encloses nothing is ground itself when it lies so near, m.
    double sheet_gap_m = 0.25;
    /// By material index; a shorter vector leaves the rest at Auto.
    std::vector<GroundUse> use = {};
};

/// The ground of a scene, from its triangles.
///
/// In every column the lowest surface that faces up is ground. What stands on it without air in
/// between (kerbs, steps, cobbles: looking up from the ground one sees the inside of their tops) is
/// ground instead, and solid where it rises more than `solid_above_m`. Meshes that are closed and
/// inside-out are turned; where nothing faces up at all, what faces down is taken. Doubled and
/// double-sided faces count both ways. Scenes wider than 32 m are cut to the box that holds 98 %
/// of their triangles, and 5 m around it: one triangle of 10 km leaves the grid where the houses
/// are. Triangles with positions that are not finite are left out and counted in `notes`.
///
/// Same bits for the same scene, whatever the order of its threads; memory is bounded by the grid.
///   throws  Error when an option is out of range
HeightField ground_height_field(const Scene& scene, const GroundOptions& options = {});

}  // namespace petrichor::scene

#endif
