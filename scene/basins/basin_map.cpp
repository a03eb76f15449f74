#include "scene/basins/basin_map.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "scene/basins/water.h"

namespace petrichor::scene {

namespace {

constexpr double kShownHollow_m3 = 1e-3;
constexpr float kDeepest_m = 0.05f;
const glm::vec3 kSolidColor{0.10f, 0.06f, 0.03f};
const glm::vec3 kShallow{0.20f, 0.45f, 0.75f}, kDeep{0.01f, 0.04f, 0.25f};

// A hue of its own for every pit: steps of the golden angle.
glm::vec3 tint_of(std::uint32_t pit)
{
    const float turn = std::fmod(static_cast<float>(pit % 4096u) * 0.381966f, 1.0f) * 6.2831853f;
    return glm::vec3(0.5f) + 0.22f * glm::vec3(std::cos(turn), std::cos(turn - 2.0943951f),
                                               std::cos(turn + 2.0943951f));
}

// 0..1, brighter where the ground faces the north-west.
float shade_of(const HeightField& field, std::size_t x, std::size_t z)
{
    const auto height = [&](std::size_t at_x, std::size_t at_z) {
        const float h = field.height_m[field.cell_of(at_x, at_z)];
        return std::isfinite(h) ? h : field.height_m[field.cell_of(x, z)];
    };
    const std::size_t west = x == 0 ? x : x - 1, east = std::min(x + 1, field.width - 1);
    const std::size_t north = z == 0 ? z : z - 1, south = std::min(z + 1, field.depth - 1);
    const auto step = static_cast<float>(field.cell_m);
    const float dx = (height(east, z) - height(west, z)) /
                     (step * static_cast<float>(std::max<std::size_t>(east - west, 1)));
    const float dz = (height(x, south) - height(x, north)) /
                     (step * static_cast<float>(std::max<std::size_t>(south - north, 1)));
    const glm::vec3 normal = glm::normalize(glm::vec3(-dx, 1.0f, -dz));
    return std::clamp(glm::dot(normal, glm::normalize(glm::vec3(-1.0f, 1.5f, -1.0f))), 0.0f, 1.0f);
}

}  // namespace

Image basin_map(const HeightField& field, const Basins& basins, std::span<const float> level_m)
{
    if (field.empty()) {
        throw Error("basins: the scene has no ground to map",
                    "Name what is ground, or take a scene with a surface that faces up.");
    }
    std::vector<float> full;
    if (level_m.empty()) {
        BasinWater water(basins);
        for (std::uint32_t i = 1; i < basins.hollow.size(); ++i)
            water.volume_m3[i] = basins.hollow[i].capacity_m3;
        full = levels_m(basins, water);
        level_m = full;
    }
    std::vector<std::uint8_t> shown(basins.pits + 1, 0);
    for (std::uint32_t i = static_cast<std::uint32_t>(basins.hollow.size()); i-- > 1;) {
        // A pit is shown with the largest hollow that it belongs to.
        std::uint32_t root = i;
        if (i > basins.pits) continue;
        while (basins.hollow[root].parent != 0) root = basins.hollow[root].parent;
        shown[i] = basins.hollow[root].capacity_m3 > kShownHollow_m3;
    }
    Image map(static_cast<int>(field.width), static_cast<int>(field.depth), 3, ColorSpace::Linear);
    for (std::size_t z = 0; z < field.depth; ++z) {
        for (std::size_t x = 0; x < field.width; ++x) {
            const std::size_t cell = field.cell_of(x, z);
            const float height = field.height_m[cell];
            glm::vec3 color(0.0f);
            if (std::isinf(height)) {
                color = kSolidColor;
            } else if (std::isfinite(height)) {
                const std::uint32_t label = basins.label[cell];
                color = label != kOutside && shown[label] ? tint_of(label) : glm::vec3(0.5f);
                color *= shade_of(field, x, z);
                const float water = label == kOutside ? 0.0f : level_m[label] - height;
                if (water > 0.0f)
                    color = glm::mix(kShallow, kDeep, std::min(water / kDeepest_m, 1.0f));
            }
            for (int c = 0; c < 3; ++c)
                map.at(static_cast<int>(x), static_cast<int>(z), c) = color[c];
        }
    }
    return map;
}

}  // namespace petrichor::scene
