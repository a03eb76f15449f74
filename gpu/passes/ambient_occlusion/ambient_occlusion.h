#ifndef PETRICHOR_GPU_PASSES_AMBIENT_OCCLUSION_AMBIENT_OCCLUSION_H
#define PETRICHOR_GPU_PASSES_AMBIENT_OCCLUSION_AMBIENT_OCCLUSION_H

#include <string>

#include "gpu/device/graph.h"
#include "gpu/frame/constants_range.h"
#include "gpu/frame/pixel_list.h"

namespace petrichor::gpu {

// Screen-space ambient occlusion: one pixel of a block of four looks for it, and those that do not lie on its plane
// (formulas/light/occlusion_points.h). Of Pixels::Listed each looks for its own.
//
//   reads    depth_rows, surface_tiles, normals
//   writes   screen_occlusion, where a surface is; behind it bent normals, if `bent` (make_occlusion)
//   scratch  occlusion_points, mirror_list, mirror_groups
void add_ambient_occlusion(FrameGraph& graph, FrameTargets& targets,
                           const ConstantsRange& constants, Pixels pixels, bool bent);
/// Nothing is near any pixel, as part of the pass of that name.
void add_no_occlusion(FrameGraph& graph, FrameTargets& targets, const std::string& pass);

}  // namespace petrichor::gpu

#endif
