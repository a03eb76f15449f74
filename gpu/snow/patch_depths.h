#ifndef PETRICHOR_GPU_SNOW_PATCH_DEPTHS_H
#define PETRICHOR_GPU_SNOW_PATCH_DEPTHS_H

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "gpu/frame/frame.h"

namespace petrichor::gpu {

/// How deep snow is at places on the ground, from patches that are squares of one depth each: by the cubic spline over
/// the squares around and smoothly between layers of them, so that neither the depth nor its slope knows where they end.
class PatchDepths {
public:
    /// At each of the places (world, m), what of the snow of its patches lies there; nothing is known of the others before find().
    /// normals: of what lies there, unit; none: it faces up. A steep roof has patches of the side that it looks to.
    void find(std::shared_ptr<const PlaceShape> shape, const std::vector<glm::vec3>& places_m, const std::vector<glm::vec3>& normals = {});
    const std::shared_ptr<const PlaceShape>& shape() const { return shape_; }

    /// Of each place; open_m where no patch lies.
    std::vector<float> depths_m(const PlaceWeather& weather, float open_m) const;

private:
    static constexpr int kSide = 4;
    static constexpr std::uint32_t kNowhere = 0xffffffffu;
    /// The patches of four by four cells of one height, by rows; kNoPatch where there is none.
    using Window = std::array<std::uint32_t, kSide * kSide>;
    struct Place {
        std::array<std::uint32_t, 2> windows{kNowhere, kNowhere};  ///< of the layers below and above
        glm::vec2 within{0.0f};  ///< 0..1 between the middles of the inner cells
        float above = 0.0f;      ///< share of the layer above
    };

    std::shared_ptr<const PlaceShape> shape_;
    std::vector<Window> windows_;
    std::vector<Place> places_;
};

}  // namespace petrichor::gpu

#endif
