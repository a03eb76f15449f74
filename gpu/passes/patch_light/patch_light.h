#ifndef PETRICHOR_GPU_PASSES_PATCH_LIGHT_PATCH_LIGHT_H
#define PETRICHOR_GPU_PASSES_PATCH_LIGHT_PATCH_LIGHT_H

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formulas/light/patch_cells.h"
#include "gpu/device/graph.h"
#include "gpu/frame/frame.h"
#include "gpu/frame/patch_scene.h"
#include "gpu/frame/sun.h"
#include "gpu/passes/sky/sky.h"
#include "scene/patches/radiosity.h"

namespace petrichor::gpu {

/// Light of patches on the device, as the lighting pass looks it up. Without a scene of patches the
/// buffers hold one empty entry and grid.levels is 0.
class PatchLights {
public:
    explicit PatchLights(const Device& device);

    /// Takes what was traced; null: none.
    void load(std::shared_ptr<const PatchScene> scene);
    bool loaded() const { return scene_ != nullptr && !scene_->patches.empty(); }

    /// Solves the light of a frame with the sky that sky_bins() holds and uploads it. Does nothing
    /// when all that decides it is as it was. lights: of the loaded scene.
    void relight(const Frame& frame, const Sun& sun, const Light* scene_sun,
                 const std::vector<Light>& lights);
    /// Of the last relight, a patch each: what it sends out to sharp mirrors, and to rough ones, which see what
    /// glows as a light. Empty before the first.
    const std::vector<glm::vec3>& radiosity() const { return radiosity_; }
    const std::vector<glm::vec3>& rough_radiosity() const { return rough_radiosity_; }
    /// Of the last relight: radiance of the ground at the rim of the scene, which the land beyond goes on from;
    /// none where the scene's ground does not reach its rim all around, as a street's behind its houses.
    const std::optional<glm::vec3>& rim() const { return rim_radiance_; }
    const PatchScene* scene() const { return scene_.get(); }
    std::uint64_t loads() const { return loads_; }  ///< grows with each load()
    /// Changes with the light; empty before the first relight.
    const std::string& lit_by() const { return lit_by_; }
    /// Milliseconds of the last relight; 0 when nothing had changed.
    double relight_ms() const { return relight_ms_; }
    /// The same of CPU time, of the whole process.
    double relight_cpu_ms() const { return relight_cpu_ms_; }

    const shared::PatchGrid& grid() const { return grid_; }
    GpuBuffer& table() const { return *table_; }
    GpuBuffer& ways() const { return *ways_; }
    GpuBuffer& planes() const { return *planes_; }
    GpuBuffer& irradiance() const { return *irradiance_; }
    GpuBuffer& gradient() const { return *gradient_; }
    GpuBuffer& near() const { return *near_; }
    GpuBuffer& sky_bins() const { return *sky_bins_; }

private:
    void make_buffers(std::size_t nodes, std::size_t slots, std::size_t ways, std::size_t near);

    const Device* device_;
    std::unique_ptr<MemoryArena> arena_;
    std::unique_ptr<GpuBuffer> table_, ways_, planes_, irradiance_, gradient_, near_, sky_bins_;
    std::shared_ptr<const PatchScene> scene_;
    scene::StandingLinks standing_;  ///< of its patches
    shared::PatchGrid grid_{};
    std::uint64_t loads_ = 0;
    std::vector<glm::vec3> radiosity_, rough_radiosity_;
    std::vector<std::uint32_t> rim_;  // patches of it; none where it does not close
    std::optional<glm::vec3> rim_radiance_;
    std::string lit_by_;  // fingerprint of what the light was solved from
    double relight_ms_ = 0.0, relight_cpu_ms_ = 0.0;
};

// Mean radiance of the sky's bins, for the host.
//
//   reads    cube
//   writes   sky_bins
void add_sky_bins(FrameGraph& graph, SkyMaps& sky, PatchLights& lights);

}  // namespace petrichor::gpu

#endif
