#ifndef PETRICHOR_GPU_PASSES_LIGHTING_H
#define PETRICHOR_GPU_PASSES_LIGHTING_H

#include "gpu/passes/lights.h"
#include "gpu/passes/sky.h"

namespace petrichor::gpu {

/// What a frame wants of the lighting pass; each choice is a compiled variant.
struct LightingVariant {
    bool weather = true;
    bool shadows = true;
    bool image_based_light = true;
    bool ambient_occlusion = true;
};

// Screen-space ambient occlusion.
//
//   reads    depth, normals
//   writes   screen_occlusion
void add_ambient_occlusion(FrameGraph& graph, FrameTargets& targets,
                           const ConstantsRange& constants);

// Applies weather to the dry material, then light; adds the sample to the sum.
//
//   reads    the G-buffer, screen_occlusion, shadow, sky maps, light lists
//   edits    accumulated
void add_lighting(FrameGraph& graph, FrameTargets& targets, LightTable& lights, SkyMaps& sky,
                  DepthMaps& depth_maps, const ConstantsRange& constants,
                  const LightingVariant& variant);

// Mean of the samples, as halves and as display bytes.
//
//   reads    accumulated, sky_light
//   writes   beauty, display
void add_resolve(FrameGraph& graph, FrameTargets& targets, SkyMaps& sky,
                 const ConstantsRange& constants);

// One labelled output from the G-buffer; `kind` indexes aov_table().
//
//   reads    the G-buffer
//   writes   aovs[slot]
void add_aov(FrameGraph& graph, FrameTargets& targets,
             const ConstantsRange& constants, std::size_t slot, std::uint32_t kind);

}  // namespace petrichor::gpu

#endif
