#ifndef PETRICHOR_GPU_PASSES_RESOLVE_RESOLVE_H
#define PETRICHOR_GPU_PASSES_RESOLVE_RESOLVE_H

#include "gpu/frame/constants_range.h"
#include "gpu/frame/targets.h"
#include "gpu/passes/sky/sky.h"

namespace petrichor::gpu {

// Mean of the samples, as halves and as display bytes (or the light that those are made of); both are
// read by the host, as is the exposure.
//
//   reads    accumulated, glare, sky_light
//   writes   beauty, display: a CPU draws them, elsewhere or with exposed light a dispatch writes them
void add_resolve(FrameGraph& graph, FrameTargets& targets, SkyMaps& sky,
                 const ConstantsRange& constants, const FrameSettings& settings);

}  // namespace petrichor::gpu

#endif
