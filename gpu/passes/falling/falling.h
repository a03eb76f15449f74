#ifndef PETRICHOR_GPU_PASSES_FALLING_FALLING_H
#define PETRICHOR_GPU_PASSES_FALLING_FALLING_H

#include <span>

#include "gpu/frame/constants_range.h"
#include "gpu/frame/targets.h"
#include "gpu/passes/depth_maps/depth_maps.h"
#include "gpu/passes/falling/falling_field.h"
#include "gpu/passes/sky/sky.h"

namespace petrichor::gpu {

/// The drops or splashes of a frame as the shader reads them; kept and grown from frame to frame.
class FallingTable {
public:
    explicit FallingTable(const Device& device) : device_(&device) {}
    template <class T>
    void fill(const std::vector<T>& sprites)
    {
        count_ = static_cast<std::uint32_t>(sprites.size());
        fill_bytes(std::as_bytes(std::span(sprites)));
    }
    GpuBuffer& texels() const { return *buffer_; }
    GpuBuffer& lit() const { return *lit_; }          ///< a texel a drop, what falling_lit writes
    GpuBuffer& corners() const { return *corners_; }  ///< indices of their rectangles: six for four vertices
    std::uint32_t count() const { return count_; }

private:
    void fill_bytes(std::span<const std::byte> bytes);

    const Device* device_;
    std::unique_ptr<MemoryArena> arena_;
    std::unique_ptr<GpuBuffer> buffer_;
    std::unique_ptr<GpuBuffer> lit_;
    std::unique_ptr<GpuBuffer> corners_;
    std::size_t room_ = 0;
    std::uint32_t count_ = 0;
};

// Drops and flakes over the picture, far ones first, and the crowns of drops that hit: lit by the
// sky, the sun and lamps, hidden by what is before them, none below what the shelter map holds. Labels and outputs of surfaces do not
// see them.
//
//   reads    depth, shelter, shadow, sky_light, the tables
//   edits    accumulated (colour; alpha counts surfaces, or with `hides` what is hidden)
//   variant  shelter, sun
void add_falling(FrameGraph& graph, FrameTargets& targets, DepthMaps& maps, SkyMaps& sky,
                 const FallingTable& drops, const FallingTable& splashes,
                 const ConstantsRange& constants, bool shelter, bool sun, bool hides);

}  // namespace petrichor::gpu

#endif
