#ifndef PETRICHOR_GPU_SNOW_PATCH_DEPTHS_H
#define PETRICHOR_GPU_SNOW_PATCH_DEPTHS_H

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "gpu/frame/frame.h"

namespace petrichor::gpu {

/// A place nearby, as far as most of a patch away: snow ends along no straight line, though patches do. It maps the plane to itself
/// and keeps areas to rounding, so no snow is lost or made. Ours, by eye.
/// x_z: in widths of a patch on the ground.
glm::vec2 snow_wanders(glm::vec2 x_z);

/// How deep snow is at places on the ground, from patches that are squares of one depth each: by the cubic spline over
/// the squares around and smoothly between layers of them, so that neither the depth nor its slope knows where they end. Places look
/// for them where snow_wanders() leads.
class PatchDepths {
public:
    /// At each of the places (world, m), what of the snow of its patches lies there; nothing is known of the others before find().
    /// faces: at each, the normal of what lies there, as long as that is wide; none: it faces up. A steep roof has patches of the side
    /// that it looks to, and a patch is as steep as what lies on it in the mean.
    void find(std::shared_ptr<const PlaceShape> shape, const std::vector<glm::vec3>& places_m, const std::vector<glm::vec3>& faces = {});
    const std::shared_ptr<const PlaceShape>& shape() const { return shape_; }

    /// Of each place, upright: as snow on a slope is measured it is thinner. open_m where no patch lies.
    std::vector<float> depths_m(const PlaceWeather& weather, float open_m) const;
    /// Of each place, what of the fall the slope of its patches holds, which is in their depths: 1 on level ground and where there are none.
    const std::vector<float>& held() const { return held_; }

private:
    static constexpr int kSide = 4;
    static constexpr std::uint32_t kNowhere = 0xffffffffu;
    /// The patches of four by four cells of one height, by rows; kNoPatch where there is none.
    using Window = std::array<std::uint32_t, kSide * kSide>;
    struct Place {
        std::array<std::uint32_t, 2> windows{kNowhere, kNowhere};  ///< of the layers below and above
        glm::vec2 within{0.0f};  ///< 0..1 between the middles of the inner cells
        float above = 0.0f;      ///< share of the layer above
        float there = 0.0f;      ///< what its patches weigh
    };

    std::shared_ptr<const PlaceShape> shape_;
    std::vector<Window> windows_;
    std::vector<Place> places_;
    std::vector<float> held_;
    std::vector<float> up_;  ///< y of the normal of each patch

    /// For each place the mean over its patches; otherwise where it has none.
    template <class OfPatch>
    std::vector<float> means(float otherwise, const OfPatch& of_patch) const;
};

}  // namespace petrichor::gpu

#endif
