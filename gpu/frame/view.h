#ifndef PETRICHOR_GPU_FRAME_VIEW_H
#define PETRICHOR_GPU_FRAME_VIEW_H

#include <array>

#include "gpu/frame/depth_view.h"

namespace petrichor::gpu {

/// Where sample `index` of `count` lies inside its pixel, -0.5..0.5. Sample 0 is the centre.
glm::vec2 sample_offset(std::uint32_t index, std::uint32_t seed);

/// Where sample `index` of `count` looks through a lens of radius 1: spread evenly; 0 is its middle.
glm::vec2 lens_offset(std::uint32_t index, int count, std::uint32_t seed);

/// A point of a lamp's surface, from its middle: as it is seen from afar, evenly over what shows; sample 0
/// is the middle.
glm::vec3 lamp_offset_m(const Light& lamp, std::uint32_t index, int count, std::uint32_t seed);

/// Camera part of the constants: matrices and pixel rays, for pixels moved by `jitter`.
void set_camera(shared::FrameConstants& constants, const Camera& camera, int width, int height,
                const glm::vec2& jitter, const Bounds& scene, const glm::vec2& lens_m = glm::vec2(0.0f),
                float focus_m = 1.0f);

/// Ends of the shadow cascades along the view axis, metres.
glm::vec3 cascade_ends_m(const Camera& camera, const Bounds& scene);

/// The last cascade is the one that holds the whole view where one is enough.
inline constexpr std::size_t kCoarseCascade = SHADOW_CASCADES - 1;
/// Views of which that one alone counts.
std::array<DepthView, SHADOW_CASCADES> coarse_views(const Camera& camera, float aspect,
                                                    const glm::vec3& to_sun, const Bounds& scene);

/// The cascades' views from the sun. `to_sun` is a unit vector.
std::array<DepthView, SHADOW_CASCADES> cascade_views(const Camera& camera, float aspect,
                                                     const glm::vec3& to_sun, const Bounds& scene);

/// Direction `index` of SKY_DIRECTIONS towards the sky, spread by the cosine with the vertical.
glm::vec3 sky_direction(int index);

/// The views from all over the sky, around the camera.
std::array<DepthView, SKY_DIRECTIONS> sky_views(const Camera& camera, const Bounds& scene);

/// The view along what falls with a velocity, around the camera; at most 31 degrees from the
/// vertical.
DepthView rain_view(const Camera& camera, const glm::vec3& fall_m_s, const Bounds& scene);

}  // namespace petrichor::gpu

#endif
