#include <algorithm>
#include <cmath>

#include "formulas/weather/surface_weather.h"
#include "scene/snow/snow_caps.h"

namespace petrichor::scene {
namespace {

using glm::vec3;

constexpr float kSunk_m = 0.012f;       // of a cap without snow, below its surface
constexpr float kOverhang = 0.22f;      // of the depth
constexpr float kMostOverhang_m = 0.05f;
constexpr float kMostOverWidth = 0.7f;  // height of what stays on a post, over its half width
constexpr float kClosed = 1.2f;         // depth over the width of a slot, from which on snow closes it

// Height over that of open ground at a share of the way from the edge (Fearing 2000 has edges round
// off; the quarter ellipse is ours).
float rounded(float s)
{
    if (s >= 1.0f) return 1.0f;
    const float left = 1.0f - std::max(s, 0.0f);
    return std::sqrt(std::max(1.0f - left * left, 0.0f));
}

// The lesser of two depths, rounded where they meet.
float lesser(float a, float b)
{
    if (!(a > 0.0f) || !(b > 0.0f)) return 0.0f;
    const float r = std::min(a, b) / std::max(a, b);
    return std::min(a, b) / std::sqrt(1.0f + r * r);
}

}  // namespace

float drawn_snow_m(float depth_m)
{
    if (!(depth_m > 0.0f)) return 0.0f;
    constexpr float kAsIs_m = 0.2f;
    if (depth_m <= kAsIs_m) return depth_m;
    const float room = kDeepestSnow_m - kAsIs_m;
    return kAsIs_m + room * (1.0f - std::exp(-(depth_m - kAsIs_m) / room));
}

SnowShape snow_shape(const SnowCaps& caps, std::span<const float> depth_m)
{
    SnowShape shape;
    const std::size_t count = caps.points.size();
    shape.positions.reserve(count);
    shape.thickness_m.reserve(count);
    shape.deep_m.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const SnowCaps::Point& p = caps.points[i];
        const float deep = lesser(
            std::min(drawn_snow_m(depth_m[i]) * p.share * p.uneven, kMostOverWidth * p.support_m), p.most_m);
        const float width = std::max(std::min(deep, 0.95f * p.support_m), 1.0e-4f);
        const float s = p.edge_m / width;
        const float slot = std::clamp(2.0f * deep / (kClosed * p.gap_m) - 1.0f, 0.0f, 1.0f);
        const float round = rounded(s);
        const float thickness = deep * (round + slot * (1.0f - round));
        const float sunk = kSunk_m * std::exp(-thickness / 0.02f);
        vec3 at = p.base_m;
        at.y += thickness - sunk + p.fill_m * shared::smooth_edge(0.01f, 0.06f, thickness);
        const float bridged = p.gap_m < 1.0f ? slot : std::min(thickness / 0.03f, 1.0f);
        at.x += p.bridge_m.x * bridged;
        at.z += p.bridge_m.y * bridged;
        if (s < 1.0f && deep > 0.0f) {
            const float bulge = 3.5f * std::sqrt(s) * (1.0f - s) * (1.0f - s);
            const float out = std::min(kOverhang * deep, kMostOverhang_m) * bulge * (1.0f - slot);
            at.x += p.out.x * out;
            at.z += p.out.y * out;
        }
        shape.positions.push_back(at);
        shape.thickness_m.push_back(thickness);
        shape.deep_m.push_back(deep);
        shape.thickest_m = std::max(shape.thickest_m, thickness);
    }
    shape.normals.assign(count, vec3(0.0f));
    for (std::size_t k = 0; k + 2 < caps.indices.size(); k += 3) {
        const std::uint32_t a = caps.corner_points[caps.indices[k]];
        const std::uint32_t b = caps.corner_points[caps.indices[k + 1]];
        const std::uint32_t c = caps.corner_points[caps.indices[k + 2]];
        const vec3 face = glm::cross(shape.positions[b] - shape.positions[a],
                                     shape.positions[c] - shape.positions[a]);
        shape.normals[a] += face;
        shape.normals[b] += face;
        shape.normals[c] += face;
    }
    for (vec3& n : shape.normals) {
        const float length = glm::length(n);
        n = length > 1.0e-12f ? n / length : vec3(0.0f, 1.0f, 0.0f);
    }
    return shape;
}

}  // namespace petrichor::scene
