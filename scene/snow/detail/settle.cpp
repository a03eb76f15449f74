#include "scene/snow/detail/settle.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <queue>
#include <utility>

#include "formulas/weather/surface_weather.h"

namespace petrichor::scene::detail {
namespace {

using glm::vec2;
using glm::vec3;

constexpr float kRepose = 1.0f;       // tangent of 45 degrees: dry snow
constexpr float kShoulder = 0.4f;     // height of what stands upright at a level edge, over the half width below
constexpr float kRounded = 0.6f;      // what is left of a heap at repose that the wind has rounded
constexpr float kJoined_m = 0.35f;    // between vertices of two surfaces, along and across their joint
constexpr float kJoinedStep_m = 0.05f;
constexpr float kSticks_m = 0.012f;   // what holds on any slope
constexpr float kNowhere_m = 1.0e8f;
constexpr float kAtBorder_m = 1.0e-3f;
constexpr float kFound_m = 0.5f;      // within this a point tells what lies beyond an edge; up and down a quarter of it

using Next = std::pair<float, std::uint32_t>;
using Queue = std::priority_queue<Next, std::vector<Next>, std::greater<>>;

}  // namespace

void find_beyond(std::vector<Border>& edges, const SnowCaps& caps)
{
    const auto cell_of = [](float x, float z) {
        return std::pair(static_cast<int>(std::floor(x / kFound_m)), static_cast<int>(std::floor(z / kFound_m)));
    };
    std::map<std::pair<int, int>, std::vector<std::uint32_t>> cells;
    for (std::uint32_t i = 0; i < caps.points.size(); ++i)
        cells[cell_of(caps.points[i].base_m.x, caps.points[i].base_m.z)].push_back(i);
    const auto nearest_to = [&](const vec3& place) {
        float best = kFound_m;
        std::uint32_t found = SnowCaps::kNone;
        const auto middle = cell_of(place.x, place.z);
        for (int k = 0; k < 9; ++k) {
            const auto cell = cells.find({middle.first + k % 3 - 1, middle.second + k / 3 - 1});
            if (cell == cells.end()) continue;
            for (const std::uint32_t i : cell->second) {
                const vec3 way = caps.points[i].base_m - place;
                // On what lies there, not on a kerb above or below it.
                const float apart = glm::length(vec2(way.x, way.z)) + 4.0f * std::abs(way.y);
                if (apart >= best) continue;
                best = apart;
                found = i;
            }
        }
        return found;
    };
    for (Border& edge : edges) {
        if (!(edge.drop_m < kDeepDrop_m)) continue;
        const vec3 middle = 0.5f * (edge.from + edge.to);
        const vec3 out(kBeyond_m * edge.out.x, 0.0f, kBeyond_m * edge.out.y);
        edge.beyond = nearest_to(middle + out - vec3(0.0f, edge.drop_m, 0.0f));
    }
}

std::vector<Joint> joints_of(const SnowCaps& caps)
{
    const auto cell_of = [](const vec3& at) {
        return std::pair(static_cast<int>(std::floor(at.x / kJoined_m)), static_cast<int>(std::floor(at.z / kJoined_m)));
    };
    std::map<std::pair<int, int>, std::vector<std::uint32_t>> cells;
    const auto count = static_cast<std::uint32_t>(caps.points.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const SnowCaps::Point& point = caps.points[i];
        // At a border that is closed.
        if (glm::length(point.bridge_m) > 0.0f && point.slot_m > kAtBorder_m && point.edge_m > kAtBorder_m) cells[cell_of(point.base_m)].push_back(i);
    }
    std::vector<Joint> joints;
    for (const auto& [cell, points] : cells) {
        for (int k = 0; k < 9; ++k) {
            const auto near = cells.find({cell.first + k % 3 - 1, cell.second + k / 3 - 1});
            if (near == cells.end()) continue;
            for (const std::uint32_t i : points) {
                for (const std::uint32_t other : near->second) {
                    const vec3 way = caps.points[other].base_m - caps.points[i].base_m;
                    const float apart = glm::length(vec2(way.x, way.z));
                    if (other == i || apart > kJoined_m || std::abs(way.y) > kJoinedStep_m) continue;
                    // Those across the joint: the border of the other surface looks back.
                    if (glm::dot(caps.points[i].bridge_m, caps.points[other].bridge_m) >= 0.0f) continue;
                    joints.push_back({i, other, apart});
                }
            }
        }
    }
    return joints;
}

namespace {

// Up to where snow holds over each point, from its edges upwards.
struct Held {
    std::vector<float> top_m, upright_m;
    std::vector<std::uint32_t> edge;  // that it is held from

