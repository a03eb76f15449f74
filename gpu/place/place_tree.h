#ifndef PETRICHOR_GPU_PLACE_PLACE_TREE_H
#define PETRICHOR_GPU_PLACE_PLACE_TREE_H

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "formulas/light/patch_cells.h"
#include "formulas/light/place_cells.h"

namespace petrichor::gpu {

/// The patches of a scene as pixels look them up (formulas/light/place_cells.h).
struct PlaceTree {
    shared::PatchGrid grid{};          ///< as place_lookup.inc reads it; levels 0: no patches
    std::vector<std::uint32_t> words;  ///< at least one
    std::vector<glm::uvec4> texels;    ///< shared::kPlaceTexels a patch, at least of one
};

/// Of the table of all nodes and its grid (scene::Patches::table, scene::table_grid), behind which parts of patches may stand
/// (place_parts.h), and the material of every patch and every part.
PlaceTree place_tree(const shared::PatchGrid& grid, std::span<const glm::uvec4> table,
                     std::span<const std::uint32_t> materials);

/// What a pixel finds: the same text as the renderer's. turn: shared::place_turn.
shared::PlaceFound place_found(const PlaceTree& tree, glm::vec3 x, glm::vec3 n, glm::vec3 turn, std::uint32_t material);
shared::PlaceLeaves place_leaves(const PlaceTree& tree, glm::vec3 x, glm::vec3 n, glm::vec3 turn);

}  // namespace petrichor::gpu

#endif
