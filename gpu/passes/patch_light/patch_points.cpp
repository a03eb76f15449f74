#include "gpu/passes/patch_light/patch_points.h"

#include "gpu/frame/patch_points_io.h"

namespace petrichor::gpu {

void add_patch_points(FrameGraph& graph, FrameTargets& targets, const PatchLights& patches,
                      const ConstantsRange& constants)
{
    GBuffer& g = targets.gbuffer;
    const auto blocks = [](int pixels) { return (pixels + PATCH_BLOCK - 1) / PATCH_BLOCK; };
    graph.add(ComputePass{
        .name = "patch_points",
        .shader = "patch_points.comp",
        .constants = {},
        .bindings = {{PATCH_POINTS_FRAME, frame_binding(constants)},
                     {PATCH_POINTS_DEPTH, texels(*targets.depth_rows)},
                     {PATCH_POINTS_NORMALS, sampled(*g.normals, targets.nearest)},
                     {PATCH_POINTS_TABLE, texels(patches.table())},
                     {PATCH_POINTS_WAYS, texels(patches.ways())},
                     {PATCH_POINTS_PLANES, texels(patches.planes())},
                     {PATCH_POINTS_IRRADIANCE, texels(patches.irradiance())},
                     {PATCH_POINTS_GRADIENT, texels(patches.gradient())},
                     {PATCH_POINTS_NEAR, texels(patches.near())},
                     {PATCH_POINTS_TARGET, storage_buffer(*targets.patch_points)}},
        .push = {},
        .groups = groups_over(blocks(targets.width), blocks(targets.height), PATCH_POINTS_TILE)});
}

}  // namespace petrichor::gpu
