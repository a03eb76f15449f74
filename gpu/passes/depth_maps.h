#ifndef PETRICHOR_GPU_PASSES_DEPTH_MAPS_H
#define PETRICHOR_GPU_PASSES_DEPTH_MAPS_H

#include <array>

#include "gpu/detail/gpu_scene.h"
#include "gpu/detail/graph.h"
#include "gpu/shaders/interface/frame.h"

namespace petrichor::gpu {

/// One view of the scene from far away: along the sun (a shadow cascade) or along the falling rain.
struct DepthView {
    glm::mat4 clip_from_world{1.0f};
    glm::mat4 map_from_world{1.0f};  ///< to (u, v, depth), each 0..1
    float texel_m = 0.0f;

    bool operator==(const DepthView& other) const
    {
        return clip_from_world == other.clip_from_world;
    }
};

/// Orthographic view along `direction` that covers a sphere, with its window snapped to whole
/// texels; in depth it spans the whole scene.
DepthView orthographic_view(const glm::vec3& direction, const glm::vec3& centre_m, float radius_m,
                            const Bounds& scene, int size);

struct DepthMaps {
    DepthMaps(const Device& device, MemoryArena& arena);

    std::unique_ptr<GpuImage> shadow;   ///< one layer a cascade
    std::unique_ptr<GpuImage> shelter;  ///< seen along the falling rain
    std::unique_ptr<GpuImage> sky;      ///< seen from directions over the upper hemisphere
    SamplerHandle compare;              ///< lit when at least as near as the map
    std::vector<ImageViewHandle> shadow_layers;
    std::vector<ImageViewHandle> sky_layers;
    // What the maps hold now; equal views are not drawn again.
    std::array<DepthView, SHADOW_CASCADES> shadow_views;
    DepthView shelter_view;
    std::array<DepthView, SKY_DIRECTIONS> sky_views;
    bool shadow_valid = false;
    bool shelter_valid = false;
    bool sky_valid = false;

    static constexpr int kShadowSize = 2048;
    static constexpr int kShelterSize = 2048;
    static constexpr int kSkySize = 512;
};

// Depth of the scene from the sun, all cascades.
//
//   writes   shadow
void add_shadow(FrameGraph& graph, DepthMaps& maps, const GpuScene& scene);

// Depth of the scene from all over the sky, for the shadow of skylight.
//
//   writes   sky
void add_sky_visibility(FrameGraph& graph, DepthMaps& maps, const GpuScene& scene);

// Depth of the scene along the falling rain.
//
//   writes   shelter
void add_shelter(FrameGraph& graph, DepthMaps& maps, const GpuScene& scene);

}  // namespace petrichor::gpu

#endif
