#ifndef PETRICHOR_GPU_BUILD_SHADOWS_H
#define PETRICHOR_GPU_BUILD_SHADOWS_H

#include "gpu/build_frame.h"

namespace petrichor::gpu {

/// The sun is no point where more than one sample looks.
bool soft_sun(const Frame& frame, const Sun& sun);

/// Depth maps are drawn only when their views have changed.
void add_depth_maps(FrameGraph& graph, const Frame& frame, const Sun& sun, FrameResources& r,
                    bool weather, const FallingPlan& plan);

/// Lamps that have a size throw soft shadows where more than one sample looks.
bool soft_shadows(const Frame& frame, const FrameResources& r);

/// The sun's shadow of a sample: from another point of its disc.
void look_from_sun(FrameGraph& graph, const Frame& frame, const Sun& sun, std::uint32_t sample,
                   FrameResources& r);

/// The shadows of a sample: from another point of each lamp.
void look_from_lamps(FrameGraph& graph, const Frame& frame, shared::FrameConstants& c,
                     std::uint32_t sample, FrameResources& r);

}  // namespace petrichor::gpu

#endif