    float most_m(const SnowCaps& caps, std::size_t i) const
    {
        return top_m[i] >= 1.0e29f ? SnowCaps::kAnyDepth_m
                                   : upright_m[i] + kRounded * std::max(top_m[i] - caps.points[i].base_m.y, 0.0f);
    }
};

using Beside = std::vector<std::vector<std::pair<std::uint32_t, float>>>;

// From the lowest edge upwards (Dijkstra 1959), ties by number. Edges of steps up to closed_m hold nothing by themselves: snow
// lies over them as one sheet, and is held by what lies below them.
Held held_from_edges(const SnowCaps& caps, const std::vector<vec3>& normals, const Beside& beside, float closed_m)
{
    const std::size_t count = caps.points.size();
    Held held{std::vector<float>(count, 1.0e30f), std::vector<float>(count, 0.0f), std::vector<std::uint32_t>(count, SnowCaps::kNone)};
    std::map<std::uint32_t, std::vector<std::pair<std::uint32_t, float>>> over_steps;
    Queue queue;
    for (std::uint32_t i = 0; i < count; ++i) {
        const SnowCaps::Point& point = caps.points[i];
        if (point.edge_m > kAtBorder_m) continue;
        if (point.drop_m < closed_m) {
            if (point.beyond == SnowCaps::kNone) continue;
            const vec3 way = caps.points[point.beyond].base_m - point.base_m;
            // Across the edge: its points and those below it need not stand beside each other.
            over_steps[point.beyond].emplace_back(i, kRepose * std::abs(glm::dot(vec2(way.x, way.z), point.out)));
            continue;
        }
        const float level = shared::smooth_edge(0.77f, 0.95f, normals[i].y);
        held.top_m[i] = point.base_m.y;
        held.upright_m[i] = kSticks_m + level * kShoulder * point.support_m;
        held.edge[i] = i;
        queue.emplace(held.top_m[i], i);
    }
    while (!queue.empty()) {
        const auto [height, i] = queue.top();
        queue.pop();
        if (height > held.top_m[i]) continue;
        const auto reach = [&, from = i, up = height](std::uint32_t other, float rise) {
            const float there = up + rise;
            if (there - caps.points[other].base_m.y > kDeepestSnow_m + 1.0f || there >= held.top_m[other]) return;
            held.top_m[other] = there;
            held.upright_m[other] = held.upright_m[from];
            held.edge[other] = held.edge[from];
            queue.emplace(there, other);
        };
        for (const auto& [other, rise] : beside[i]) reach(other, rise);
        if (const auto above = over_steps.find(i); above != over_steps.end())
            for (const auto& [other, rise] : above->second) reach(other, rise);
    }
    return held;
}

}  // namespace

void hold_by_repose(SnowCaps& caps, const CutMesh& mesh, const std::vector<vec3>& normals,
                    const std::vector<Joint>& joints)
{
    const std::size_t count = caps.points.size();
    Beside beside(count);
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const Primitive& p = mesh.primitives[i];
        for (std::size_t k = 0; k < p.indices.size(); ++k) {
            const std::uint32_t a = mesh.points[i][p.indices[k]];
            const std::uint32_t b = mesh.points[i][p.indices[k % 3 == 2 ? k - 2 : k + 1]];
            const vec3 way = caps.points[a].base_m - caps.points[b].base_m;
            const float rise = kRepose * glm::length(vec2(way.x, way.z));
            beside[a].emplace_back(b, rise);
            beside[b].emplace_back(a, rise);
        }
    }
    for (const Joint& joint : joints) beside[joint.here].emplace_back(joint.beyond, kRepose * joint.apart_m);
    for (std::size_t k = 0; k < SnowCaps::kFills; ++k) {
        // Told of the next depth too: no step that closes between the two is an edge.
        const float closed_m = k + 1 < SnowCaps::kFills ? kHighestClosed * SnowCaps::kFillDepths_m[k + 1] : kDeepDrop_m;
        const Held sheet = held_from_edges(caps, normals, beside, closed_m);
        for (std::size_t i = 0; i < count; ++i) caps.points[i].sheet_most_m[k] = sheet.most_m(caps, i);
    }
    const Held held = held_from_edges(caps, normals, beside, 0.0f);
    for (std::size_t i = 0; i < count; ++i) {
        if (held.edge[i] == SnowCaps::kNone) continue;
        SnowCaps::Point& point = caps.points[i];
        point.most_m = held.most_m(caps, i);
        // Where deep snow closes the step at that edge, what lies below holds it.
        if (point.edge_m > kNowhere_m) {
            point.drop_m = caps.points[held.edge[i]].drop_m;
            point.beyond = caps.points[held.edge[i]].beyond;
        }
    }
}

}  // namespace petrichor::scene::detail
