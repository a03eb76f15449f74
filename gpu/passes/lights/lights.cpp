#include "gpu/passes/lights/lights.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "gpu/frame/frame_io.h"
#include "gpu/passes/lights/lights_io.h"

namespace petrichor::gpu {

float light_radius_m(const Light& light)
{
    const float strongest =
        light.intensity * std::max({light.color.r, light.color.g, light.color.b});
    // Where it would give a hundredth of a lux.
    const float faded = std::sqrt(std::max(strongest, 0.0f) / 0.01f);
    const float radius = light.range_m > 0.0f ? light.range_m : faded;
    return std::clamp(radius, 0.0f, 5000.0f);
}

LightTable make_light_table(const Device& device, MemoryArena& arena,
                            const std::vector<Light>& lights)
{
    std::vector<const Light*> ordered;
    for (const Light& light : lights) ordered.push_back(&light);
    std::stable_partition(ordered.begin(), ordered.end(),
                          [](const Light* l) { return l->kind == LightKind::Directional; });
    LightTable table;
    std::vector<glm::vec4> texels;
    for (const Light* light : ordered) {
        if (light->kind == LightKind::Directional) ++table.directional;
        const bool spot = light->kind == LightKind::Spot;
        texels.emplace_back(light->position_m, light_radius_m(*light));
        texels.emplace_back(light->color * light->intensity,
                            spot ? std::cos(light->outer_cone_rad) : -2.0f);
        texels.emplace_back(light->direction, std::cos(light->inner_cone_rad));
    }
    table.count = static_cast<std::uint32_t>(ordered.size());
    if (texels.empty()) texels.emplace_back(0.0f);
    table.texels = arena.buffer(
        {.name = "lights",
         .size = texels.size() * sizeof(glm::vec4),
         .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
         .texel_format = VK_FORMAT_R32G32B32A32_SFLOAT});
    upload_buffer(device, *table.texels, std::as_bytes(std::span(texels)));
    return table;
}

void add_light_lists(FrameGraph& graph, FrameTargets& targets, LightTable& lights,
                     const ConstantsRange& constants)
{
    if (lights.words() > 0) {
        const std::uint32_t groups = (lights.words() + LIGHT_COARSE_GROUP - 1) / LIGHT_COARSE_GROUP;
        const int tiles = targets.coarse_x() * targets.coarse_y();
        graph.add(
            ComputePass{.name = "light_coarse",
                        .shader = "light_coarse.comp",
                        .constants = {},
                        .bindings = {{LIGHT_COARSE_FRAME, frame_binding(constants)},
                                     {LIGHT_COARSE_LIGHTS, texels(*lights.texels)},
                                     {LIGHT_COARSE_WORDS, storage_buffer(*targets.coarse_lights)}},
                        .push = {},
                        .groups = {groups, static_cast<std::uint32_t>(tiles), 1}});
    }
    graph.add(ComputePass{
        .name = "light_lists",
        .shader = "light_lists.comp",
        .constants = {},
        .bindings = {{LIGHT_LISTS_FRAME, frame_binding(constants)},
                     {LIGHT_LISTS_LIGHTS, texels(*lights.texels)},
                     {LIGHT_LISTS_WORDS, texels(*targets.coarse_lights)},
                     {LIGHT_LISTS_DEPTH, sampled(*targets.gbuffer.depth, targets.nearest)},
                     {LIGHT_LISTS_LISTS, storage_buffer(*targets.light_lists)}},
        .push = {},
        .groups = groups_over(targets.tiles_x(), targets.tiles_y(), LIGHT_LISTS_TILE)});
}

std::uint32_t count_overflows(const FrameTargets& targets)
{
    std::uint32_t overflows = 0;
    const int tiles = targets.tiles_x() * targets.tiles_y();
    for (int i = 0; i < tiles; ++i) {
        std::uint32_t count = 0;
        const auto offset = static_cast<std::size_t>(i) * (LIGHT_LIST_MAX + 1) * 4;
        std::memcpy(&count, targets.light_lists->mapped + offset, 4);
        if (count > LIGHT_LIST_MAX) ++overflows;
    }
    return overflows;
}

}  // namespace petrichor::gpu
