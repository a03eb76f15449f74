#ifndef PETRICHOR_GPU_PASSES_ADAPTIVE_ADAPTIVE_H
#define PETRICHOR_GPU_PASSES_ADAPTIVE_ADAPTIVE_H

#include "gpu/frame/constants_range.h"
#include "gpu/frame/targets.h"
#include "gpu/passes/sky/sky.h"
#include "gpu/passes/surface_resolve/surface_resolve.h"

namespace petrichor::gpu {

/// What the first two samples of a frame saw.
struct AdaptiveTargets {
    std::unique_ptr<GpuImage> seen;   ///< draw and depths; adaptive_io.h
    std::unique_ptr<GpuImage> light;  ///< of the first sample
    std::unique_ptr<GpuImage> mean;   ///< of both
};
AdaptiveTargets make_adaptive_targets(MemoryArena& arena, int width, int height);

/// True when the samples of a frame go by what the first two saw: at least four, that all look from
/// one place at one moment.
bool is_adaptive(const Frame& frame);

// Samples from the third on shade only the pixels that the first two leave in doubt; the others take
// the mean of the two. Nothing depends on other frames or on the order of work. `lit` is the image
// that samples are added to.
//
//   after sample 0   keep_first
//   after sample 1   settle: threshold of the display 0..1; `sum`: `lit` holds both samples
//   from sample 2    ask: writes the targets' list of pixels and the resolve's mask; the passes of
//                    the sample then go by them

void add_keep_first(FrameGraph& graph, FrameTargets& targets, ResolveTables& resolve,
                    AdaptiveTargets& own, GpuImage& lit, const ConstantsRange& constants);
void add_settle(FrameGraph& graph, FrameTargets& targets, ResolveTables& resolve, SkyMaps& sky,
                AdaptiveTargets& own, GpuImage& lit, bool sum, float threshold,
                const ConstantsRange& constants);
void add_ask(FrameGraph& graph, FrameTargets& targets, ResolveTables& resolve, AdaptiveTargets& own,
             GpuImage& lit, const ConstantsRange& constants);

}  // namespace petrichor::gpu

#endif
