#ifndef PETRICHOR_SCENE_PATCHES_VISIBLE_WAY_H
#define PETRICHOR_SCENE_PATCHES_VISIBLE_WAY_H

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace petrichor::scene {

/// A direction as bits of Patches::visible know it, found once for all patches that are asked: four bits mixed.
class VisibleWay {
public:
    /// direction: unit, from the patch outwards.
    explicit VisibleWay(glm::vec3 direction);

    /// Share 0..1 of a patch that sees the sky there; 0 below the horizon.
    float share(const std::array<std::uint32_t, 8>& bits) const
    {
        float sum = 0.0f;
        for (std::size_t k = 0; k < 4; ++k)
            if ((bits[bit_[k] >> 5] >> (bit_[k] & 31u)) & 1u) sum += weight_[k];
        return sum;
    }

private:
    std::array<std::uint32_t, 4> bit_{};
    std::array<float, 4> weight_{};  // none below the horizon
};

}  // namespace petrichor::scene

#endif
