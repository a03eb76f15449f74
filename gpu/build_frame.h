#ifndef PETRICHOR_GPU_BUILD_FRAME_H
#define PETRICHOR_GPU_BUILD_FRAME_H

#include "gpu/frame/frame_constants.h"
#include "gpu/outputs/aov.h"
#include "gpu/outputs/light_parts.h"
#include "gpu/passes/adaptive/adaptive.h"
#include "gpu/passes/decals/decals.h"
#include "gpu/passes/falling/drips.h"
#include "gpu/passes/falling/falling.h"
#include "gpu/passes/lamp_glow/lamp_glow.h"
#include "gpu/passes/lighting/lighting.h"
#include "gpu/passes/patch_light/patch_light.h"
#include "gpu/passes/reflections/picture_around.h"
#include "gpu/passes/reflections/probe_table.h"
#include "gpu/passes/surface/surface.h"
#include "gpu/passes/surface_resolve/surface_resolve.h"
#include "gpu/passes/transparent/transparent.h"
#include "gpu/upload/gpu_scene.h"
#include "gpu/place/gpu_place.h"

namespace petrichor::gpu {

/// Everything on the device that a frame reads or writes.
struct FrameResources {
    const Device* device = nullptr;
    const Frame* whole = nullptr;  ///< the picture that the frame is a window of; null: it is the picture
    const GpuScene* scene = nullptr;
    FrameTargets* targets = nullptr;
    SurfaceMaps* surface_maps = nullptr;
    DepthMaps* depth_maps = nullptr;
    LightTables* light_tables = nullptr;
    LampShadows* lamp_shadows = nullptr;
    SkyMaps* sky = nullptr;
    ResolveTables* resolve = nullptr;  ///< null: surfaces are shaded as fragments
    TransparentTargets* transparent = nullptr;  ///< null: what lets light through goes by chance
    AdaptiveTargets* adaptive = nullptr;  ///< null: every sample shades every pixel
    DecalTargets* decals = nullptr;    ///< null: the scene has none
    LightTable* lights = nullptr;
    VertexLight* vertex_light = nullptr;
    LampGlow* lamp_glow = nullptr;
    SeenTriangles* triangles = nullptr;
    FallingTable* falling = nullptr;
    FallingTable* splashes = nullptr;
    std::span<const scene::DripPoint> drips;  ///< where water comes off edges
    PatchLights* patches = nullptr;
    ProbeTable* probes = nullptr;
    GpuPlace* place = nullptr;
    LightParts* parts = nullptr;
    PictureAround* around = nullptr;  ///< beyond the window that the frame is; null: nothing is known there
    PictureAround* kept = nullptr;    ///< what the first sample sees is kept there
    float snow_lift_m = 0.0f;  ///< 0: snow has no body
    bool over_snow = false;    ///< the eye stands in none
    std::uint32_t ice_model = 0;  ///< what the G-buffer has for the material of icicles that hang; 0: none
    bool materials = false;  ///< an output asks which material a pixel has
    GpuImage* environment = nullptr;  ///< lat-long, or null for the analytic sky
    GpuBuffer* constants = nullptr;   ///< one range a sample
    VkDeviceSize constants_stride = 0;
    std::uint32_t* falls_before = nullptr;  ///< directions that the last pipelines of rain or snow were made for; replaced
    bool own_lighting = false;  ///< the scene has lighting models that are not built in
};

/// The frame of the whole picture.
inline const Frame& whole_of(const Frame& frame, const FrameResources& r)
{
    return r.whole ? *r.whole : frame;
}

/// Light between surfaces is that of the scene's patches.
bool uses_patches(const Frame& frame, const FrameResources& resources);

/// What comes before all else: the sky, its light and the exposure, and the means of its bins for patches.
FrameGraph build_sky(const Frame& frame, const Sun& sun, FrameResources& resources);

/// Samples of a frame that see the scene at the same moment.
struct SampleRange {
    std::uint32_t first = 0;
    std::uint32_t end = 1;
};

/// The passes of these samples in order, behind the last of the frame what follows them. Also writes their
/// constants.
FrameGraph build_frame(const Frame& frame, const Sun& sun, FrameResources& resources,
                       const std::vector<AovGroup>& aov_groups, SampleRange range,
                       FallingFacts& falling);

}  // namespace petrichor::gpu

#endif
