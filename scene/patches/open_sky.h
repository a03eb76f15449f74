#ifndef PETRICHOR_SCENE_PATCHES_OPEN_SKY_H
#define PETRICHOR_SCENE_PATCHES_OPEN_SKY_H

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/patches/patches.h"

namespace petrichor::scene {

/// Light of a part of the sky above the horizon: that of one bit of Patches::visible.
struct SkyTexel {
    glm::vec3 light{0.0f};  ///< pi x mean radiance
    glm::vec3 way{0.0f};    ///< mean of the directions it comes from, weighted by luminance; at most 1 long
};

/// By the bins of the whole sky (Relight::sky), where nothing finer is known. shared::kVisibilityTexels.
std::vector<SkyTexel> sky_texels(std::span<const glm::vec3> sky);

/// What patches get of the sky above the horizon, by all that each sees of it. Rays of a row meet a glow at the horizon
/// too seldom: of them only the share that leaves upwards is taken, of this the mean light of that share, so that rows
/// still add up to 1 and a patch in the open has the light of the open sky to rounding.
class OpenSky {
public:
    struct Mean {
        glm::vec4 light{0.0f};   ///< irradiance, were all of the hemisphere so; w: its luminance
        glm::vec3 moment{0.0f};  ///< luminance times the direction it comes from, world
        bool known = false;      ///< false: no direction of the patch is seen to leave the scene
    };

    /// What no light changes: which visibility bits lie in front of the patch, and their solid angle times cosine.
    struct Front {
        std::array<std::uint32_t, 8> bits{};
        float all = 0.0f;
    };
    static Front front_of(const Patches& patches, std::uint32_t patch);

    /// texels: shared::kVisibilityTexels.
    explicit OpenSky(std::span<const SkyTexel> texels);
    /// normal: of the patch.
    Mean seen_by(const Front& front, glm::vec3 normal) const;

private:
    using Four = float __attribute__((vector_size(16)));
    static constexpr std::size_t kFours = 64;
    enum Row { WayX, WayY, WayZ, Red, Green, Blue, XX, XY, XZ, YY, YZ, ZZ, kRows };
    std::array<std::array<Four, kRows>, kFours> fours_;  // of texels that follow each other
};

}  // namespace petrichor::scene

#endif
