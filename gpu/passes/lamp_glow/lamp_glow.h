#ifndef PETRICHOR_GPU_PASSES_LAMP_GLOW_LAMP_GLOW_H
#define PETRICHOR_GPU_PASSES_LAMP_GLOW_LAMP_GLOW_H

#include <vector>

#include "gpu/frame/constants_range.h"
#include "gpu/frame/frame.h"
#include "gpu/frame/targets.h"

namespace petrichor::gpu {

/// What the glow of lamps is computed from.
class LampGlow {
public:
    explicit LampGlow(const Device& device);
    /// The lamps of a frame; false when their light is not scattered: there is no fog, rain or snow
    /// beyond a clear day's haze, the fog follows no physical law, or lamps do not glow.
    bool prepare(const Frame& frame, const shared::FrameConstants& constants,
                 const std::vector<Light>& lamps);
    GpuBuffer& lamps() const { return *lamps_; }
    GpuImage& function() const { return *function_; }
    const SamplerHandle& linear() const { return linear_; }

private:
    MemoryArena arena_;
    std::unique_ptr<GpuBuffer> lamps_;
    std::unique_ptr<GpuImage> function_;  ///< T of formulas/light/lamp_glow.h
    SamplerHandle linear_;
};

// Light of lamps that the air scatters towards the eye, once and to all sides, before what is seen;
// walls between a lamp and the air are not asked. Computed for blocks of pixels and laid between
// them where their depths agree.
//
//   reads    depth
//   writes   lamp_glow
//   edits    accumulated (colour)
void add_lamp_glow(FrameGraph& graph, FrameTargets& targets, const LampGlow& glow,
                   const ConstantsRange& constants);

}  // namespace petrichor::gpu

#endif
