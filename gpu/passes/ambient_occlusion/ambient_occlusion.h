#ifndef PETRICHOR_GPU_PASSES_AMBIENT_OCCLUSION_AMBIENT_OCCLUSION_H
#define PETRICHOR_GPU_PASSES_AMBIENT_OCCLUSION_AMBIENT_OCCLUSION_H

#include "gpu/device/graph.h"
#include "gpu/frame/constants_range.h"
#include "gpu/frame/pixel_list.h"

namespace petrichor::gpu {

// Screen-space ambient occlusion.
//
//   reads    depth_rows, surface_tiles, normals
//   writes   screen_occlusion, where a surface is
void add_ambient_occlusion(FrameGraph& graph, FrameTargets& targets,
                           const ConstantsRange& constants, Pixels pixels);

}  // namespace petrichor::gpu

#endif
