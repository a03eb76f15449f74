#include "gpu/passes/patch_light/patch_points.h"

#include <utility>

#include "gpu/frame/patch_points_io.h"
#include "gpu/frame/pixel_list.h"
#include "gpu/frame/pixel_list_io.h"

namespace petrichor::gpu {

void add_patch_points(FrameGraph& graph, FrameTargets& targets, const PatchLights& patches,
                      const ConstantsRange& constants)
{
    const auto blocks = [](int pixels) { return (pixels + PATCH_BLOCK - 1) / PATCH_BLOCK; };
    // Of those that mirror: lighting makes it anew.
    GpuBuffer& list = *targets.mirror_list;
    const Bindings bindings{{PATCH_POINTS_FRAME, frame_binding(constants)},
                            {PATCH_POINTS_DEPTH, texels(*targets.rows.depth)},
                            {PATCH_POINTS_NORMALS, texels(*targets.rows.normals)},
                            {PATCH_POINTS_TABLE, texels(patches.table())},
                            {PATCH_POINTS_WAYS, texels(patches.ways())},
                            {PATCH_POINTS_PLANES, texels(patches.planes())},
                            {PATCH_POINTS_IRRADIANCE, texels(patches.irradiance())},
                            {PATCH_POINTS_GRADIENT, texels(patches.gradient())},
                            {PATCH_POINTS_NEAR, texels(patches.near())},
                            {PATCH_POINTS_TARGET, storage_buffer(*targets.patch_points)}};
    // A CPU has an invocation a lane for all pixels of a group: constants are read once for them.
    const std::uint32_t invocations = targets.lanes != 0 ? targets.lanes : PIXEL_LIST_GROUP;
    const auto pass = [&](const char* shader, const Binding& listed) {
        ComputePass made{.name = "patch_points",
                         .shader = shader,
                         .constants = {{PIXEL_LIST_SPEC_INVOCATIONS, invocations}},
                         .bindings = bindings,
                         .push = {},
                         .groups = {}};
        made.bindings.push_back({PATCH_POINTS_LIST, listed});
        return made;
    };
    add_empty_list(graph, "patch_points", list);
    ComputePass listing = pass("patch_points.comp", storage_buffer(list));
    listing.groups = groups_over(blocks(targets.width), blocks(targets.height), PATCH_POINTS_TILE);
    graph.add(std::move(listing));
    add_list_groups(graph, "patch_points", list, *targets.mirror_groups);
    add_over_list(graph, pass("patch_listed.comp", texels(list)), *targets.mirror_groups);
}

}  // namespace petrichor::gpu
