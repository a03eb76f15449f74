#ifndef PETRICHOR_GPU_OUTPUTS_AOV_H
#define PETRICHOR_GPU_OUTPUTS_AOV_H

#include "gpu/device/graph.h"
#include "gpu/frame/constants_range.h"
#include "gpu/frame/targets.h"

namespace petrichor::gpu {

// One labelled output from the G-buffer; `kind` indexes aov_table().
//
//   reads    the G-buffer
//   writes   aovs[slot]
void add_aov(FrameGraph& graph, FrameTargets& targets, const ConstantsRange& constants,
             std::size_t slot, std::uint32_t kind, bool has_weather, bool has_emission);

}  // namespace petrichor::gpu

#endif
