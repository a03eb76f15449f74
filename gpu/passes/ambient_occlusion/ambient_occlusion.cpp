#include "gpu/passes/ambient_occlusion/ambient_occlusion.h"

#include "gpu/passes/ambient_occlusion/ambient_occlusion_io.h"

namespace petrichor::gpu {

void add_ambient_occlusion(FrameGraph& graph, FrameTargets& targets,
                           const ConstantsRange& constants, Pixels pixels)
{
    add_over_tiles(
        graph, targets,
        ComputePass{.name = "ambient_occlusion",
                    .shader = "ambient_occlusion.comp",
                    .constants = {},
                    .bindings = {{AMBIENT_OCCLUSION_FRAME, frame_binding(constants)},
                                 {AMBIENT_OCCLUSION_DEPTH, texels(*targets.rows.depth)},
                                 {AMBIENT_OCCLUSION_NORMALS, texels(*targets.rows.normals)},
                                 {AMBIENT_OCCLUSION_TARGET, storage(*targets.occlusion)},
                                 {AMBIENT_OCCLUSION_PIXELS, texels(pixels_of(targets, targets.surface_tiles, pixels))}},
                    .push = {},
                    .groups = {}},
        targets.surface_tiles, pixels);
}

}  // namespace petrichor::gpu
