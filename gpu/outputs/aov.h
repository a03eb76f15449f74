#ifndef PETRICHOR_GPU_OUTPUTS_AOV_H
#define PETRICHOR_GPU_OUTPUTS_AOV_H

#include "gpu/frame/constants_range.h"
#include "gpu/frame/targets.h"
#include "gpu/lighting/lighting_models.h"
#include "gpu/outputs/aov_table.h"
#include "gpu/place/gpu_place.h"

namespace petrichor::gpu {

/// Rows of the table that one dispatch writes into one buffer, in the order of the table.
struct AovGroup {
    std::uint64_t rows = 0;   ///< a bit each
    std::size_t numbers = 0;  ///< a pixel
};

/// One group for all rows of the G-buffer that are asked, or as few as keep each buffer within `most_bytes`.
std::vector<AovGroup> group_aovs(const std::vector<std::size_t>& rows, std::size_t pixels,
                                 std::uint64_t most_bytes);

// Labelled outputs from the G-buffer.
//
//   prepass          models that can gather light first do
//   materials_only   no weather is seen; its targets were written for the numbers of the materials
//
//   reads    the G-buffer, the states of the patches
//   writes   aovs[buffer]
void add_aovs(FrameGraph& graph, FrameTargets& targets, GpuPlace& place,
              const ConstantsRange& constants, const AovGroup& group, std::size_t buffer,
              const GBufferParts& parts, const LightingModels& models, bool prepass, bool materials_only);

/// The numbers of a row, pixel by pixel, as the last frame wrote them.
std::vector<float> read_aov(const FrameTargets& targets, const std::vector<AovGroup>& groups,
                            std::size_t row);

}  // namespace petrichor::gpu

#endif
