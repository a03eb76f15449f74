// The tree of cells before it becomes Patches.
#ifndef PETRICHOR_SCENE_PATCHES_DETAIL_CELLS_H
#define PETRICHOR_SCENE_PATCHES_DETAIL_CELLS_H

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/patches/patches.h"

namespace petrichor::scene {

enum class CellState : std::uint8_t { Split, Leaf, Buried };

struct Cell {
    shared::PatchKey key;
    CellState state = CellState::Split;
    int points = 0;  ///< exposed samples kept, 0..kPatchSamples
    float area_m2 = 0.0f;
    glm::vec3 position_m{0.0f};
    glm::vec3 normal{0.0f};
    std::array<PatchSample, kPatchSamples> samples{};
};

/// Keys to numbers of cells; grows.
class CellMap {
public:
    static constexpr std::uint32_t kNone = 0xffffffffu;
    std::uint32_t find(shared::PatchKey key) const;
    /// The number under the key; `fresh` is kept under it when there was none.
    std::uint32_t find_or_add(shared::PatchKey key, std::uint32_t fresh);

private:
    struct Slot {
        shared::PatchKey key{};
        std::uint32_t value = kNone;
    };
    void grow();
    std::vector<Slot> slots_;
    std::size_t used_ = 0;
};

/// How cells are cut: edge of level 0, number of levels, how many leaves at most.
struct CellPlan {
    float cell_m = 0.175f;
    int levels = 2;  ///< level levels - 1 is the coarsest, 1 the finest regular one
    int content_levels = 2;  ///< coarser cells are for backdrops alone
    float slope_m = 4.0f;    ///< longer cells whose ground bends are cut, whatever they see
    std::uint32_t most = kMostPatches;
};

struct GrownCells {
    bool fit = false;  ///< no more leaves than allowed
    int level = 0;     ///< where there were too many
    std::vector<Cell> cells;
};
/// Cells of the scene, coarse to fine.
GrownCells grow_cells(const Tracer& tracer, const CellPlan& plan, const PatchOptions& options);

/// How far rays start from their surface: 2 mm on the scale of a street, and more than rounding.
float ray_lift_m(glm::vec3 position, float regular_cell_m);
/// What Tracer::blocked_between asks; nothing where the points are so close that nothing can lie between.
std::optional<Ray> ray_between(glm::vec3 from, glm::vec3 to, float margin_m = 1e-4f);

/// Level 0 cell of a point.
inline glm::ivec3 cell_of(glm::vec3 position, float cell_m)
{
    return shared::patch_cell(position, 1.0f / cell_m);
}
inline shared::PatchKey key_of(glm::ivec3 cell0, int axis, int level)
{
    return shared::patch_key({cell0.x >> level, cell0.y >> level, cell0.z >> level}, axis, level);
}
inline glm::ivec3 cell_in(shared::PatchKey key)
{
    return {static_cast<int>(key.low & 0x7ffffu),
            static_cast<int>((key.low >> 19) | ((key.high & 0x3fu) << 13)),
            static_cast<int>((key.high >> 6) & 0x7ffffu)};
}
/// Which eighth of the cell above holds cell >> level, x fastest.
inline std::size_t octant_of(glm::ivec3 cell, int level)
{
    return static_cast<std::size_t>((cell.x >> level & 1) | (cell.y >> level & 1) << 1 | (cell.z >> level & 1) << 2);
}
inline shared::PatchKey parent_of(shared::PatchKey key)
{
    const glm::ivec3 c = cell_in(key);
    return shared::patch_key({c.x >> 1, c.y >> 1, c.z >> 1}, axis_of(key), level_of(key) + 1);
}

}  // namespace petrichor::scene

#endif
