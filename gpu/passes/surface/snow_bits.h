#ifndef PETRICHOR_GPU_PASSES_SURFACE_SNOW_BITS_H
#define PETRICHOR_GPU_PASSES_SURFACE_SNOW_BITS_H

#include <algorithm>

#include "gpu/passes/surface_maps/surface_maps.h"
#include "gpu/upload/gpu_scene.h"

namespace petrichor::gpu {

/// SNOW_... of a material in a frame with snow. Where a scene may have snow with a body, its
/// shaders know of it in every frame with snow, thin snow too: a film through a winter asks for half as many then,
/// and points that are no such snow come out the same. Wide ground draws the far part of that snow itself, so it goes
/// by what lies.
class SnowBits {
public:
    SnowBits(const GpuScene& scene, const SurfaceMaps& maps) : tracks_(maps.track_area.width > 0), lies_(scene.snow_lies())
    {
        const std::vector<Draw>& draws = scene.draws();
        may_lie_ = std::any_of(draws.begin(), draws.end(), [](const Draw& draw) { return draw.overlay && !draw.ice; });
    }

    std::uint32_t of(const GpuMaterial& material) const
    {
        const bool wide = (material.besides & BESIDES_WIDE_GROUND) != 0;
        return material.snow | (tracks_ ? SNOW_TRACKS : 0u) | (lies_ || (may_lie_ && !wide) ? SNOW_BODY : 0u);
    }

private:
    bool tracks_;
    bool lies_;
    bool may_lie_ = false;
};

}  // namespace petrichor::gpu

#endif
