#ifndef PETRICHOR_GPU_PASSES_REFLECTIONS_PROBE_TABLE_H
#define PETRICHOR_GPU_PASSES_REFLECTIONS_PROBE_TABLE_H

#include <cstdint>
#include <memory>
#include <string>

#include "gpu/device/resources.h"
#include "gpu/passes/patch_light/patch_light.h"

namespace petrichor::gpu {

/// Reflection probes on the device, lit by the patches that they see. Without any the buffers hold one
/// empty entry.
class ProbeTable {
public:
    explicit ProbeTable(const Device& device);

    /// Takes the probes of the scene that `patches` holds, and lights them as it is lit. Does nothing when
    /// neither has changed.
    void relight(const PatchLights& patches);
    std::uint32_t count() const { return count_; }
    /// Milliseconds of the last relight; 0 when nothing had changed.
    double relight_ms() const { return relight_ms_; }

    GpuBuffer& rows() const { return *rows_; }
    GpuBuffer& light() const { return *light_; }
    GpuBuffer& spread() const { return *spread_; }  ///< kMostProbes of ProbeSpread
    GpuBuffer& bands() const { return *bands_; }  ///< kProbeBandTexels a probe

private:
    void make_buffers(std::size_t probes);

    const Device* device_;
    std::unique_ptr<MemoryArena> arena_;
    std::unique_ptr<GpuBuffer> rows_, light_, spread_, bands_;
    std::uint64_t loads_ = 0;  // of the patches that they stand among
    std::string lit_by_;
    std::uint32_t count_ = 0;
    double relight_ms_ = 0.0;
};

}  // namespace petrichor::gpu

#endif
