#ifndef PETRICHOR_GPU_FRAME_PIXEL_LIST_H
#define PETRICHOR_GPU_FRAME_PIXEL_LIST_H

#include "gpu/device/graph.h"
#include "gpu/frame/targets.h"

namespace petrichor::gpu {

/// Adds a pass over pixels, which its shader takes by gpu/frame/pixel_list.glsl: all of the
/// picture, or those that stand in the targets' list, which is among its bindings.
void add_over_pixels(FrameGraph& graph, FrameTargets& targets, ComputePass pass, bool listed);

}  // namespace petrichor::gpu

#endif
