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

// The layers behind what bends, into the sum of the last layer's samples, which nobody needs any more.
void add_behind(FrameGraph& graph, FrameTargets& targets, TransparentTargets& own, LightParts& parts, const GpuScene& scene,
                const ConstantsRange& constants)
{
    const SamplerHandle& nearest = targets.nearest;
    graph.add(ComputePass{
        .name = "transparent",
        .shader = "transparent_behind.comp",
        .constants = {{TRANSPARENT_BEHIND_SPEC_SPLIT, parts.split}},
        .bindings = {{TRANSPARENT_BEHIND_FRAME, frame_binding(constants)},
                     {TRANSPARENT_BEHIND_LOOKS, texels(scene.material_looks())},
                     {TRANSPARENT_BEHIND_SOLID, sampled(*own.solid, nearest)},
                     {TRANSPARENT_BEHIND_SOLID_DEPTH, sampled(*targets.gbuffer.depth, nearest)},
                     {TRANSPARENT_BEHIND_FRONT, sampled(*own.front, nearest)},
                     {TRANSPARENT_BEHIND_LEFT, sampled(*own.left, nearest)},
                     {TRANSPARENT_BEHIND_BENT, sampled(*own.bent, nearest)},
                     {TRANSPARENT_BEHIND_TINT, sampled(*own.tint, nearest)},
                     {TRANSPARENT_BEHIND_BEHIND, sampled(*own.behind, nearest)},
                     {TRANSPARENT_BEHIND_BEHIND_LEFT, sampled(*own.behind_left, nearest)},
                     {TRANSPARENT_BEHIND_CHANGE, storage(*own.layer.accumulated)},
                     {TRANSPARENT_BEHIND_FRONT_PARTS, storage(parts.or_none(parts.front))}},
        .push = {},
        .groups = groups_over(own.layer.width, own.layer.height, TRANSPARENT_TILE)});
}

}  // namespace

TransparentTargets make_transparent_targets(const Device& device, MemoryArena& arena, int width,
                                            int height, int light_words, bool bends)
{
    TransparentTargets own;
    own.layer = make_frame_targets(device, arena, width, height, light_words);
    const auto image = [&](const char* name, VkFormat format, VkImageUsageFlags usage, bool whole = true) {
        return arena.image({.name = name,
                            .format = format,
                            .width = whole ? width : 1,
                            .height = whole ? height : 1,
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
    own.bends = bends;
    own.bent = image("layers_bent", VK_FORMAT_R32G32B32A32_UINT, VK_IMAGE_USAGE_STORAGE_BIT, bends);
    if (bends) {
        own.tint = image("layers_tint", VK_FORMAT_R16G16B16A16_SFLOAT, VK_IMAGE_USAGE_STORAGE_BIT);
        own.behind = image("layers_behind", VK_FORMAT_R32G32B32A32_SFLOAT, VK_IMAGE_USAGE_STORAGE_BIT);
        own.behind_left = image("layers_behind_left", VK_FORMAT_R16G16B16A16_SFLOAT, VK_IMAGE_USAGE_STORAGE_BIT);
    }
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
    const bool keeps = own.bends && layers > 1;
    const auto kept_or = [&](const std::unique_ptr<GpuImage>& image, const std::unique_ptr<GpuImage>& other) -> GpuImage& { return keeps ? *image : *other; };
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
                          {TRANSPARENT_OVER_SPEC_GUSTS, gusts},
                          {TRANSPARENT_OVER_SPEC_KEEPS, keeps}},
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
                         {TRANSPARENT_OVER_FRONT_PARTS, storage(parts.or_none(parts.front))},
                         {TRANSPARENT_OVER_BENT, storage(*own.bent)},
                         {TRANSPARENT_OVER_TINT, storage(kept_or(own.tint, own.left))},
                         {TRANSPARENT_OVER_BEHIND, storage(kept_or(own.behind, own.front))},
                         {TRANSPARENT_OVER_BEHIND_LEFT, storage(kept_or(own.behind_left, own.left))}},
            .push = {},
            .groups = groups_over(layer.width, layer.height, TRANSPARENT_TILE)});
        std::swap(layer.gbuffer.depth, own.other_depth);
    }
    if (keeps) add_behind(graph, targets, own, parts, scene, constants);
    graph.add(ComputePass{
        .name = "transparent",
        .shader = "transparent_done.comp",
        .constants = {{TRANSPARENT_DONE_SPEC_SPLIT, parts.split}, {TRANSPARENT_DONE_SPEC_BEHIND, keeps}},
        .bindings = {{TRANSPARENT_DONE_FRAME, frame_binding(constants)},
                     {TRANSPARENT_DONE_SOLID, sampled(*own.solid, nearest)},
                     {TRANSPARENT_DONE_FRONT, sampled(*own.front, nearest)},
                     {TRANSPARENT_DONE_LEFT, sampled(*own.left, nearest)},
                     {TRANSPARENT_DONE_ACCUMULATED, storage(*targets.accumulated)},
                     {TRANSPARENT_DONE_SOLID_PARTS, storage(parts.or_none(parts.solid))},
                     {TRANSPARENT_DONE_FRONT_PARTS, storage(parts.or_none(parts.front))},
                     {TRANSPARENT_DONE_PARTS, storage(parts.or_none(parts.sum))},
                     {TRANSPARENT_DONE_CHANGE, sampled(*layer.accumulated, nearest)}},
        .push = {},
        .groups = groups_over(targets.width, targets.height, TRANSPARENT_TILE)});
}

}  // namespace petrichor::gpu
