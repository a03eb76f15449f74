#include "scene/light_lines.h"

#include <algorithm>
#include <cmath>

#include "scene/light_shape.h"

namespace petrichor::scene {
namespace {

using Lines = std::vector<std::vector<glm::vec3>>;

std::vector<glm::vec3> circle(const glm::vec3& middle, const glm::vec3& x, const glm::vec3& y)
{
    constexpr int kSides = 32;
    std::vector<glm::vec3> points;
    for (int i = 0; i <= kSides; ++i) {
        const float turn = 6.2831853f * static_cast<float>(i % kSides) / kSides;
        points.push_back(middle + x * std::cos(turn) + y * std::sin(turn));
    }
    return points;
}

// Three axes square to each other: across, up, the way it shines.
struct Axes {
    glm::vec3 x, y, z;
};

void add_cone(const Light& light, const Axes& a, float size_m, Lines& lines)
{
    // No wider than it is long, however it opens.
    const float angle = std::min(light.outer_cone_rad, 1.4f);
    const float slant = light.range_m > 0.0f ? std::min(light.range_m, 4.0f * size_m) : 4.0f * size_m;
    const float radius = slant * std::sin(angle);
    const glm::vec3 end = light.position_m + a.z * (slant * std::cos(angle));
    lines.push_back(circle(end, a.x * radius, a.y * radius));
    for (const glm::vec3& side : {a.x, a.y, -a.x, -a.y}) lines.push_back({light.position_m, end + side * radius});
}

}  // namespace

std::vector<std::vector<glm::vec3>> light_lines(const Light& light, float size_m)
{
    if (light.kind == LightKind::Directional) return {};
    const glm::vec3 p = light.position_m;
    const glm::vec3 up = up_of(light);
    const Axes a{glm::cross(light.direction, up), up, light.direction};
    const float r = light.radius_m;
    Lines lines;
    if (light.kind == LightKind::Rectangle) {
        const glm::vec3 u = light.half_u_m, v = light.half_v_m;
        lines.push_back({p - u - v, p + u - v, p + u + v, p - u + v, p - u - v});
        lines.push_back({p, p + a.z * size_m});
        if (light.both_sides) lines.push_back({p, p - a.z * size_m});
    } else if (light.kind == LightKind::Spot) {
        if (r > 0.0f) lines.push_back(circle(p, a.x * r, a.y * r));
        add_cone(light, a, size_m, lines);
    } else if (r > 0.0f && light.length_m > 0.0f) {
        const glm::vec3 half = a.y * (0.5f * light.length_m);
        lines.push_back(circle(p - half, a.x * r, a.z * r));
        lines.push_back(circle(p + half, a.x * r, a.z * r));
        for (const glm::vec3& side : {a.x, a.z, -a.x, -a.z}) lines.push_back({p - half + side * r, p + half + side * r});
    } else if (r > 0.0f) {
        lines = {circle(p, a.x * r, a.y * r), circle(p, a.y * r, a.z * r), circle(p, a.z * r, a.x * r)};
    } else {
        for (const glm::vec3& arm : {a.x, a.y, a.z}) lines.push_back({p - arm * (0.5f * size_m), p + arm * (0.5f * size_m)});
    }
    return lines;
}

}  // namespace petrichor::scene
