#include "scene/patches/detail/near_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace petrichor::scene {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
constexpr std::uint32_t kTried = 2;  // triangles after one in the mesh

float length_of(glm::vec3 v)
{
    return std::sqrt(glm::dot(v, v));
}

float corner_area_m2(const NearPolygon& p, int k)
{
    const auto at = [&](int i) { return p.corner[static_cast<std::size_t>((i + p.count) % p.count)]; };
    return 0.5f * length_of(glm::cross(at(k) - at(k - 1), at(k + 1) - at(k)));
}

std::array<glm::vec3, 3> corners_of(const Triangles& triangles, std::uint32_t t)
{
    const glm::vec3 a = triangles.corner(t);
    return {a, a + triangles.edge1(t), a + triangles.edge2(t)};
}

// Two triangles along a common edge as a quad; false when they are none.
bool joined(const Triangles& triangles, std::uint32_t s, std::uint32_t t, NearFace& face)
{
    const glm::vec3 n = triangles.normal(s);
    if (triangles.material(s) != triangles.material(t) || triangles.flags(s) != triangles.flags(t) ||
        !(glm::dot(n, triangles.normal(t)) > 0.99999f))
        return false;
    const auto a = corners_of(triangles, s), b = corners_of(triangles, t);
    float size = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        size = std::max({size, length_of(a[(i + 1) % 3] - a[i]), length_of(b[(i + 1) % 3] - b[i]),
                         0.01f * std::abs(a[0][k])});
    }
    // Corners are sums of floats: the same to rounding.
    const float same = 1e-4f * size;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            if (length_of(a[i] - b[(j + 1) % 3]) > same || length_of(a[(i + 1) % 3] - b[j]) > same) continue;
            const std::array<glm::vec3, 4> quad{a[(i + 1) % 3], a[(i + 2) % 3], a[i], b[(j + 2) % 3]};
            for (std::size_t k = 0; k < 4; ++k) {
                const glm::vec3 in = quad[k] - quad[(k + 3) % 4], out = quad[(k + 1) % 4] - quad[k];
                if (glm::dot(glm::cross(in, out), n) < -1e-3f * length_of(in) * length_of(out)) return false;
            }
            if (std::abs(glm::dot(quad[3] - quad[0], n)) > same) return false;
            face.triangles = {s, t};
            face.polygon.count = 4;
            std::copy(quad.begin(), quad.end(), face.polygon.corner.begin());
            face.normal = n;
            return true;
        }
    }
    return false;
}

}  // namespace

NearPolygon cut_above(const NearPolygon& polygon, glm::vec3 n, float least)
{
    NearPolygon cut;
    for (int k = 0; k < polygon.count; ++k) {
        const glm::vec3 a = polygon.corner[static_cast<std::size_t>(k)];
        const glm::vec3 b = polygon.corner[static_cast<std::size_t>((k + 1) % polygon.count)];
        const float da = glm::dot(n, a) - least, db = glm::dot(n, b) - least;
        if (da >= 0.0f && cut.count < 12) cut.corner[static_cast<std::size_t>(cut.count++)] = a;
        if ((da < 0.0f) != (db < 0.0f) && cut.count < 12)
            cut.corner[static_cast<std::size_t>(cut.count++)] = a + (b - a) * (da / (da - db));
    }
    return cut;
}

NearPolygon cut_to(const NearPolygon& polygon, glm::vec3 low, glm::vec3 high)
{
    NearPolygon cut = polygon;
    for (int k = 0; k < 3 && cut.count >= 3; ++k) {
        glm::vec3 axis(0.0f);
        axis[k] = 1.0f;
        float least = std::numeric_limits<float>::max(), most = std::numeric_limits<float>::lowest();
        for (int c = 0; c < cut.count; ++c) {
            least = std::min(least, cut.corner[static_cast<std::size_t>(c)][k]);
            most = std::max(most, cut.corner[static_cast<std::size_t>(c)][k]);
        }
        // Most faces lie within.
        if (least < low[k]) cut = cut_above(cut, axis, low[k]);
        if (most > high[k]) cut = cut_above(cut, -axis, -high[k]);
    }
    return cut;
}

void simplify(NearPolygon& p)
{
    while (p.count > 4) {
        int least = 0;
        for (int k = 1; k < p.count; ++k)
            if (corner_area_m2(p, k) < corner_area_m2(p, least)) least = k;
        for (int k = least; k + 1 < p.count; ++k)
            p.corner[static_cast<std::size_t>(k)] = p.corner[static_cast<std::size_t>(k + 1)];
        --p.count;
    }
}

float area_m2(const NearPolygon& p)
{
    glm::vec3 sum(0.0f);
    for (int k = 2; k < p.count; ++k)
        sum += glm::cross(p.corner[static_cast<std::size_t>(k - 1)] - p.corner[0],
                          p.corner[static_cast<std::size_t>(k)] - p.corner[0]);
    return 0.5f * length_of(sum);
}

