#ifndef PETRICHOR_GPU_PASSES_DEPTH_MAPS_DEPTH_MAPS_H
#define PETRICHOR_GPU_PASSES_DEPTH_MAPS_DEPTH_MAPS_H

#include <array>
#include <vector>

#include "gpu/device/graph.h"
#include "gpu/frame/depth_view.h"
#include "gpu/upload/seen_triangles.h"

namespace petrichor::gpu {

struct DepthMaps {
    DepthMaps(const Device& device, MemoryArena& arena);

    std::unique_ptr<GpuImage> shadow;   ///< one layer a cascade
    std::unique_ptr<GpuImage> shelter;  ///< seen along the falling rain
    std::unique_ptr<GpuImage> sky;      ///< seen from directions over the upper hemisphere
    std::unique_ptr<GpuBuffer> depth_quads;  ///< four texels in one, of those that were asked for (add_depth_quads)
    SamplerHandle compare;              ///< lit when at least as near as the map
    SamplerHandle plain;                ///< the depths themselves
    std::vector<ImageViewHandle> shadow_layers;
    std::vector<ImageViewHandle> sky_layers;
    // What the maps hold now; equal views are not drawn again.
    std::array<DepthView, SHADOW_CASCADES> shadow_views;
    DepthView shelter_view;
    std::array<DepthView, SKY_DIRECTIONS> sky_views;
    std::array<bool, SHADOW_CASCADES> shadow_valid{};
    bool shelter_valid = false;
    bool sky_valid = false;
    std::array<bool, SKY_DIRECTIONS> depth_quads_valid{};

    /// Draws all of them again with the next frame that asks.
    void forget()
    {
        shadow_valid.fill(false);
        shelter_valid = sky_valid = false;
    }
};

/// What a map is for: light passes through what is blended, in part; rain and snow are not asked. What
/// lies on the scene shadows the sun alone: what is below it asks the sky, and it changes with the frame,
/// while maps of lamps are kept. A lamp is not shadowed by what glows, the glass around it, nor by what is nearer than its map's near
/// plane.
enum class Falls { Light, Sky, Rain, Lamp };

/// What a map draws.
struct Casters {
    /// Instances of one shape and material: one draw call.
    struct Run {
        const Draw* first = nullptr;
        std::uint32_t count = 1;
        std::uint32_t first_place = 0;
    };
    std::vector<const Draw*> single;
    std::vector<Run> runs;
    std::vector<const Draw*> shapes;        ///< that rays are marched to
    int size = 0;                           ///< texels a side of the map
    GpuBuffer* places = nullptr;            ///< of the runs (gpu/upload/instance_places.h)
    std::shared_ptr<const SeenDraws> seen;  ///< of single ones; null: all their triangles
};

/// What a square map of `size` texels may show where it is asked.
Casters casters_in(SeenTriangles& triangles, const GpuScene& scene, const glm::mat4& clip_from_world,
                   int size, Falls falls, const AskedPart& asked = {});
void draw_casters(PassContext& pass, const GpuScene& scene, const glm::mat4& clip_from_world,
                  Falls falls, const Casters& casters);

/// One layer of an array as an attachment.
ImageViewHandle layer_view(const Device& device, const GpuImage& image, std::uint32_t layer);

// Depth of the scene from the sun: the cascades from number `first` on, those whose views have changed. From another
// than the first on, without what lies on the scene.
//
//   writes   shadow
void add_shadow(FrameGraph& graph, DepthMaps& maps, const GpuScene& scene, SeenTriangles& triangles,
                const std::array<DepthView, SHADOW_CASCADES>& views, std::size_t first = 0);

// Depth of the scene from all over the sky, for the shadow of skylight.
//
//   writes   sky
void add_sky_visibility(FrameGraph& graph, DepthMaps& maps, const GpuScene& scene,
                        SeenTriangles& triangles);

// Packs maps of the sky (formulas/weather/depth_quads.h), which a CPU reads several times as fast, unless they lie there.
//
//   reads    sky
//   writes   depth_quads
void add_depth_quads(FrameGraph& graph, DepthMaps& maps, const std::vector<int>& directions);

// Depth of the scene along the falling rain.
//
//   writes   shelter
void add_shelter(FrameGraph& graph, DepthMaps& maps, const GpuScene& scene,
                 SeenTriangles& triangles);

}  // namespace petrichor::gpu

#endif
