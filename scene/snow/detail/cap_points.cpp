#include "scene/snow/detail/cap_points.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <unordered_map>
#include <utility>

#include "base/parallel.h"
#include "formulas/noise/noise.h"
#include "formulas/weather/surface_weather.h"
#include "scene/snow/detail/cap_ground.h"
#include "scene/snow/detail/sheet.h"

namespace petrichor::scene::detail {

using glm::vec2;
using glm::vec3;

namespace {

constexpr float kEven_m = 0.06f;    // what is seen of the sky is evened out over so much
constexpr float kBridge_m = 0.018f; // caps reach so far into walls and over joints
constexpr float kMeet_m = 0.004f;   // surfaces so near to each other meet
constexpr int kSpread = 12;         // edges that a support is told over

float smooth_noise(const vec3& p, float cell_m, std::uint32_t seed)
{
    return shared::tileable_noise(vec2(p.x, p.z) / cell_m, 1 << 20, seed);
}

// The longest edge at each point.
std::vector<float> longest_edges_m(const CutMesh& mesh, std::size_t count)
{
    std::vector<float> longest(count, 0.0f);
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const Primitive& p = mesh.primitives[i];
        for (std::size_t k = 0; k < p.indices.size(); ++k) {
            const std::uint32_t a = p.indices[k];
            const std::uint32_t b = p.indices[k % 3 == 2 ? k - 2 : k + 1];
            const float length = glm::distance(p.positions[a], p.positions[b]);
            for (const std::uint32_t at : {mesh.points[i][a], mesh.points[i][b]}) longest[at] = std::max(longest[at], length);
        }
    }
    return longest;
}

// Share of the sky at each point. Rays are few, and a step of a hand's width from point to point is no step of the snow: it
// is evened out over what lies within kEven_m along the triangles, by its area, however fine they are.
std::vector<float> even_sky(const CutMesh& mesh, std::size_t count)
{
    std::vector<float> sky(count, 0.0f), area(count, 0.0f);
    std::vector<std::vector<std::pair<std::uint32_t, float>>> beside(count);
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const Primitive& p = mesh.primitives[i];
        for (std::size_t v = 0; v < mesh.points[i].size(); ++v) sky[mesh.points[i][v]] = p.weather[v].w;
        for (std::size_t k = 0; k < p.indices.size(); ++k) {
            const std::uint32_t a = p.indices[k], b = p.indices[k % 3 == 2 ? k - 2 : k + 1], c = p.indices[k % 3 == 0 ? k + 2 : k - 1];
            const std::uint32_t pa = mesh.points[i][a], pb = mesh.points[i][b];
            area[pa] += glm::length(glm::cross(p.positions[b] - p.positions[a], p.positions[c] - p.positions[a]));
            const float length = glm::distance(p.positions[a], p.positions[b]);
            if (length >= kEven_m) continue;
            beside[pa].emplace_back(pb, length);
            beside[pb].emplace_back(pa, length);
        }
    }
    // The nearest first (Dijkstra 1959).
    using Next = std::pair<float, std::uint32_t>;
    using Queue = std::priority_queue<Next, std::vector<Next>, std::greater<>>;
    // Most points have all of it alike around them.
    std::vector<float> from_others(count, kEven_m);
    Queue others;
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool alike = std::all_of(beside[i].begin(), beside[i].end(), [&](const auto& there) { return sky[there.first] == sky[i]; });
        if (alike) continue;
        from_others[i] = 0.0f;
        others.emplace(0.0f, i);
    }
    while (!others.empty()) {
        const auto [far, i] = others.top();
        others.pop();
        if (far > from_others[i]) continue;
        for (const auto& [other, length] : beside[i]) {
            if (!(far + length < from_others[other])) continue;
            from_others[other] = far + length;
            others.emplace(far + length, other);
        }
    }
    std::vector<float> even(sky);
    parallel_for(count, 0, [&](std::size_t first) {
        if (!(from_others[first] < kEven_m)) return;
        Queue queue;
        std::unordered_map<std::uint32_t, float> away;
        const auto own = static_cast<std::uint32_t>(first);
        away[own] = 0.0f;
        queue.emplace(0.0f, own);
        float sum = 0.0f, weight = 0.0f;
        while (!queue.empty()) {
            const auto [far, i] = queue.top();
            queue.pop();
            if (far > away[i]) continue;
            const float in = 1.0f - (far / kEven_m) * (far / kEven_m);
            // No triangle counts beyond where it is told of.
            const float w = in * in * std::min(area[i], kEven_m * kEven_m);
            sum += w * sky[i];
            weight += w;
            for (const auto& [other, length] : beside[i]) {
                const float there = far + length;
                if (!(there < kEven_m)) continue;
                const auto [found, fresh] = away.try_emplace(other, there);
                if (!fresh && !(there < found->second)) continue;
                found->second = there;
                queue.emplace(there, other);
            }
        }
        if (weight > 0.0f) even[first] = sum / weight;
    });
    return even;
}

}  // namespace

