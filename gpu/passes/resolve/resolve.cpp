#include "gpu/passes/resolve/resolve.h"

#include "gpu/passes/resolve/resolve_io.h"

namespace petrichor::gpu {

void add_resolve(FrameGraph& graph, FrameTargets& targets, SkyMaps& sky,
                 const ConstantsRange& constants)
{
    graph.add(ComputePass{.name = "resolve",
                          .shader = "resolve.comp",
                          .constants = {},
                          .bindings = {{RESOLVE_FRAME, frame_binding(constants)},
                                       {RESOLVE_SKY_LIGHT, sky_light_binding(sky)},
                                       {RESOLVE_ACCUMULATED, storage_read(*targets.accumulated)},
                                       {RESOLVE_BEAUTY, storage_buffer(*targets.beauty)},
                                       {RESOLVE_DISPLAY, storage_buffer(*targets.display)}},
                          .push = {},
                          .groups = groups_over(targets.width, targets.height, RESOLVE_TILE)});
    graph.read_back({targets.beauty.get(), targets.display.get(), sky.light.get()});
}

}  // namespace petrichor::gpu
