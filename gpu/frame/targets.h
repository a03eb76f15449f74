#ifndef PETRICHOR_GPU_FRAME_TARGETS_H
#define PETRICHOR_GPU_FRAME_TARGETS_H

#include <memory>

#include "gpu/device/graph.h"
#include "gpu/frame/gbuffer_table_io.h"
#include "gpu/upload/gpu_scene.h"

namespace petrichor::gpu {

/// What the surface pass writes, by the rows of gbuffer_table_io.h.
struct GBuffer {
    std::unique_ptr<GpuImage> depth;  ///< reversed, infinite far plane
#define ROW(name, location, format, when, meaning) std::unique_ptr<GpuImage> name;
    GBUFFER_TABLE(ROW)
#undef ROW
};

/// The same as texels of buffers, row by row: a CPU reads those several times as fast as images.
struct GBufferRows {
    std::unique_ptr<GpuBuffer> depth;
#define ROW(name, location, format, when, meaning) std::unique_ptr<GpuBuffer> name;
    GBUFFER_TABLE(ROW)
#undef ROW
};

/// Parts that a frame may leave out; what belongs to them is neither written nor read then.
struct GBufferParts {
    bool weather = true;
    bool emission = true;
    bool baked = false;  ///< with emission only
};
/// What a frame of the scene needs.
GBufferParts gbuffer_parts(const GpuScene& scene, bool weather);

/// The targets as attachments, by location; those of parts left out are empty.
std::vector<Attachment> gbuffer_attachments(GBuffer& gbuffer, const GBufferParts& parts);

/// Tiles of 8 x 8 pixels: gpu/frame/pixel_list_io.h, and the arguments of a dispatch over them.
struct TileList {
    std::unique_ptr<GpuBuffer> tiles;
    std::unique_ptr<GpuBuffer> groups;
};

/// Images and buffers of one frame size.
struct FrameTargets {
    int width = 0;
    int height = 0;
    GBuffer gbuffer;
    GBufferRows rows;                     ///< filled by add_gbuffer_rows
    bool wet_alone = false;  ///< this frame's weather is kept as WEATHER_WET, in place of its target in ..
    std::unique_ptr<GpuImage> wet;
    std::unique_ptr<GpuBuffer> wet_rows;
    SamplerHandle nearest;                ///< for texelFetch
    SamplerHandle between;                ///< between texels of floats, where the device filters them
    bool filters = false;                 ///< whether it does
    std::uint32_t lanes = 0;              ///< of a CPU's subgroup (gpu/frame/lane_words.glsl); 0: another device
    std::unique_ptr<GpuBuffer> occlusion;  ///< of the screen: a word a block, formulas/light/occlusion_points.h
    std::unique_ptr<GpuBuffer> occlusion_points;  ///< of blocks
    bool keeps_bent = false;  ///< both have bent normals behind that (gpu/frame/occlusion_blocks.glsl)
    std::unique_ptr<GpuImage>
        radiance;  ///< of this sample, before smooth reflections; alpha as below
    std::unique_ptr<GpuImage>
        mirror_weight;                       ///< what a smooth surface reflects of its surroundings
    std::unique_ptr<GpuImage> mirror_shape;  ///< its normal (octahedral), roughness, sky visibility
    std::unique_ptr<GpuImage> accumulated;   ///< sum over samples; alpha counts surfaces
    std::unique_ptr<GpuBuffer> accumulated_rows;  ///< of it, where a CPU draws the picture
    std::unique_ptr<GpuImage> beauty_drawn, display_drawn;  ///< likewise what it draws, the words of both below
    std::unique_ptr<GpuImage> lamp_glow;  ///< of blocks of pixels; alpha: how far they are
    std::vector<std::unique_ptr<GpuImage>> glare;  ///< levels of half the picture's size and less
    std::unique_ptr<GpuBuffer> coarse_lights;
    std::unique_ptr<GpuBuffer> light_lists;
    std::unique_ptr<GpuBuffer> pixel_list;    ///< gpu/frame/pixel_list_io.h
    std::unique_ptr<GpuBuffer> pixel_groups;  ///< the arguments of a dispatch over it
    std::unique_ptr<GpuBuffer> mirror_list;    ///< likewise of pixels that have a mirror_weight, or what occlusion lists
    std::unique_ptr<GpuBuffer> mirror_groups;
    std::unique_ptr<GpuBuffer> ice_list;  ///< likewise of pixels that show icicles; null until some hang
    std::unique_ptr<GpuBuffer> ice_groups;
    TileList surface_tiles;  ///< that show a surface
    TileList open_tiles;     ///< that show none somewhere
    std::unique_ptr<GpuBuffer> patch_points;       ///< gpu/frame/patch_points_io.h
    std::unique_ptr<GpuBuffer> beauty;             ///< RGBA half bits, read by the host
    std::unique_ptr<GpuBuffer> display;            ///< RGBA8, or half bits of exposed light; read by the host
    std::vector<std::unique_ptr<GpuBuffer>> aovs;  ///< read by the host; gpu/outputs/aov.h

    /// Which of WEATHER_.. a pass reads in a frame that keeps some.
    std::uint32_t weather_kept() const { return wet_alone ? WEATHER_WET : WEATHER_WHOLE; }
    GpuBuffer& weather_rows() { return wet_alone ? *wet_rows : *rows.weather; }
    int tiles_x() const;
    int tiles_y() const;
    int coarse_x() const;
    int coarse_y() const;
};

/// Adds the rows of depth and all targets at `first` and behind, as gbuffer_read.glsl reads them.
void bind_gbuffer(Bindings& bindings, std::uint32_t first, FrameTargets& targets);

// Copies what surfaces (and decals) have written from the images into the rows.
//
//   reads    the G-buffer
//   writes   its rows
void add_gbuffer_rows(FrameGraph& graph, FrameTargets& targets, const GBufferParts& parts);

/// Room for the pixels that show icicles, once.
void make_ice_list(FrameTargets& targets, MemoryArena& arena);

/// Makes both anew, with room for bent normals or without.
void make_occlusion(FrameTargets& targets, MemoryArena& arena, bool bent);

/// light_words: 32-bit words for one bit a light.
VkDeviceSize light_lists_bytes(int width, int height, int light_words);
FrameTargets make_frame_targets(const Device& device, MemoryArena& arena, int width, int height,
                                int light_words);

}  // namespace petrichor::gpu

#endif
