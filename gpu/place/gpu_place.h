#ifndef PETRICHOR_GPU_PLACE_GPU_PLACE_H
#define PETRICHOR_GPU_PLACE_GPU_PLACE_H

#include <memory>
#include <span>

#include "gpu/device/graph.h"
#include "gpu/device/resources.h"
#include "gpu/frame/frame.h"
#include "gpu/frame/frame_io.h"
#include "gpu/place/place_tree.h"

namespace petrichor::gpu {

/// Patches, their states and the hollows of the ground on the device; one texel each where a frame
/// has none.
class GpuPlace {
public:
    explicit GpuPlace(const Device& device);

    /// Uploads what has changed. Throws Error when tables and states do not belong together.
    void update(const Device& device, const PlaceWeather* place);
    /// Where what falls comes from, for shaders that ask one direction after the other (gpu/passes/surface/shelter.glsl).
    /// Behind the states, whose buffer holds nothing of it since they were updated.
    void set_falls(std::span<const shared::FallConstants> falls);
    bool present() const { return constants_.grid.levels > 0; }
    const shared::PlaceConstants& constants() const { return constants_; }

    GpuBuffer& table() { return *table_; }
    GpuBuffer& states() { return *states_; }
    GpuBuffer& labels() { return *labels_; }
    GpuBuffer& levels() { return *levels_; }

private:
    void make(const Device& device, const PlaceShape& shape, std::size_t levels, const PlaceTree& tree);

    std::unique_ptr<MemoryArena> arena_;
    std::unique_ptr<GpuBuffer> table_, states_, labels_, levels_;
    std::shared_ptr<const PlaceShape> shape_;
    std::vector<std::uint32_t> materials_;  // of the patches
    std::size_t level_count_ = 0;
    shared::PlaceConstants constants_{};
};

/// What a pass reads of it, from binding `first` on: table, states, labels, levels.
void bind_place(Bindings& bindings, std::uint32_t first, GpuPlace& place);

}  // namespace petrichor::gpu

#endif
