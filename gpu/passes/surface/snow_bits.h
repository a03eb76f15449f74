#ifndef PETRICHOR_GPU_PASSES_SURFACE_SNOW_BITS_H
#define PETRICHOR_GPU_PASSES_SURFACE_SNOW_BITS_H

#include <algorithm>

#include "gpu/passes/surface_maps/surface_maps.h"
#include "gpu/upload/gpu_scene.h"

namespace petrichor::gpu {

/// SNOW_... that the snow of a frame adds to those of a material. Where a scene may have snow with a body, its
/// shaders know of it in every frame with snow, thin snow too: a film through a winter asks for half as many then,
/// and points that are no such snow come out the same. Wide ground draws the far part of that snow itself, so it goes
/// by what lies.
inline std::uint32_t snow_bits(const GpuScene& scene, const SurfaceMaps& maps, const GpuMaterial& material)
{
    const std::vector<Draw>& draws = scene.draws();
    const bool wide = (material.besides & BESIDES_WIDE_GROUND) != 0;
    const bool body = scene.overlaid() || (!wide && std::any_of(draws.begin(), draws.end(),
                                                                [](const Draw& draw) { return draw.overlay; }));
    return (maps.track_area.width > 0 ? SNOW_TRACKS : 0u) | (body ? SNOW_BODY : 0u);
}

}  // namespace petrichor::gpu

#endif
