#ifndef PETRICHOR_GPU_PASSES_LIGHTING_LIGHT_TABLES_H
#define PETRICHOR_GPU_PASSES_LIGHTING_LIGHT_TABLES_H

#include <memory>
#include <span>
#include <vector>

#include "gpu/device/graph.h"
#include "gpu/upload/scene_names.h"

namespace petrichor::gpu {

/// Matrices of linearly transformed cosines, LTC_TABLE_SIDE rows of as many (formulas/light/ltc.h).
std::span<const glm::vec4> ltc_table();

/// What lighting looks up and no frame changes.
class LightTables {
public:
    explicit LightTables(const Device& device);

    /// The profiles of a scene's lamps. The device must not be drawing.
    void load(const std::vector<LightProfile>& profiles);
    /// Fills the table of skin.
    void need_skin();

    GpuBuffer& ltc() const { return *ltc_; }
    GpuBuffer& profiles() const { return *profiles_; }
    GpuBuffer& skin() const { return *skin_; }
    GpuImage& no_shares() const { return *no_shares_; }  ///< stands in where none are read

private:
    const Device* device_;
    MemoryArena arena_;
    std::unique_ptr<MemoryArena> profile_arena_;
    std::unique_ptr<GpuBuffer> ltc_, skin_, profiles_;
    std::unique_ptr<GpuImage> no_shares_;
    bool has_skin_ = false;
};

}  // namespace petrichor::gpu

#endif
