#ifndef PETRICHOR_GPU_PASSES_FALLING_FALLING_H
#define PETRICHOR_GPU_PASSES_FALLING_FALLING_H

#include "gpu/frame/constants_range.h"
#include "gpu/frame/targets.h"
#include "gpu/passes/depth_maps/depth_maps.h"
#include "gpu/passes/falling/falling_field.h"
#include "gpu/passes/sky/sky.h"

namespace petrichor::gpu {

/// The drops of a frame as the shader reads them; kept and grown from frame to frame.
class FallingTable {
public:
    explicit FallingTable(const Device& device) : device_(&device) {}
    void fill(const std::vector<shared::FallingDrop>& drops);
    GpuBuffer& texels() const { return *buffer_; }
    std::uint32_t count() const { return count_; }

private:
    const Device* device_;
    std::unique_ptr<MemoryArena> arena_;
    std::unique_ptr<GpuBuffer> buffer_;
    std::size_t room_ = 0;
    std::uint32_t count_ = 0;
};

// Drops and flakes over the picture, far ones first: lit by the sky, the sun and lamps, hidden by
// what is before them, none below what the shelter map holds. Labels and outputs of surfaces do not
// see them.
//
//   reads    depth, shelter, shadow, sky_light, the table
//   edits    accumulated (colour; alpha counts surfaces)
//   variant  shelter, sun
void add_falling(FrameGraph& graph, FrameTargets& targets, DepthMaps& maps, SkyMaps& sky,
                 FallingTable& table, const ConstantsRange& constants, bool shelter, bool sun);

}  // namespace petrichor::gpu

#endif
