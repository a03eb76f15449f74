#include "gpu/passes/ambient_occlusion/ambient_occlusion.h"

#include "gpu/passes/ambient_occlusion/ambient_occlusion_io.h"

namespace petrichor::gpu {

void add_ambient_occlusion(FrameGraph& graph, FrameTargets& targets,
                           const ConstantsRange& constants)
{
    GBuffer& g = targets.gbuffer;
    graph.add(
        ComputePass{.name = "ambient_occlusion",
                    .shader = "ambient_occlusion.comp",
                    .constants = {},
                    .bindings = {{AMBIENT_OCCLUSION_FRAME, frame_binding(constants)},
                                 {AMBIENT_OCCLUSION_DEPTH, sampled(*g.depth, targets.nearest)},
                                 {AMBIENT_OCCLUSION_NORMALS, sampled(*g.normals, targets.nearest)},
                                 {AMBIENT_OCCLUSION_TARGET, storage(*targets.occlusion)}},
                    .push = {},
                    .groups = groups_over(targets.width, targets.height, AMBIENT_OCCLUSION_TILE)});
}

}  // namespace petrichor::gpu
