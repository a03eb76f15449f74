#ifndef PETRICHOR_GPU_PASSES_VISIBILITY_VISIBILITY_H
#define PETRICHOR_GPU_PASSES_VISIBILITY_VISIBILITY_H

#include "gpu/device/graph.h"
#include "gpu/frame/constants_range.h"
#include "gpu/frame/frame_constants.h"
#include "gpu/upload/draw.h"
#include "gpu/upload/seen_triangles.h"

namespace petrichor::gpu {

// Which triangle is seen at each pixel, and its depth. Holes are decided here, so that what follows
// shades every pixel once and never throws one away.
//
//   reads    the table of draws (passes/surface_resolve): places of instances that one draw call has
//   writes   ids: RG32UI, draw (from 1; 0 is the sky) and triangle; depth
//   needs    Device::primitive_ids()
void add_visibility(FrameGraph& graph, GpuImage& ids, GpuImage& depth, const GpuScene& scene,
                    const ConstantsRange& constants, const glm::mat4& world_to_clip,
                    const glm::vec3& camera_m, const VisibleWeather& weather, GpuBuffer& draw_table,
                    std::shared_ptr<const SeenDraws> seen, Draws draws = Draws::All);

}  // namespace petrichor::gpu

#endif
