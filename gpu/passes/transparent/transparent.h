#ifndef PETRICHOR_GPU_PASSES_TRANSPARENT_TRANSPARENT_H
#define PETRICHOR_GPU_PASSES_TRANSPARENT_TRANSPARENT_H

#include <functional>
#include <utility>

#include "gpu/frame/frame_constants.h"
#include "gpu/frame/targets.h"
#include "gpu/outputs/light_parts.h"
#include "gpu/passes/sky/sky.h"
#include "gpu/passes/surface/surface.h"

namespace petrichor::gpu {

/// Images of the layers of one frame size.
struct TransparentTargets {
    FrameTargets layer;                     ///< of the layer that is at work
    std::unique_ptr<GpuImage> other_depth;  ///< of the layer before
    std::unique_ptr<GpuImage> through;      ///< of that layer: SurfaceLayer::through
    std::unique_ptr<GpuImage> solid;        ///< the picture of this sample behind all layers
    std::unique_ptr<GpuImage> front;        ///< light of the layers so far
    std::unique_ptr<GpuImage> left;         ///< what they let through; alpha: metres of the nearest, 0: there is none
    bool bends = false;                     ///< the scene has what bends or blurs (GpuMaterial::bends); else those below are
                                            ///< null, the first of them of one texel
    std::unique_ptr<GpuImage> bent;         ///< the first such layer of a pixel, bent_layer.glsl
    std::unique_ptr<GpuImage> tint;         ///< what it lets through of what is behind it; alpha: a drop stands there
    std::unique_ptr<GpuImage> behind;       ///< light of the layers behind it; alpha: metres of the nearest, 0: none
    std::unique_ptr<GpuImage> behind_left;  ///< what those let through
};
TransparentTargets make_transparent_targets(const Device& device, MemoryArena& arena, int width,
                                            int height, int light_words, bool bends);

/// Layers that a view of the scene may need; 0: nothing in view lets light through.
int transparent_layers(const GpuScene& scene, const glm::mat4& world_to_clip);

// What lets light through is peeled into layers, nearest first (Everitt 2001): each is a G-buffer of
// its own that is lit as the solid picture is, by the same passes. Where there are `more` than `layers`,
// those of the last one are seen or not by chance.
//
//   before the solid picture is lit: call begin_transparent(), and light into `solid` instead of the sum
//   then add_transparent(): `draw_layer` adds the surfaces of a layer, `light_layer` lights it
//
//   reads    depth, solid, the layers' G-buffers
//   edits    accumulated; light_parts of frames that ask, by the same ways
void begin_transparent(FrameGraph& graph, TransparentTargets& own, LightParts& parts,
                       const ConstantsRange& constants);
void add_transparent(FrameGraph& graph, FrameTargets& targets, TransparentTargets& own,
                     LightParts& parts, const GpuScene& scene, SkyMaps& sky,
                     const ConstantsRange& constants, int layers, bool more, bool gusts, const std::function<void(const SurfaceLayer&)>& draw_layer,
                     const std::function<void()>& light_layer);

}  // namespace petrichor::gpu

#endif
