#include "gpu/frame/depth_view.h"

#include <algorithm>
#include <cmath>

namespace petrichor::gpu {

DepthView orthographic_view(const glm::vec3& direction, const glm::vec3& centre_m, float radius_m,
                            const Bounds& scene, int size)
{
    const glm::vec3 forward = glm::normalize(direction);
    const glm::vec3 helper =
        std::abs(forward.y) < 0.99f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(0.0f, 0.0f, 1.0f);
    const glm::vec3 right = glm::normalize(glm::cross(forward, helper));
    const glm::vec3 up = glm::cross(right, forward);

    DepthView view;
    view.texel_m = 2.0f * radius_m / static_cast<float>(size);
    const auto snap = [&view](float x) { return std::floor(x / view.texel_m) * view.texel_m; };
    const float x = snap(glm::dot(centre_m, right));
    const float y = snap(glm::dot(centre_m, up));
    // Depth over the whole scene, so that nothing outside the window loses its shadow.
    float nearest = 1e30f;
    float farthest = -1e30f;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1) ? scene.high.x : scene.low.x,
                          (corner & 2) ? scene.high.y : scene.low.y,
                          (corner & 4) ? scene.high.z : scene.low.z);
        const float along = glm::dot(p, forward);
        nearest = std::min(nearest, along);
        farthest = std::max(farthest, along);
    }
    const float margin = 0.01f * (farthest - nearest) + 0.01f;
    nearest -= margin;
    farthest += margin;

    // clip.z = (farthest - along) / (farthest - nearest): 1 near, 0 far; y points down the map.
    const float range = farthest - nearest;
    glm::mat4 m(0.0f);
    for (int c = 0; c < 3; ++c) {
        m[c][0] = right[c] / radius_m;
        m[c][1] = -up[c] / radius_m;
        m[c][2] = -forward[c] / range;
    }
    m[3] = glm::vec4(-x / radius_m, y / radius_m, farthest / range, 1.0f);
    view.clip_from_world = m;
    glm::mat4 to_map(1.0f);
    to_map[0][0] = 0.5f;
    to_map[1][1] = 0.5f;
    to_map[3] = glm::vec4(0.5f, 0.5f, 0.0f, 1.0f);
    view.map_from_world = to_map * m;
    return view;
}

}  // namespace petrichor::gpu
