#include "scene/patches/detail/nodes.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "scene/patches/detail/cells.h"

namespace petrichor::scene {
namespace {

void add_to_table(Patches& patches, std::uint32_t node)
{
    const std::size_t mask = patches.table.size() - 1;
    const shared::PatchKey key = patches.key[node];
    std::size_t i = shared::patch_key_hash(key) & mask;
    while (patches.table[i].z != Patches::kNoNode) i = (i + 1) & mask;
    patches.table[i] = {key.low, key.high, node, patches.connected[node]};
}

}  // namespace

void index_nodes(Patches& patches)
{
    patches.table.assign(std::bit_ceil(std::max<std::size_t>(2 * std::size_t{patches.nodes()}, 2)),
                         glm::uvec4(0, 0, Patches::kNoNode, 0));
    for (std::uint32_t node = 0; node < patches.nodes(); ++node) add_to_table(patches, node);

    std::vector<std::vector<std::uint32_t>> below(patches.interior);
    for (std::uint32_t node = 0; node < patches.nodes(); ++node) {
        if (level_of(patches.key[node]) + 1 >= patches.levels) continue;
        const std::uint32_t parent = find_node(patches, parent_of(patches.key[node]));
        if (parent != Patches::kNoNode && parent >= patches.count)
            below[parent - patches.count].push_back(node);
    }
    patches.octants.assign(std::size_t{patches.interior} * 8, Patches::kNoNode);
    for (std::size_t i = 0; i < below.size(); ++i)
        for (const std::uint32_t node : below[i]) patches.octants[i * 8 + octant_of(cell_in(patches.key[node]), 0)] = node;
    patches.children.clear();
    patches.children_first.assign(1, 0);
    for (const auto& list : below) {
        patches.children.insert(patches.children.end(), list.begin(), list.end());
        patches.children_first.push_back(static_cast<std::uint32_t>(patches.children.size()));
    }
}

// Keys are sorted by level first: interior nodes of a finer level come earlier.
void average_interior(Patches& patches)
{
    for (std::uint32_t i = 0; i < patches.interior; ++i) {
        const std::uint32_t node = patches.count + i;
        const std::uint32_t first = patches.children_first[i], last = patches.children_first[i + 1];
        glm::vec3 position(0.0f), normal(0.0f);
        float area = 0.0f;
        for (std::uint32_t c = first; c < last; ++c) {
            const std::uint32_t child = patches.children[c];
            const float a = patches.area_m2[child];
            position += patches.position_m[child] * a;
            normal += patches.normal[child] * a;
            area += a;
        }
        patches.area_m2[node] = area;
        patches.position_m[node] = area > 0.0f ? position / area : position;
        const float length = std::sqrt(glm::dot(normal, normal));
        if (length > 0.0f)
            patches.normal[node] = normal / length;
        else if (first < last)
            patches.normal[node] = patches.normal[patches.children[first]];
    }
}

}  // namespace petrichor::scene