bool holds(const NearPolygon& p, glm::vec3 n, glm::vec3 x, float margin_m)
{
    if (p.count < 3 || std::abs(glm::dot(x - p.corner[0], n)) > margin_m) return false;
    for (int k = 0; k < p.count; ++k) {
        const glm::vec3 a = p.corner[static_cast<std::size_t>(k)];
        const glm::vec3 edge = p.corner[static_cast<std::size_t>((k + 1) % p.count)] - a;
        const float inside = glm::dot(glm::cross(edge, x - a), n);
        if (inside < 0.0f && inside * inside > margin_m * margin_m * glm::dot(edge, edge)) return false;
    }
    return true;
}

glm::vec3 nearest_in(const NearPolygon& p, glm::vec3 n, glm::vec3 x)
{
    const glm::vec3 foot = x - n * glm::dot(x - p.corner[0], n);
    if (holds(p, n, foot, 1e-6f)) return foot;
    glm::vec3 best = p.corner[0];
    float least2 = std::numeric_limits<float>::max();
    for (int k = 0; k < p.count; ++k) {
        const glm::vec3 a = p.corner[static_cast<std::size_t>(k)];
        const glm::vec3 edge = p.corner[static_cast<std::size_t>((k + 1) % p.count)] - a;
        const float length2 = glm::dot(edge, edge);
        const float along = length2 > 0.0f ? std::clamp(glm::dot(x - a, edge) / length2, 0.0f, 1.0f) : 0.0f;
        const glm::vec3 there = a + edge * along, way = x - there;
        const float far2 = glm::dot(way, way);
        if (far2 >= least2) continue;
        least2 = far2;
        best = there;
    }
    return best;
}

float distance_m(const NearPolygon& p, glm::vec3 n, glm::vec3 x)
{
    return length_of(x - nearest_in(p, n, x));
}

std::array<glm::vec3, 4> corners_of(const NearPolygon& polygon)
{
    std::array<glm::vec3, 4> corners;
    for (int k = 0; k < 4; ++k)
        corners[static_cast<std::size_t>(k)] =
            polygon.corner[static_cast<std::size_t>(std::min(k, polygon.count - 1))];
    return corners;
}

NearPolygon polygon_of(const std::array<glm::vec3, 4>& c)
{
    NearPolygon polygon;
    polygon.count = 4;
    std::copy(c.begin(), c.end(), polygon.corner.begin());
    return polygon;
}

glm::vec3 front_of(const std::array<glm::vec3, 4>& c)
{
    const glm::vec3 n = glm::cross(c[1] - c[0], c[2] - c[0]) + glm::cross(c[2] - c[0], c[3] - c[0]);
    const float length = std::sqrt(glm::dot(n, n));
    return length > 0.0f ? n / length : glm::vec3(0.0f, 1.0f, 0.0f);
}

glm::vec3 point_in(const std::array<glm::vec3, 4>& c, float u, float v)
{
    const glm::vec3 low = c[0] + (c[1] - c[0]) * u, high = c[3] + (c[2] - c[3]) * u;
    return low + (high - low) * v;
}

glm::vec3 lamp_point(const std::array<glm::vec3, 4>& c, std::size_t k)
{
    return point_in(c, k % 2 == 0 ? 0.25f : 0.75f, k / 2 == 0 ? 0.25f : 0.75f);
}

NearFaces near_faces(const Triangles& triangles)
{
    NearFaces made;
    made.of_triangle.assign(triangles.size(), kNone);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        if (made.of_triangle[t] != kNone) continue;
        const auto number = static_cast<std::uint32_t>(made.faces.size());
        NearFace face;
        bool two = false;
        for (std::uint32_t other = t + 1; !two && other < std::min(t + 1 + kTried, triangles.size()); ++other) {
            two = made.of_triangle[other] == kNone && joined(triangles, t, other, face);
            if (two) made.of_triangle[other] = number;
        }
        if (!two) {
            const auto c = corners_of(triangles, t);
            face.triangles = {t, t};
            face.polygon.count = 3;
            std::copy(c.begin(), c.end(), face.polygon.corner.begin());
            face.normal = triangles.normal(t);
        }
        made.of_triangle[t] = number;
        made.faces.push_back(face);
    }
    return made;
}

PatchSample place_on(const Triangles& triangles, const NearFace& face, bool back, glm::vec3 x)
{
    PatchSample best;
    float least = -std::numeric_limits<float>::max();
    for (const std::uint32_t t : face.triangles) {
        const glm::vec3 e1 = triangles.edge1(t), e2 = triangles.edge2(t), d = x - triangles.corner(t);
        const glm::vec3 n = glm::cross(e1, e2);
        const float over = 1.0f / glm::dot(n, n);
        const float b1 = glm::dot(glm::cross(d, e2), n) * over, b2 = glm::dot(glm::cross(e1, d), n) * over;
        const float inside = std::min({b1, b2, 1.0f - b1 - b2});
        if (inside <= least) continue;
        least = inside;
        const float c1 = std::clamp(b1, 0.0f, 1.0f);
        best = {t, {c1, std::clamp(b2, 0.0f, 1.0f - c1)}, back};
    }
    return best;
}

}  // namespace petrichor::scene
