// Light of a polygon at four points at a time: lane by lane the bits of what one point gets.
#ifndef PETRICHOR_SCENE_PATCHES_DETAIL_NEAR_FOUR_H
#define PETRICHOR_SCENE_PATCHES_DETAIL_NEAR_FOUR_H

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/patches/detail/four.h"
#include "scene/patches/detail/near_faces.h"
#include "scene/patches/patches.h"

namespace petrichor::scene {

/// Points of surfaces, four beside each other; the last one fills the last four up.
struct FourPoints {
    std::vector<Four3> position_m, normal;
    explicit FourPoints(std::span<const SamplePoint> points = {});
};

/// shared::near_form_factor at four points. Corners as they are, not relative to the points.
Four near_form_factors(const std::array<glm::vec3, 4>& corners, const Four3& position_m, const Four3& normal);
/// nearest_in of four points.
Four3 nearest_in(const NearPolygon& polygon, glm::vec3 n, const Four3& x);

}  // namespace petrichor::scene

#endif
