#include "gpu/upload/occluders.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace petrichor::gpu {

namespace {

constexpr std::size_t kMostOfADraw = 256;
constexpr float kAround = 0.5f;      // texels: rasterizers round to 1/256 of one
constexpr float kBehind = 1.0e-4f;   // of the map's depth: what hides is so much nearer
constexpr float kFlat = 1.0e-5f;     // how far a corner may lie off the plane of the others, of their size
constexpr int kMostCells = 4096;     // that are asked for a box

// The fourth corner of a flat, convex face that two triangles with a common side make, put in its place.
bool join(LargeFace& face, std::span<const glm::vec3> positions, std::uint32_t first_vertex, const std::uint32_t* other)
{
    const auto at = [&](std::uint32_t vertex) { return positions[vertex - first_vertex]; };
    const std::uint32_t* own = face.vertices;
    for (int side = 0; side < 3; ++side) {
        const std::uint32_t from = own[side], to = own[(side + 1) % 3];
        for (int k = 0; k < 3; ++k) {
            if (other[k] != to || other[(k + 1) % 3] != from) continue;
            const std::uint32_t opposite = own[(side + 2) % 3], beyond = other[(k + 2) % 3];
            const std::uint32_t around[4] = {from, beyond, to, opposite};
            const glm::vec3 normal = glm::cross(at(own[1]) - at(own[0]), at(own[2]) - at(own[0]));
            const float size = glm::length(normal);
            if (!(std::abs(glm::dot(normal, at(beyond) - at(from))) <= kFlat * size * std::sqrt(size))) return false;
            for (int c = 0; c < 4; ++c) {
                const glm::vec3 in = at(around[(c + 1) % 4]) - at(around[c]), out = at(around[(c + 2) % 4]) - at(around[(c + 1) % 4]);
                if (!(glm::dot(glm::cross(in, out), normal) > 0.0f)) return false;
            }
            face.corners = 4;
            std::copy(std::begin(around), std::end(around), face.vertices);
            return true;
        }
    }
    return false;
}

}  // namespace

std::vector<LargeFace> large_faces(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                                   std::uint32_t first_vertex)
{
    std::vector<LargeFace> all;
    const auto area_of = [&](std::size_t k) {
        const glm::vec3& a = positions[indices[k] - first_vertex];
        const glm::vec3 ab = positions[indices[k + 1] - first_vertex] - a, ac = positions[indices[k + 2] - first_vertex] - a;
        return 0.5f * glm::length(glm::cross(ab, ac));
    };
    for (std::size_t k = 0; k + 2 < indices.size(); k += 3) {
        LargeFace face{static_cast<std::uint32_t>(k / 3), 3, {indices[k], indices[k + 1], indices[k + 2], 0u}, area_of(k)};
        if (!std::isfinite(face.area)) continue;
        if (k + 5 < indices.size() && join(face, positions, first_vertex, indices.data() + k + 3)) {
            k += 3;
            face.area += area_of(k);
        }
        all.push_back(face);
    }
    const auto larger = [](const LargeFace& a, const LargeFace& b) {
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
    return kCell * kCell / std::max(along * along, 1.0e-30f);
}

void Occluders::cover(const glm::vec3 (&clip)[4], int corners)
{
    glm::vec2 p[4], low(1.0e30f), high(-1.0e30f);
    float z[4], least = 1.0f;
    for (int k = 0; k < corners; ++k) {
        p[k] = (glm::vec2(clip[k]) * 0.5f + 0.5f) * texels_;
        low = glm::min(low, p[k]);
        high = glm::max(high, p[k]);
        z[k] = clip[k].z;
        least = std::min(least, z[k]);
        // Maps flatten what is nearer than they reach.
        if (!(z[k] > 0.0f && z[k] <= 1.0f)) return;
    }
    const glm::vec2 ab = p[1] - p[0], ac = p[2] - p[0];
    const float area = ab.x * ac.y - ab.y * ac.x;
    if (!(std::abs(area) > kCell * kCell)) return;
    const float sign = area > 0.0f ? 1.0f : -1.0f;
    // Inside of each edge: x and y of its line and the rest, and how much less that is at the worst corner of a cell.
    const float reach = 0.5f * kCell + rounding_;
    glm::vec3 edge[4];
    for (int k = 0; k < corners; ++k) {
        const glm::vec2 from = p[k], way = p[(k + 1) % corners] - from;
        edge[k] = sign * glm::vec3(-way.y, way.x, way.y * from.x - way.x * from.y);
        edge[k].z -= reach * (std::abs(edge[k].x) + std::abs(edge[k].y));
    }
    const glm::vec2 slope = glm::vec2((z[1] - z[0]) * ac.y - (z[2] - z[0]) * ab.y, (z[2] - z[0]) * ab.x - (z[1] - z[0]) * ac.x) / area;
    const auto cell = [&](float at) { return static_cast<int>(std::clamp(at / kCell, 0.0f, static_cast<float>(cells_))); };
    const int x0 = cell(low.x), x1 = std::min(cell(high.x), cells_ - 1), y0 = cell(low.y), y1 = std::min(cell(high.y), cells_ - 1);
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            const glm::vec2 middle = (glm::vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) * kCell;
            bool inside = true;
            for (int k = 0; k < corners; ++k) inside = inside && edge[k].x * middle.x + edge[k].y * middle.y + edge[k].z > 0.0f;
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