void fill_shares(SnowCaps& caps, const CutMesh& mesh, const std::vector<vec3>& normals, const SnowCapOptions& options)
{
    caps.points.resize(normals.size());
    const std::vector<float> even = even_sky(mesh, normals.size());
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const Primitive& p = mesh.primitives[i];
        for (std::size_t v = 0; v < p.positions.size(); ++v) {
            const std::uint32_t number = mesh.points[i][v];
            SnowCaps::Point& point = caps.points[number];
            point.base_m = p.positions[v];
            const float sky = even[number];
            const float ragged = 0.3f * (smooth_noise(point.base_m, 0.17f, 91u) - 0.5f);
            const float open = shared::smooth_edge(kHidden, 0.8f, sky + ragged * std::min(1.0f, 4.0f * (1.0f - sky)));
            const float slope = snow_on_slope(normals[number].y);
            const float far = nearest_eye_m(options, point.base_m) / options.reach_m;
            // Blue of the vertices: where snow may lie at all.
            point.broad = open * (1.0f - shared::smooth_edge(0.7f, 0.97f, far)) * std::clamp(p.weather[v].z, 0.0f, 1.0f);
            point.slope = slope;
            point.share = point.broad * slope;
        }
    }
}

void fill_points(SnowCaps& caps, const CutMesh& mesh, const Grids& grids, const std::vector<vec3>& normals)
{
    const std::vector<float> longest = longest_edges_m(mesh, normals.size());
    parallel_for(caps.points.size(), 0, [&](std::size_t number) {
        SnowCaps::Point& point = caps.points[number];
        const vec3& at = point.base_m;
        const vec3& normal = normals[number];
        if (const NearEdge edge = grids.edges.nearest(at, normal); edge.border != nullptr) {
            point.edge_m = edge.distance_m;
            point.drop_m = edge.border->drop_m;
            point.out = edge.border->out;
            point.beyond = edge.border->beyond;
        }
        point.support_m = point.edge_m;
        if (const NearEdge border = grids.closed.nearest(at, normal); border.distance_m < 1.0e-3f)
            point.bridge_m = border.border->out * kBridge_m;
        if (const NearEdge step = grids.low.nearest(at, normal); step.border != nullptr) {
            point.low_m = step.distance_m;
            point.below = step.border->beyond;
        }
        if (const NearEdge slot = grids.slots.nearest(at, normal); slot.border != nullptr) {
            point.slot_m = slot.distance_m;
            point.gap_m = slot.border->gap_m;
            if (point.slot_m < 1.0e-3f) point.bridge_m = slot.border->out * (0.5f * point.gap_m + 0.01f);
        }
        point.uneven = uneven_at(at, longest[number]);
    });
}

void tread(SnowCaps& caps, const SnowCapOptions& options)
{
    if (!options.pressed || !options.presses) return;
    for (SnowCaps::Point& point : caps.points) {
        const float left = 1.0f - options.pressed(point.base_m);
        point.share *= left;
        point.broad *= left;
    }
}

void narrow_bridges(SnowCaps& caps, const std::vector<Joint>& joints)
{
    std::vector<bool> meets(caps.points.size(), false);
    for (const Joint& joint : joints) {
        const SnowCaps::Point &here = caps.points[joint.here], &there = caps.points[joint.beyond];
        const vec2 way(there.base_m.x - here.base_m.x, there.base_m.z - here.base_m.z);
        const float length = glm::length(here.bridge_m);
        const bool opposite = glm::dot(here.bridge_m, there.bridge_m) < -0.7f * length * glm::length(there.bridge_m);
        meets[joint.here] = meets[joint.here] || (opposite && std::abs(glm::dot(way, here.bridge_m)) < kMeet_m * length);
    }
    for (std::size_t i = 0; i < meets.size(); ++i)
        if (meets[i]) caps.points[i].bridge_m *= 0.5f;
}

void find_supports(SnowCaps& caps, const CutMesh& mesh)
{
    for (SnowCaps::Point& p : caps.points) p.support_m = std::min(p.support_m, EdgeGrid::kReach_m);
    for (int pass = 0; pass < kSpread; ++pass) {
        std::vector<float> next(caps.points.size());
        for (std::size_t i = 0; i < next.size(); ++i) next[i] = caps.points[i].support_m;
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            const Primitive& p = mesh.primitives[i];
            for (std::size_t k = 0; k < p.indices.size(); ++k) {
                const std::uint32_t a = mesh.points[i][p.indices[k]];
                const std::uint32_t b = mesh.points[i][p.indices[k % 3 == 2 ? k - 2 : k + 1]];
                next[a] = std::max(next[a], caps.points[b].support_m);
                next[b] = std::max(next[b], caps.points[a].support_m);
            }
        }
        for (std::size_t i = 0; i < next.size(); ++i) caps.points[i].support_m = next[i];
    }
}

}  // namespace petrichor::scene::detail
