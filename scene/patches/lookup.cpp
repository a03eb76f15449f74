#include "scene/patches/lookup.h"

#include <algorithm>
#include <bit>

#include "formulas/light/near_light.h"
#include "scene/patches/detail/cells.h"

namespace petrichor::shared {
namespace {

using namespace petrichor::shared_names;
using glm::uvec2;
using glm::uvec3;

// The arrays behind the shared text.
struct Lookup {
    const scene::LitPatches& lit;

    uvec4 patch_table(uint slot) const { return lit.table[slot]; }
    uint patch_way(uint index) const { return lit.ways[index]; }
    vec4 patch_plane(uint node) const { return lit.planes[node]; }
    vec4 patch_irradiance(uint node) const { return lit.irradiance[node]; }
    vec4 patch_gradient(uint node) const { return lit.gradient[node]; }
    vec4 patch_near(uint texel) const { return lit.near[texel]; }

#include "formulas/light/patch_lookup.inc"
};

}  // namespace
}  // namespace petrichor::shared

namespace petrichor::scene {

std::vector<glm::vec4> lookup_planes(const Patches& patches)
{
    std::vector<glm::vec4> planes;
    planes.reserve(patches.nodes());
    for (std::uint32_t i = 0; i < patches.nodes(); ++i) {
        const glm::vec3 n = patches.normal[i];
        planes.emplace_back(n, glm::dot(n, patches.position_m[i]));
    }
    return planes;
}

std::vector<float> lookup_sizes(const Patches& patches)
{
    std::vector<float> sizes;
    sizes.reserve(patches.nodes());
    for (std::uint32_t i = 0; i < patches.nodes(); ++i) {
        const float cell = patches.level_cell_m(level_of(patches.key[i]));
        sizes.push_back(std::min(1.0f, patches.area_m2[i] / (0.3f * cell * cell)));
    }
    return sizes;
}

namespace {

std::uint32_t with_level(const Patches& patches, std::uint32_t node)
{
    return node | static_cast<std::uint32_t>(level_of(patches.key[node])) << 24;
}

void add_root(LookupWays& made, const Patches& patches, std::uint32_t node)
{
    const shared::PatchKey key = patches.key[node];
    std::uint32_t slot = shared::patch_key_hash(key) & made.grid.table_mask;
    while (made.table[slot].z != shared::kNoPatch) slot = (slot + 1) & made.grid.table_mask;
    made.table[slot] = {key.low, key.high, with_level(patches, node), 0};
}

// The node in a cell of a leaf's level, or the one that holds that cell.
std::uint32_t node_at(const Patches& patches, glm::ivec3 cell, int axis, int level)
{
    for (int up = 0; level + up < patches.levels; ++up) {
        const std::uint32_t node = find_node(
            patches,
            shared::patch_key({cell.x >> up, cell.y >> up, cell.z >> up}, axis, level + up));
        if (node != Patches::kNoNode) return with_level(patches, node);
    }
    return shared::kNoPatch;
}

}  // namespace

LookupWays lookup_ways(const Patches& patches, const NearLinks* near)
{
    LookupWays made;
    std::vector<std::uint32_t> roots;
    for (std::uint32_t node = 0; node < patches.nodes(); ++node) {
        if (level_of(patches.key[node]) + 1 == patches.levels) roots.push_back(node);
    }
    made.table.assign(std::bit_ceil(std::max<std::size_t>(2 * roots.size(), 2)),
                      glm::uvec4(0, 0, shared::kNoPatch, 0));
    made.grid.cell_m = patches.cell_m;
    made.grid.levels = static_cast<std::uint32_t>(patches.empty() ? 0 : patches.levels);
    made.grid.patches = patches.count;
    made.grid.table_mask = static_cast<std::uint32_t>(made.table.size() - 1);
    made.grid.neighbors = patches.interior * 8;
    for (const std::uint32_t root : roots) add_root(made, patches, root);

    made.ways.assign(std::max<std::size_t>(std::size_t{patches.interior} * 8 +
                                               std::size_t{patches.count} * 29,
                                           1),
                     shared::kNoPatch);
    for (std::uint32_t i = 0; i < patches.interior; ++i) {
        for (std::uint32_t c = patches.children_first[i]; c < patches.children_first[i + 1]; ++c) {
            const std::uint32_t child = patches.children[c];
            const glm::ivec3 cell = cell_in(patches.key[child]);
            const int octant = (cell.x & 1) | (cell.y & 1) << 1 | (cell.z & 1) << 2;
            made.ways[std::size_t{i} * 8 + static_cast<std::size_t>(octant)] =
                with_level(patches, child);
        }
    }
    const std::size_t ranges = std::size_t{made.grid.neighbors} + std::size_t{patches.count} * 27;
    for (std::uint32_t leaf = 0; leaf < patches.count; ++leaf) {
        const bool any = near != nullptr && !near->empty();
        const std::uint32_t first = any ? near->first[leaf] : 0;
        const std::uint32_t many = any ? near->first[leaf + 1] - first : 0;
        made.ways[ranges + leaf] = first << 3 | many;
    }
    for (std::uint32_t leaf = 0; leaf < patches.count; ++leaf) {
        const shared::PatchKey key = patches.key[leaf];
        const glm::ivec3 cell = cell_in(key);
        std::uint32_t had = 0;
        for (int n = 0; n < 27; ++n) {
            if (((patches.connected[leaf] >> n) & 1u) == 0u) continue;
            const glm::ivec3 there = cell + glm::ivec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
            const std::uint32_t node = node_at(patches, there, axis_of(key), level_of(key));
            made.ways[std::size_t{made.grid.neighbors} + std::size_t{leaf} * 27 + static_cast<std::size_t>(n)] = node;
            if (node != shared::kNoPatch) had |= 1u << n;
        }
        made.ways[ranges + patches.count + leaf] = had;
    }
    return made;
}

shared::PatchGrid table_grid(const Patches& patches)
{
    return {patches.cell_m, static_cast<std::uint32_t>(patches.empty() ? 0 : patches.levels),
            patches.count, static_cast<std::uint32_t>(patches.table.size() - 1), 0};
}

LeafFinder::LeafFinder(const Patches& patches)
    : ways_(lookup_ways(patches)), planes_(lookup_planes(patches)), none_(patches.nodes(), glm::vec4(0.0f))
{
    for (const float size : lookup_sizes(patches)) sizes_.emplace_back(0.0f, 0.0f, 0.0f, size);
}

std::uint32_t LeafFinder::leaf_at(glm::vec3 position, glm::vec3 normal) const
{
    if (ways_.grid.levels == 0) return shared::kNoPatch;
    const LitPatches lit{ways_.table, ways_.ways, planes_, none_, sizes_, ways_.grid};
    shared::Lookup lookup{lit};
    return lookup.patch_found(ways_.grid, position, normal, 0.0f).own.leaf;
}

shared::PatchLight light_at(const LitPatches& lit, glm::vec3 position, glm::vec3 normal, float lift_m)
{
    return shared::Lookup{lit}.patch_lookup(lit.grid, position, normal, lift_m);
}

}  // namespace petrichor::scene
