#ifndef PETRICHOR_GPU_PASSES_PATCH_LIGHT_PATCH_POINTS_H
#define PETRICHOR_GPU_PASSES_PATCH_LIGHT_PATCH_POINTS_H

#include "gpu/frame/constants_range.h"
#include "gpu/frame/targets.h"
#include "gpu/passes/patch_light/patch_light.h"

namespace petrichor::gpu {

// Looks the light of patches up, once a frame at one or two points of every block of pixels.
//
//   reads    depth, normals of the first sample; patches
//   scratch  mirror_list, mirror_groups
//   writes   patch_points
void add_patch_points(FrameGraph& graph, FrameTargets& targets, const PatchLights& patches,
                      const ConstantsRange& constants);

}  // namespace petrichor::gpu

#endif
