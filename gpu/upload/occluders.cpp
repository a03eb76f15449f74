#include "gpu/upload/occluders.h"

#include <algorithm>
#include <cmath>

namespace petrichor::gpu {

namespace {

constexpr std::size_t kMostOfADraw = 256;
constexpr float kAround = 0.5f;      // texels: rasterizers round to 1/256 of one
constexpr float kBehind = 1.0e-4f;   // of the map's depth: what hides is so much nearer
constexpr int kMostCells = 4096;     // that are asked for a box

}  // namespace

std::vector<LargeTriangle> large_triangles(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                                           std::uint32_t first_vertex)
{
    std::vector<LargeTriangle> all;
    for (std::size_t k = 0; k + 2 < indices.size(); k += 3) {
        const glm::vec3& a = positions[indices[k] - first_vertex];
        const glm::vec3 ab = positions[indices[k + 1] - first_vertex] - a, ac = positions[indices[k + 2] - first_vertex] - a;
        const float area = 0.5f * glm::length(glm::cross(ab, ac));
        if (std::isfinite(area)) all.push_back({static_cast<std::uint32_t>(k / 3), area});
    }
    const auto larger = [](const LargeTriangle& a, const LargeTriangle& b) {
        return a.area != b.area ? a.area > b.area : a.number < b.number;
    };
    const std::size_t kept = std::min(all.size(), kMostOfADraw);
    std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(kept), all.end(), larger);
    all.resize(kept);
    all.shrink_to_fit();
    return all;
}

Occluders::Occluders(const glm::mat4& clip_from_world, float texels, float rounding)
    : clip_from_world_(clip_from_world), texels_(texels), rounding_(rounding + kAround)
{
    const glm::mat4& m = clip_from_world;
    texels_a_m_ = 0.5f * texels * std::max(glm::length(glm::vec3(m[0][0], m[1][0], m[2][0])),
                                           glm::length(glm::vec3(m[0][1], m[1][1], m[2][1])));
    cells_ = static_cast<int>(std::ceil(texels / kCell));
    nearest_.assign(static_cast<std::size_t>(cells_) * static_cast<std::size_t>(cells_), -1.0e30f);
}

// Less cannot cover a cell, however it stands.
float Occluders::least_area(const glm::mat4& to_world) const
{
    float wide = 0.0f;
    for (int k = 0; k < 3; ++k) wide = std::max(wide, glm::length(glm::vec3(to_world[k])));
    const float along = wide * texels_a_m_;
    return 2.0f * kCell * kCell / std::max(along * along, 1.0e-30f);
}

void Occluders::cover(const glm::vec3 (&clip)[3])
{
    glm::vec2 p[3];
    float z[3];
    for (int k = 0; k < 3; ++k) {
        p[k] = (glm::vec2(clip[k]) * 0.5f + 0.5f) * texels_;
        z[k] = std::min(clip[k].z, 1.0f);  // as maps draw what is nearer than they reach
        if (!(z[k] > 0.0f)) return;
    }
    const glm::vec2 ab = p[1] - p[0], ac = p[2] - p[0];
    const float area = ab.x * ac.y - ab.y * ac.x;
    if (!(std::abs(area) > 2.0f * kCell * kCell)) return;
    const float sign = area > 0.0f ? 1.0f : -1.0f;
    // Inside of each edge: x and y of its line and the rest, and how much less that is at the worst corner of a cell.
    const float reach = 0.5f * kCell + rounding_;
    glm::vec3 edge[3];
    for (int k = 0; k < 3; ++k) {
        const glm::vec2 from = p[k], way = p[(k + 1) % 3] - from;
        edge[k] = sign * glm::vec3(-way.y, way.x, way.y * from.x - way.x * from.y);
        edge[k].z -= reach * (std::abs(edge[k].x) + std::abs(edge[k].y));
    }
    const glm::vec2 slope = glm::vec2((z[1] - z[0]) * ac.y - (z[2] - z[0]) * ab.y, (z[2] - z[0]) * ab.x - (z[1] - z[0]) * ac.x) / area;
    const float least = std::min(z[0], std::min(z[1], z[2]));
    const glm::vec2 low = glm::min(p[0], glm::min(p[1], p[2])), high = glm::max(p[0], glm::max(p[1], p[2]));
    const auto cell = [&](float at) { return static_cast<int>(std::clamp(at / kCell, 0.0f, static_cast<float>(cells_))); };
    const int x0 = cell(low.x), x1 = std::min(cell(high.x), cells_ - 1), y0 = cell(low.y), y1 = std::min(cell(high.y), cells_ - 1);
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            const glm::vec2 middle = (glm::vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) * kCell;
            bool inside = true;
            for (const glm::vec3& e : edge) inside = inside && e.x * middle.x + e.y * middle.y + e.z > 0.0f;
            if (!inside) continue;
            const float here = z[0] + glm::dot(slope, middle - p[0]) - reach * (std::abs(slope.x) + std::abs(slope.y));
            float& nearest = nearest_[static_cast<std::size_t>(y * cells_ + x)];
            nearest = std::max(nearest, std::max(here, least));
        }
    }
}

bool Occluders::hide(const glm::mat4& clip_from_mesh, const glm::vec3& centre, const glm::vec3& half) const
{
    const glm::vec3 at(clip_from_mesh * glm::vec4(centre, 1.0f));
    const glm::mat3 m(clip_from_mesh);
    const glm::vec3 around = glm::abs(m[0]) * half.x + glm::abs(m[1]) * half.y + glm::abs(m[2]) * half.z;
    const float near = at.z + around.z + kBehind;
    const glm::vec2 low = (glm::vec2(at - around) * 0.5f + 0.5f) * texels_ - rounding_;
    const glm::vec2 high = (glm::vec2(at + around) * 0.5f + 0.5f) * texels_ + rounding_;
    if (!(near < 1.0f) || !(low.x < texels_ && low.y < texels_ && high.x > 0.0f && high.y > 0.0f)) return false;
    const auto cell = [&](float x) { return std::clamp(static_cast<int>(std::floor(x / kCell)), 0, cells_ - 1); };
    const int x0 = cell(low.x), x1 = cell(high.x), y0 = cell(low.y), y1 = cell(high.y);
    if ((x1 - x0 + 1) * (y1 - y0 + 1) > kMostCells) return false;
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x)
            if (!(nearest_[static_cast<std::size_t>(y * cells_ + x)] > near)) return false;
    return true;
}

}  // namespace petrichor::gpu
