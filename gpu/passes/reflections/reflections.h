#ifndef PETRICHOR_GPU_PASSES_REFLECTIONS_REFLECTIONS_H
#define PETRICHOR_GPU_PASSES_REFLECTIONS_REFLECTIONS_H

#include "gpu/frame/constants_range.h"
#include "gpu/frame/pixel_list.h"
#include "gpu/passes/reflections/probe_table.h"
#include "gpu/passes/sky/sky.h"

namespace petrichor::gpu {

// Adds what smooth surfaces mirror of the picture itself, else of the probes around, else of the sky; then
// adds the sample to the sum.
//
//   reads    depth, radiance, mirror_weight, mirror_shape, sky_specular, probes
//   edits    accumulated
void add_reflections(FrameGraph& graph, FrameTargets& targets, SkyMaps& sky,
                     const ProbeTable& probes, bool with_probes, const ConstantsRange& constants,
                     Pixels pixels = Pixels::All);

}  // namespace petrichor::gpu

#endif
