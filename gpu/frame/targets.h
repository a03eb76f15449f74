#ifndef PETRICHOR_GPU_FRAME_TARGETS_H
#define PETRICHOR_GPU_FRAME_TARGETS_H

#include <memory>

#include "gpu/device/resources.h"

namespace petrichor::gpu {

/// What the surface pass writes: the dry material and the weather at each pixel.
struct GBuffer {
    std::unique_ptr<GpuImage> depth;    ///< reversed, infinite far plane
    std::unique_ptr<GpuImage> color;    ///< square root of base colour; ambient occlusion
    std::unique_ptr<GpuImage> normals;  ///< base normal, cover normal (water or snow), octahedral
    std::unique_ptr<GpuImage>
        material;  ///< perceptual roughness, metallic, porosity; model and reflectance
    std::unique_ptr<GpuImage> weather;   ///< film, standing water, snow, frost; each 0..1
    std::unique_ptr<GpuImage> emission;  ///< linear radiance
};

/// Images and buffers of one frame size.
struct FrameTargets {
    int width = 0;
    int height = 0;
    GBuffer gbuffer;
    SamplerHandle nearest;                ///< for texelFetch
    std::unique_ptr<GpuImage> occlusion;  ///< screen-space ambient occlusion, 1 open
    std::unique_ptr<GpuImage>
        radiance;  ///< of this sample, before smooth reflections; alpha as below
    std::unique_ptr<GpuImage>
        mirror_weight;                       ///< what a smooth surface reflects of its surroundings
    std::unique_ptr<GpuImage> mirror_shape;  ///< its normal (octahedral), roughness, sky visibility
    std::unique_ptr<GpuImage> accumulated;   ///< sum over samples; alpha counts surfaces
    std::unique_ptr<GpuBuffer> coarse_lights;
    std::unique_ptr<GpuBuffer> light_lists;
    std::unique_ptr<GpuBuffer> beauty;   ///< RGBA half bits, read by the host
    std::unique_ptr<GpuBuffer> display;  ///< RGBA8, read by the host
    std::vector<std::unique_ptr<GpuBuffer>> aovs;

    int tiles_x() const;
    int tiles_y() const;
    int coarse_x() const;
    int coarse_y() const;
};

/// light_words: 32-bit words for one bit a light.
FrameTargets make_frame_targets(const Device& device, MemoryArena& arena, int width, int height,
                                int light_words);

}  // namespace petrichor::gpu

#endif
