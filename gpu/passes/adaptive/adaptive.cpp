#include "gpu/passes/adaptive/adaptive.h"

#include "gpu/frame/pixel_list.h"
#include "gpu/passes/adaptive/adaptive_io.h"

namespace petrichor::gpu {

AdaptiveTargets make_adaptive_targets(MemoryArena& arena, int width, int height)
{
    const auto image = [&](const char* name, VkFormat format) {
        return arena.image({.name = name,
                            .format = format,
                            .width = width,
                            .height = height,
                            .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT});
    };
    AdaptiveTargets own;
    own.seen = image("seen", VK_FORMAT_R32G32_UINT);
    own.light = image("first_light", VK_FORMAT_R16G16B16A16_SFLOAT);
    own.mean = image("mean_light", VK_FORMAT_R16G16B16A16_SFLOAT);
    return own;
}

bool is_adaptive(const Frame& frame)
{
    const FrameSettings& s = frame.settings;
    const bool apart = frame.lens.radius_m > 0.0f || !frame.shutter.empty() || s.soft_shadows;
    return s.adaptive > 0.0f && s.samples >= 4 && !apart;
}

void add_keep_first(FrameGraph& graph, FrameTargets& targets, ResolveTables& resolve,
                    AdaptiveTargets& own, GpuImage& lit, const ConstantsRange& constants)
{
    const SamplerHandle& nearest = targets.nearest;
    graph.add(ComputePass{
        .name = "adaptive",
        .shader = "adaptive_first.comp",
        .constants = {},
        .bindings = {{ADAPTIVE_FIRST_FRAME, frame_binding(constants)},
                     {ADAPTIVE_FIRST_IDS, sampled(*resolve.ids, nearest)},
                     {ADAPTIVE_FIRST_DEPTH, sampled(*targets.gbuffer.depth, nearest)},
                     {ADAPTIVE_FIRST_LIT, sampled(lit, nearest)},
                     {ADAPTIVE_FIRST_SEEN, storage(*own.seen)},
                     {ADAPTIVE_FIRST_LIGHT, storage(*own.light)}},
        .push = {},
        .groups = groups_over(targets.width, targets.height, ADAPTIVE_TILE)});
}

void add_settle(FrameGraph& graph, FrameTargets& targets, ResolveTables& resolve, SkyMaps& sky,
                AdaptiveTargets& own, GpuImage& lit, bool sum, float threshold,
                const ConstantsRange& constants)
{
    const SamplerHandle& nearest = targets.nearest;
    graph.add(ComputePass{
        .name = "adaptive",
        .shader = "adaptive_settle.comp",
        .constants = {{ADAPTIVE_SETTLE_SPEC_SUM, sum}},
        .bindings = {{ADAPTIVE_SETTLE_FRAME, frame_binding(constants)},
                     {ADAPTIVE_SETTLE_SKY_LIGHT, sky_light_binding(sky)},
                     {ADAPTIVE_SETTLE_IDS, sampled(*resolve.ids, nearest)},
                     {ADAPTIVE_SETTLE_DEPTH, sampled(*targets.gbuffer.depth, nearest)},
                     {ADAPTIVE_SETTLE_LIT, sampled(lit, nearest)},
                     {ADAPTIVE_SETTLE_LIGHT, sampled(*own.light, nearest)},
                     {ADAPTIVE_SETTLE_SEEN, storage(*own.seen)},
                     {ADAPTIVE_SETTLE_MEAN, storage(*own.mean)}},
        .push = PushBlock(shared::AdaptiveSettleParams{threshold}),
        .groups = groups_over(targets.width, targets.height, ADAPTIVE_TILE)});
}

void add_ask(FrameGraph& graph, FrameTargets& targets, ResolveTables& resolve, AdaptiveTargets& own,
             GpuImage& lit, const ConstantsRange& constants)
{
    const SamplerHandle& nearest = targets.nearest;
    GpuBuffer& list = *targets.pixel_list;
    add_empty_list(graph, "adaptive", list);
    const int across = (targets.width + ADAPTIVE_TILE - 1) / ADAPTIVE_TILE;
    const int down = (targets.height + ADAPTIVE_TILE - 1) / ADAPTIVE_TILE;
    graph.add(ComputePass{.name = "adaptive",
                          .shader = "adaptive_ask.comp",
                          .constants = {},
                          .bindings = {{ADAPTIVE_ASK_FRAME, frame_binding(constants)},
                                       {ADAPTIVE_ASK_IDS, sampled(*resolve.ids, nearest)},
                                       {ADAPTIVE_ASK_DEPTH, sampled(*targets.gbuffer.depth, nearest)},
                                       {ADAPTIVE_ASK_SEEN, sampled(*own.seen, nearest)},
                                       {ADAPTIVE_ASK_MEAN, sampled(*own.mean, nearest)},
                                       {ADAPTIVE_ASK_LIT, storage(lit)},
                                       {ADAPTIVE_ASK_ASKED, storage_buffer(*resolve.asked)},
                                       {ADAPTIVE_ASK_LIST, storage_buffer(list)}},
                          .push = {},
                          .groups = groups_over(across, down, ADAPTIVE_TILE)});
    add_list_groups(graph, "adaptive", list, *targets.pixel_groups);
}

}  // namespace petrichor::gpu
