#ifndef PETRICHOR_GPU_PASSES_SURFACE_SURFACE_H
#define PETRICHOR_GPU_PASSES_SURFACE_SURFACE_H

#include "gpu/device/graph.h"
#include "gpu/frame/constants_range.h"
#include "gpu/frame/frame_constants.h"
#include "gpu/frame/targets.h"
#include "gpu/passes/depth_maps/depth_maps.h"
#include "gpu/passes/surface_maps/surface_maps.h"
#include "gpu/passes/vertex_light/vertex_light.h"
#include "gpu/upload/draw.h"
#include "gpu/upload/seen_triangles.h"
#include "gpu/place/gpu_place.h"

namespace petrichor::gpu {

/// The layers' shader with users' own surfaces in it; added to the pipelines when one of them is blended.
inline constexpr const char* kOwnTransparentShader = "own_transparent.frag";

/// What a layer of transparent surfaces is drawn between (passes/transparent).
struct SurfaceLayer {
    GpuImage* solid_depth = nullptr;  ///< nothing behind it is drawn
    GpuImage* before = nullptr;       ///< depth of the layer before: nothing as near is
    GpuImage* through = nullptr;      ///< written: what it lets through of what lies behind; alpha: share of what it sends
    bool first = true;                ///< there is none
    bool by_chance = false;           ///< surfaces are seen or not, a sample at a time
};

// Draws the scene into the G-buffer: dry material and weather.
//
//   reads    ripple, flow and snow maps, the shelter map, the states of the patches, light at vertices
//   writes   the G-buffer
//   variant  weather, emission, light maps: a target that nobody reads is not written
void add_surface(FrameGraph& graph, FrameTargets& targets, const GpuScene& scene, SurfaceMaps& maps,
                 DepthMaps& depth_maps, GpuPlace& place, const VertexLight& vertex_light, const ConstantsRange& constants,
                 const glm::mat4& world_to_clip, const glm::vec3& camera_m,
                 const VisibleWeather& weather, Draws draws = Draws::All,
                 const SurfaceLayer* layer = nullptr,
                 std::shared_ptr<const SeenDraws> seen = nullptr);

}  // namespace petrichor::gpu

#endif
