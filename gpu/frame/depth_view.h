#ifndef PETRICHOR_GPU_FRAME_DEPTH_VIEW_H
#define PETRICHOR_GPU_FRAME_DEPTH_VIEW_H

#include <span>

#include "gpu/frame/frame_io.h"
#include "gpu/upload/asked_part.h"
#include "gpu/upload/scene_names.h"

namespace petrichor::gpu {

inline constexpr int kShadowMapSize = 2048;   ///< texels a side of a cascade
inline constexpr int kShelterMapSize = 2048;  ///< of the map along the falling rain
inline constexpr int kSkyMapSize = SKY_MAP_SIZE;      ///< of each direction of the sky

/// One view of the scene from far away: along the sun (a shadow cascade) or along the falling rain.
struct DepthView {
    glm::mat4 clip_from_world{1.0f};
    glm::mat4 map_from_world{1.0f};  ///< to (u, v, depth), each 0..1
    float texel_m = 0.0f;
    AskedPart asked;  ///< no part of what view it is

    bool operator==(const DepthView& other) const
    {
        return clip_from_world == other.clip_from_world;
    }
};

/// Orthographic view along `direction` that covers a sphere, with its window snapped to whole
/// texels; in depth it spans the whole scene.
DepthView orthographic_view(const glm::vec3& direction, const glm::vec3& centre_m, float radius_m,
                            const Bounds& scene, int size);

/// The part of an orthographic view in which points of the convex hull of `corners` ask it, and what is up to
/// `margin_m` beside them.
AskedPart asked_part(const DepthView& view, std::span<const glm::vec3> corners, float margin_m);

}  // namespace petrichor::gpu

#endif
