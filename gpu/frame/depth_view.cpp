#include "gpu/frame/depth_view.h"

#include <algorithm>
#include <cmath>
#include <vector>

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

AskedPart asked_part(const DepthView& view, std::span<const glm::vec3> corners, float margin_m)
{
    // Texels that a look-up reads around its own, and how far depths are led along a plane that is seen edge on.
    constexpr float kAround = 8.0f, kAlong = 64.0f;
    const auto per_m = [&](int row) {
        return glm::length(glm::vec3(view.clip_from_world[0][row], view.clip_from_world[1][row],
                                     view.clip_from_world[2][row]));
    };
    const float margin = per_m(0) * (margin_m + kAround * view.texel_m);
    AskedPart part;
    part.least_z = 1.0e30f;
    std::vector<glm::dvec2> points;
    for (const glm::vec3& corner : corners) {
        const glm::vec4 clip = view.clip_from_world * glm::vec4(corner, 1.0f);
        points.emplace_back(clip.x, clip.y);
        part.least_z = std::min(part.least_z, clip.z);
    }
    part.least_z -= per_m(2) * (margin_m + kAlong * view.texel_m);
    // Their hull, counter-clockwise (Andrew 1979).
    const auto before = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
    std::sort(points.begin(), points.end(), before);
    const auto turn = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    };
    std::vector<glm::dvec2> hull;
    for (int half = 0; half < 2; ++half) {
        const std::size_t first = hull.size();
        for (const glm::dvec2& point : points) {
            while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0.0) hull.pop_back();
            hull.push_back(point);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    for (std::size_t i = 0; i < hull.size() && part.count < static_cast<int>(part.lines.size()); ++i) {
        const glm::dvec2 from = hull[i], along = hull[(i + 1) % hull.size()] - from;
        const double length = glm::length(along);
        if (!(length > 0.0)) continue;
        const glm::dvec2 in(-along.y / length, along.x / length);
        part.lines[static_cast<std::size_t>(part.count++)] =
            glm::vec3(glm::dvec3(in, static_cast<double>(margin) - glm::dot(in, from)));
    }
    return part;
}

}  // namespace petrichor::gpu
