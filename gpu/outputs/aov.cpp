#include "gpu/outputs/aov.h"

#include "gpu/outputs/aov_io.h"

namespace petrichor::gpu {

void add_aov(FrameGraph& graph, FrameTargets& targets, const ConstantsRange& constants,
             std::size_t slot, std::uint32_t kind, bool has_weather, bool has_emission)
{
    GBuffer& g = targets.gbuffer;
    const SamplerHandle& nearest = targets.nearest;
    graph.add(ComputePass{.name = "aov",
                          .shader = "aov.comp",
                          .constants = {},
                          .bindings = {{AOV_FRAME, frame_binding(constants)},
                                       {AOV_DEPTH, sampled(*g.depth, nearest)},
                                       {AOV_COLOR, sampled(*g.color, nearest)},
                                       {AOV_NORMALS, sampled(*g.normals, nearest)},
                                       {AOV_MATERIAL, sampled(*g.material, nearest)},
                                       {AOV_WEATHER, sampled(*g.weather, nearest)},
                                       {AOV_EMISSION, sampled(*g.emission, nearest)},
                                       {AOV_OUTPUT, storage_buffer(*targets.aovs[slot])}},
                          .push = PushBlock(shared::AovParams{kind, has_weather, has_emission}),
                          .groups = groups_over(targets.width, targets.height, AOV_TILE)});
    graph.read_back({targets.aovs[slot].get()});
}

}  // namespace petrichor::gpu
