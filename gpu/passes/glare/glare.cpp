#include "gpu/passes/glare/glare.h"

#include "gpu/passes/glare/glare_io.h"

namespace petrichor::gpu {

namespace {

constexpr float kWider = 0.75f;

}  // namespace

void add_glare(FrameGraph& graph, FrameTargets& targets, int samples)
{
    const auto& levels = targets.glare;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        GpuImage& source = i == 0 ? *targets.accumulated : *levels[i - 1];
        const float scale = i == 0 ? 1.0f / static_cast<float>(samples) : 1.0f;
        graph.add(
            ComputePass{.name = "glare",
                        .shader = "glare_down.comp",
                        .constants = {{GLARE_SPEC_FILTERS, targets.filters}},
                        .bindings = {{GLARE_SOURCE, sampled(source, targets.between)},
                                     {GLARE_TARGET, storage(*levels[i])}},
                        .push = PushBlock(shared::GlareParams{scale}),
                        .groups = groups_over(levels[i]->width, levels[i]->height, GLARE_TILE)});
    }
    for (std::size_t i = levels.size(); i-- > 1;) {
        graph.add(ComputePass{
            .name = "glare",
            .shader = "glare_up.comp",
            .constants = {{GLARE_SPEC_FILTERS, targets.filters}},
            .bindings = {{GLARE_WIDER, sampled(*levels[i], targets.between)},
                         {GLARE_LEVEL, storage(*levels[i - 1])}},
            .push = PushBlock(shared::GlareParams{kWider}),
            .groups = groups_over(levels[i - 1]->width, levels[i - 1]->height, GLARE_TILE)});
    }
}

}  // namespace petrichor::gpu
