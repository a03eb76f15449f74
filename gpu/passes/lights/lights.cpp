#include "gpu/passes/lights/lights.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
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

void check_light_lists(const VkPhysicalDeviceLimits& limits, std::size_t lights, int width,
                       int height)
{
    if (lights > kMostLights) {
        throw Error("render: " + std::to_string(lights) + " lights; at most " +
                        std::to_string(kMostLights) + " are possible in one frame",
                    "Leave out the faintest, or render the scene in parts.");
    }
    const auto words = static_cast<int>((lights + 31) / 32);
    const VkDeviceSize bytes = light_lists_bytes(width, height, words);
    const VkDeviceSize elements = std::max<VkDeviceSize>(bytes / sizeof(glm::uvec2), 3 * lights);
    if (bytes > limits.maxStorageBufferRange || elements > limits.maxTexelBufferElements) {
        throw Error("render: the lists of " + std::to_string(lights) + " lights over " +
                        std::to_string(width) + " x " + std::to_string(height) + " pixels take " +
                        std::to_string(bytes >> 20) + " MiB; this device holds " +
                        std::to_string(limits.maxStorageBufferRange >> 20) + " MiB and " +
                        std::to_string(limits.maxTexelBufferElements) + " texels in one buffer",
                    "Choose a smaller --size or fewer lights.");
    }
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

}  // namespace petrichor::gpu
