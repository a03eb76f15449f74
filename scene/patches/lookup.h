#ifndef PETRICHOR_SCENE_PATCHES_LOOKUP_H
#define PETRICHOR_SCENE_PATCHES_LOOKUP_H

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "formulas/light/patch_cells.h"
#include "scene/patches/near_light.h"
#include "scene/patches/patches.h"

namespace petrichor::scene {

/// What a lookup reads besides the light, one entry a node.
std::vector<glm::vec4> lookup_planes(const Patches& patches);
/// min(1, area / 0.3 cell^2), one entry a node: slivers count less.
std::vector<float> lookup_sizes(const Patches& patches);

/// The grid of Patches::table, where every node is found by the key of its cell.
shared::PatchGrid table_grid(const Patches& patches);

/// How a lookup finds its way: the table of the coarsest cells, children of interior nodes by octant,
/// and for each leaf what lies in the 27 cells around that it is connected to, at its own level or
/// coarser. Numbers carry their level, as patch_lookup.inc has it.
struct LookupWays {
    std::vector<glm::uvec4> table;
    std::vector<std::uint32_t> ways;
    shared::PatchGrid grid;
};
/// near: entries of leaves that points know as close; null: none.
LookupWays lookup_ways(const Patches& patches, const NearLinks* near = nullptr);

/// Light of patches as pixels look it up: see formulas/light/patch_lookup.inc. Views: what they are
/// made from must outlive them.
struct LitPatches {
    std::span<const glm::uvec4> table;
    std::span<const std::uint32_t> ways;
    std::span<const glm::vec4> planes;
    std::span<const glm::vec4> irradiance;  ///< of nodes; w: open
    std::span<const glm::vec4> gradient;    ///< of nodes; w: lookup_sizes
    shared::PatchGrid grid;
    std::span<const glm::vec4> near = {};  ///< PatchIrradiance::near, where lookup_ways had NearLinks
};

/// Light at a point of a surface, metres, with the normal of its geometry, unit. Weight 0 where no
/// patch is near. The same text as the renderer's.
shared::PatchLight light_at(const LitPatches& lit, glm::vec3 position, glm::vec3 normal, float lift_m = 0.0f);

/// Which leaf a lookup at a point asks for what is close to it: the one that counts most there; shared::kNoPatch where
/// no patch is connected to the point.
class LeafFinder {
public:
    /// The patches must outlive it.
    explicit LeafFinder(const Patches& patches);
    std::uint32_t leaf_at(glm::vec3 position, glm::vec3 normal) const;

private:
    LookupWays ways_;
    std::vector<glm::vec4> planes_, none_, sizes_;
};

}  // namespace petrichor::scene

#endif
