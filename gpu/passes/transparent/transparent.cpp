#include "gpu/passes/transparent/transparent.h"

#include <algorithm>

#include "gpu/passes/ambient_occlusion/ambient_occlusion.h"
#include "gpu/passes/transparent/transparent_io.h"
#include "gpu/upload/draw.h"

namespace petrichor::gpu {

namespace {

void add_clear(FrameGraph& graph, const TransparentTargets& own, GpuImage& light,
               const ConstantsRange& constants)
{
    graph.add(ComputePass{
        .name = "transparent",
        .shader = "transparent_clear.comp",
        .constants = {},
        .bindings = {{TRANSPARENT_CLEAR_FRAME, frame_binding(constants)},
                     {TRANSPARENT_CLEAR_LIGHT, storage(light)}},
        .push = {},
        .groups = groups_over(own.layer.width, own.layer.height, TRANSPARENT_TILE)});
}

}  // namespace

TransparentTargets make_transparent_targets(const Device& device, MemoryArena& arena, int width,
                                            int height, int light_words)
{
    TransparentTargets own;
    own.layer = make_frame_targets(device, arena, width, height, light_words);
    const auto image = [&](const char* name, VkFormat format, VkImageUsageFlags usage) {
        return arena.image({.name = name,
                            .format = format,
                            .width = width,
                            .height = height,
                            .usage = usage | VK_IMAGE_USAGE_SAMPLED_BIT});
    };
    own.other_depth = image("layer_before", VK_FORMAT_D32_SFLOAT,
                            VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT |
                                VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    own.through = image("layer_through", VK_FORMAT_R16G16B16A16_SFLOAT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
    own.solid = image("solid", VK_FORMAT_R32G32B32A32_SFLOAT,
                      VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
    own.front = image("layers_front", VK_FORMAT_R32G32B32A32_SFLOAT, VK_IMAGE_USAGE_STORAGE_BIT);
    own.left = image("layers_left", VK_FORMAT_R16G16B16A16_SFLOAT, VK_IMAGE_USAGE_STORAGE_BIT);
    return own;
}

int transparent_layers(const GpuScene& scene, const glm::mat4& world_to_clip)
{
    const Frustum frustum(world_to_clip);
    std::uint32_t needed = 0;
    for (const Draw& draw : scene.draws()) {
        if (!scene.materials()[draw.material].blended || draw.index_count == 0) continue;
        if (!frustum.touches(draw.centre_m, draw.radius_m)) continue;
        // Two triangles are a pane, which never hides itself.
        needed += std::min((draw.index_count / 3 + 1) / 2, 8u);
    }
    return static_cast<int>(std::min(needed, 64u));
}

void begin_transparent(FrameGraph& graph, TransparentTargets& own, LightParts& parts,
                       const ConstantsRange& constants)
{
    if (parts.split) clear_light_parts(graph, *parts.solid);
    add_clear(graph, own, *own.solid, constants);
    add_no_occlusion(graph, own.layer, "transparent");
}

void add_transparent(FrameGraph& graph, FrameTargets& targets, TransparentTargets& own,
                     LightParts& parts, const GpuScene& scene, SkyMaps& sky,
                     const ConstantsRange& constants, int layers, bool more, bool gusts, const std::function<void(const SurfaceLayer&)>& draw_layer,
                     const std::function<void()>& light_layer)
{
    const SamplerHandle& nearest = targets.nearest;
    FrameTargets& layer = own.layer;
    for (int k = 0; k < layers; ++k) {
        draw_layer({targets.gbuffer.depth.get(), own.other_depth.get(), own.through.get(), k == 0,
                    more && k + 1 == layers});
        add_clear(graph, own, *layer.accumulated, constants);
        if (parts.split) clear_light_parts(graph, *parts.layer);
        light_layer();
        graph.add(ComputePass{
            .name = "transparent",
            .shader = "transparent_over.comp",
            .constants = {{TRANSPARENT_OVER_SPEC_FIRST, k == 0},
                          {TRANSPARENT_OVER_SPEC_BODY, scene.body_shares()},
                          {TRANSPARENT_OVER_SPEC_SPLIT, parts.split},
                          {TRANSPARENT_OVER_SPEC_GUSTS, gusts}},
            .bindings = {{TRANSPARENT_OVER_FRAME, frame_binding(constants)},
                         {TRANSPARENT_OVER_DEPTH, sampled(*layer.gbuffer.depth, nearest)},
                         {TRANSPARENT_OVER_LIT, sampled(*layer.accumulated, nearest)},
                         {TRANSPARENT_OVER_THROUGH, sampled(*own.through, nearest)},
                         {TRANSPARENT_OVER_MATERIAL, sampled(*layer.gbuffer.material, nearest)},
                         {TRANSPARENT_OVER_NORMALS, sampled(*layer.gbuffer.normals, nearest)},
                         {TRANSPARENT_OVER_EMISSION, sampled(*layer.gbuffer.emission, nearest)},
                         {TRANSPARENT_OVER_WEATHER, sampled(*layer.gbuffer.weather, nearest)},
                         {TRANSPARENT_OVER_LOOKS, texels(scene.material_looks())},
                         {TRANSPARENT_OVER_SOLID, sampled(*own.solid, nearest)},
                         {TRANSPARENT_OVER_SOLID_DEPTH, sampled(*targets.gbuffer.depth, nearest)},
                         {TRANSPARENT_OVER_SKY, sampled(*sky.cube, sky.linear)},
                         {TRANSPARENT_OVER_FRONT, storage(*own.front)},
                         {TRANSPARENT_OVER_LEFT, storage(*own.left)},
                         {TRANSPARENT_OVER_LIT_PARTS, storage(parts.or_none(parts.layer))},
                         {TRANSPARENT_OVER_FRONT_PARTS, storage(parts.or_none(parts.front))}},
            .push = {},
            .groups = groups_over(layer.width, layer.height, TRANSPARENT_TILE)});
        std::swap(layer.gbuffer.depth, own.other_depth);
    }
    graph.add(ComputePass{
        .name = "transparent",
        .shader = "transparent_done.comp",
        .constants = {{TRANSPARENT_DONE_SPEC_SPLIT, parts.split}},
        .bindings = {{TRANSPARENT_DONE_FRAME, frame_binding(constants)},
                     {TRANSPARENT_DONE_SOLID, sampled(*own.solid, nearest)},
                     {TRANSPARENT_DONE_FRONT, sampled(*own.front, nearest)},
                     {TRANSPARENT_DONE_LEFT, sampled(*own.left, nearest)},
                     {TRANSPARENT_DONE_ACCUMULATED, storage(*targets.accumulated)},
                     {TRANSPARENT_DONE_SOLID_PARTS, storage(parts.or_none(parts.solid))},
                     {TRANSPARENT_DONE_FRONT_PARTS, storage(parts.or_none(parts.front))},
                     {TRANSPARENT_DONE_PARTS, storage(parts.or_none(parts.sum))}},
        .push = {},
        .groups = groups_over(targets.width, targets.height, TRANSPARENT_TILE)});
}

}  // namespace petrichor::gpu
