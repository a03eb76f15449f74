#ifndef PETRICHOR_GPU_PASSES_SURFACE_H
#define PETRICHOR_GPU_PASSES_SURFACE_H

#include "gpu/detail/gpu_scene.h"
#include "gpu/detail/graph.h"
#include "gpu/passes/depth_maps.h"
#include "gpu/passes/surface_maps.h"
#include "gpu/passes/targets.h"

namespace petrichor::gpu {

/// Where a sample's constants lie in the frame's uniform buffer.
struct ConstantsRange {
    const GpuBuffer* buffer = nullptr;
    VkDeviceSize offset = 0;
};
Binding frame_binding(const ConstantsRange& constants);

/// What of the weather can show in a frame; the rest is not compiled into its shaders.
struct VisibleWeather {
    bool any = false;    ///< anything at all, wet air and frost included
    bool water = false;  ///< standing water
    bool snow = false;
};

// Draws the scene into the G-buffer: dry material and weather.
//
//   reads    ripple, flow and snow maps, the shelter map
//   writes   the G-buffer
//   variant  weather and emission: a target that nobody reads is not written
void add_surface(FrameGraph& graph, FrameTargets& targets, const GpuScene& scene, SurfaceMaps& maps,
                 DepthMaps& depth_maps, const ConstantsRange& constants,
                 const glm::mat4& world_to_clip, const glm::vec3& camera_m,
                 const VisibleWeather& weather);

}  // namespace petrichor::gpu

#endif
