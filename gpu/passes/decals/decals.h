#ifndef PETRICHOR_GPU_PASSES_DECALS_DECALS_H
#define PETRICHOR_GPU_PASSES_DECALS_DECALS_H

#include "gpu/device/graph.h"
#include "gpu/frame/constants_range.h"
#include "gpu/frame/frame_constants.h"
#include "gpu/frame/targets.h"
#include "gpu/passes/decals/decals_io.h"
#include "gpu/passes/depth_maps/depth_maps.h"
#include "gpu/passes/surface_maps/surface_maps.h"
#include "gpu/place/gpu_place.h"

namespace petrichor::gpu {

/// What decals lay over a picture of one size.
struct DecalTargets {
#define ROW(name, location, meaning) std::unique_ptr<GpuImage> name;  ///< none for the emission
    DECAL_TARGETS(ROW)
#undef ROW
};
DecalTargets make_decal_targets(MemoryArena& arena, int width, int height);

/// Any decal may be seen through this clip matrix.
bool decals_in_view(const GpuScene& scene, const glm::mat4& world_to_clip);

// Lays decals over the G-buffer, whichever way it was filled: first over each other in targets of their
// own, where colours and normals can be mixed as they are, then over the dry material. A pixel keeps
// its material's number, lighting model and reflectance.
//
//   reads    depth, normals, the surface's maps
//   edits    color, normals, material, weather, emission
void add_decals(FrameGraph& graph, FrameTargets& targets, DecalTargets& own, const GpuScene& scene,
                SurfaceMaps& maps, DepthMaps& depth_maps, GpuPlace& place,
                const ConstantsRange& constants, const glm::mat4& world_to_clip,
                const VisibleWeather& weather);

}  // namespace petrichor::gpu

#endif
