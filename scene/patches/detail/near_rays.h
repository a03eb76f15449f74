// Rays from polygons that are close to patches.
#ifndef PETRICHOR_SCENE_PATCHES_DETAIL_NEAR_RAYS_H
#define PETRICHOR_SCENE_PATCHES_DETAIL_NEAR_RAYS_H

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "scene/patches/patches.h"

namespace petrichor::scene {

inline constexpr float kGlowNear_m = 1.0f;  // so near a polygon what glows is met by its own rays

struct NearMeets {
    std::uint32_t id;  ///< as Patches::links; black inside
    std::uint32_t triangle = RayHit::kNothing;
    float distance_m = 0.0f;
    glm::vec3 from{0.0f};  ///< point of the polygon
    bool inside = false;   ///< it starts inside a body, whatever is drawn
    int draws = 1;         ///< all but the last one inside a body
};
/// What rays 0, every, 2 every .. of a polygon's `rays` meet, as many as `met` holds.
void near_meets(const Patches& patches, const Tracer& tracer, const std::array<glm::vec3, 4>& corners, int every,
                int rays, std::uint64_t hash, std::span<NearMeets> met);

/// Luminance of what a material sends out by itself, its texture apart.
float glow_of(const Triangles& triangles, std::uint32_t triangle);

}  // namespace petrichor::scene

#endif
