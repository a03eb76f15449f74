#ifndef PETRICHOR_GPU_PASSES_SURFACE_RESOLVE_SURFACE_RESOLVE_H
#define PETRICHOR_GPU_PASSES_SURFACE_RESOLVE_SURFACE_RESOLVE_H

#include "gpu/device/graph.h"
#include "gpu/frame/constants_range.h"
#include "gpu/frame/frame_constants.h"
#include "gpu/frame/targets.h"
#include "gpu/passes/depth_maps/depth_maps.h"
#include "gpu/passes/surface_maps/surface_maps.h"
#include "gpu/passes/vertex_light/vertex_light.h"
#include "gpu/upload/gpu_scene.h"
#include "gpu/place/gpu_place.h"

namespace petrichor::gpu {

/// The resolve with users' own surfaces in it (PipelineCache::add_shader).
inline constexpr const char* kOwnResolveShader = "own_surface_resolve.comp";

/// What the resolve reads beside the scene: the table of its draws, and the lists of pixels.
struct ResolveTables {
    std::unique_ptr<GpuImage> ids;      ///< draw (from 1) and triangle of each pixel
    std::unique_ptr<GpuBuffer> id_rows;  ///< the same as texels, row by row
    std::unique_ptr<GpuBuffer> draws;   ///< transforms and index ranges
    std::unique_ptr<GpuBuffer> counts;  ///< two words a material
    std::unique_ptr<GpuBuffer> pixels;  ///< list after list
    std::unique_ptr<GpuBuffer> asked;   ///< passes/adaptive: two words a tile, a bit a pixel
    std::unique_ptr<GpuBuffer> groups;  ///< arguments of a dispatch a list
    std::unique_ptr<GpuImage> shares;   ///< gpu/frame/layer_shares.glsl
    std::uint64_t poses = 0;            ///< GpuScene::poses() that `draws` is of
};

/// For one scene and one frame size. The lists hold every pixel once.
ResolveTables make_resolve_tables(const Device& device, MemoryArena& arena, const GpuScene& scene,
                                  int width, int height);

/// Brings the transforms up to the scene's pose.
void update_draws(const Device& device, ResolveTables& tables, const GpuScene& scene);

/// What of SteepTriangles the lists of a frame keep apart: in rain, without snow and frost.
std::uint8_t listed_steep(const VisibleWeather& weather);

// Fills the G-buffer from a visibility buffer (passes/visibility): every pixel is evaluated once,
// from a list for each material, by the same text as the surface pass; what is steep has lists of its own where water stands.
//
// Of samples that go by the list (passes/adaptive), those of `asked` alone.
//
//   reads    ids, the scene's vertices and indices as texels, the maps of the weather, light at vertices
//   writes   colour, normals, material; weather and emission when the frame has them
void add_surface_resolve(FrameGraph& graph, FrameTargets& targets, ResolveTables& tables,
                         const GpuScene& scene, SurfaceMaps& maps, DepthMaps& depth_maps,
                         GpuPlace& place, const VertexLight& vertex_light, const ConstantsRange& constants,
                         const VisibleWeather& weather, bool asked);

}  // namespace petrichor::gpu

#endif
