#include "scene/patches/lookup.h"

#include <algorithm>

namespace petrichor::shared {
namespace {

using namespace petrichor::shared_names;
using glm::uvec2;
using glm::uvec3;

// The arrays behind the shared text.
struct Lookup {
    const scene::LitPatches& lit;

    uvec4 patch_table(uint slot) const { return lit.table[slot]; }
    vec4 patch_plane(uint node) const { return lit.planes[node]; }
    vec4 patch_irradiance(uint node) const { return lit.irradiance[node]; }
    vec4 patch_gradient(uint node) const { return lit.gradient[node]; }

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

shared::PatchGrid lookup_grid(const Patches& patches)
{
    return {patches.cell_m, static_cast<std::uint32_t>(patches.empty() ? 0 : patches.levels),
            patches.count, static_cast<std::uint32_t>(patches.table.size() - 1)};
}

shared::PatchLight light_at(const LitPatches& lit, glm::vec3 position, glm::vec3 normal)
{
    return shared::Lookup{lit}.patch_lookup(lit.grid, position, normal);
}

}  // namespace petrichor::scene
