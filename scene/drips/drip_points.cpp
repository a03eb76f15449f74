#include "scene/drips/drip_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "base/portable_math.h"
#include "formulas/noise/noise.h"

namespace petrichor::scene {
namespace {

using glm::vec3;

constexpr float kUp = 0.25f;          // what is steeper is a wall
constexpr float kLevel = 0.2f;        // an edge rises by less of its length
constexpr float kShortest_m = 0.003f;
constexpr float kWeld_m = 5.0e-4f;    // corners as near are one
constexpr float kPiece_m = 0.24f;     // of an edge, asked in its middle
constexpr float kSpacing_m = 0.04f;
constexpr float kOut_m = 0.015f;      // drops fall so far before the edge
constexpr float kOpenBelow_m = 0.3f;
constexpr float kLongestFall_m = 30.0f;
constexpr float kCaughtBelow_m = 0.15f;  // a gutter hangs no lower
constexpr float kGutter_m = 0.3f;     // nor reaches as far out
constexpr float kRim_m = 0.02f;       // its side is looked for so far below where drops land
constexpr float kClearOf_m = 0.03f;
constexpr float kFascia_m = 0.5f;     // water runs down a board at the edge, and drips from that
constexpr float kFasciaStep_m = 0.02f;
constexpr float kFasciaNear_m = 0.04f;
constexpr float kRise_m = 0.06f;      // what rises as high beyond the edge keeps the water back
constexpr float kLeastRun_m = 0.015f;
constexpr std::size_t kMostPieces = 200'000;
// Of the surface above an edge: where it is asked, and how much of it each answer stands for.
constexpr std::array<float, 7> kAsked_m{0.015f, 0.06f, 0.15f, 0.35f, 0.75f, 1.5f, 3.0f};
constexpr std::array<float, 7> kStandsFor_m{0.035f, 0.07f, 0.145f, 0.3f, 0.6f, 1.1f, 1.75f};

struct Side {
    std::array<std::uint32_t, 2> points;  // welded, ascending
    std::uint32_t triangle = 0;
    std::uint8_t corner = 0;              // the side begins there
};

struct Edge {
    vec3 from, to, out;  // out: unit, level
    float slope = 0.0f;  // of the surface above: metres up a metre inwards
    float length_m = 0.0f;
    bool level = false;
    std::uint32_t number = 0;
};

std::array<vec3, 3> corners_of(const Triangles& t, std::uint32_t i)
{
    return {t.corner(i), t.corner(i) + t.edge1(i), t.corner(i) + t.edge2(i)};
}

// Of the side that is seen from above.
vec3 up_of(const Triangles& triangles, std::uint32_t t)
{
    const vec3 n = triangles.normal(t);
    return triangles.double_sided(t) && n.y < 0.0f ? -n : n;
}

// Corners that lie at one place by one number; numbers follow from the places alone.
class Welded {
public:
    explicit Welded(const Triangles& triangles)
    {
        struct Corner {
            std::array<std::int64_t, 3> cell;
            std::uint32_t number;
        };
        std::vector<Corner> corners;
        corners.reserve(std::size_t{3} * triangles.size());
        for (std::uint32_t t = 0; t < triangles.size(); ++t) {
            const auto three = corners_of(triangles, t);
            for (std::uint32_t k = 0; k < 3; ++k) {
                const vec3 p = three[k] / kWeld_m;
                corners.push_back({{std::llround(p.x), std::llround(p.y), std::llround(p.z)}, 3 * t + k});
            }
        }
        std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
            return std::tie(a.cell, a.number) < std::tie(b.cell, b.number);
        });
        points_.resize(corners.size());
        std::uint32_t point = 0;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            if (i > 0 && corners[i].cell != corners[i - 1].cell) ++point;
            points_[corners[i].number] = point;
        }
    }
    std::uint32_t at(std::uint32_t triangle, std::uint32_t corner) const { return points_[3 * triangle + corner]; }

private:
    std::vector<std::uint32_t> points_;
};

// The sides of all triangles, those of one place together.
std::vector<Side> sides_of(const Triangles& triangles)
{
    const Welded welded(triangles);
    std::vector<Side> sides;
    sides.reserve(std::size_t{3} * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (std::uint8_t k = 0; k < 3; ++k) {
            const std::uint32_t a = welded.at(t, k), b = welded.at(t, (k + 1u) % 3u);
            if (a != b) sides.push_back({{std::min(a, b), std::max(a, b)}, t, k});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tie(a.points, a.triangle, a.corner) < std::tie(b.points, b.triangle, b.corner);
    });
    return sides;
}

bool drips(const Triangles& triangles, const DripOptions& options, std::uint32_t t)
{
    if ((triangles.flags(t) & (kTriangleMasked | kTriangleSheltered | kTriangleBackdrop)) != 0) return false;
    const std::uint32_t material = triangles.material(t);
    if (material < options.left_out.size() && options.left_out[material] != 0) return false;
    return up_of(triangles, t).y > kUp;
}

// Of a side of a triangle that faces up, if water that runs down there leaves it.
bool edge_of(const Triangles& triangles, const Side& side, Edge& edge)
{
    const auto corner = corners_of(triangles, side.triangle);
    edge.from = corner[side.corner];
    edge.to = corner[(side.corner + 1u) % 3u];
    const vec3 along = edge.to - edge.from;
    edge.length_m = glm::length(along);
    if (!(edge.length_m > kShortest_m) || std::abs(along.y) > kLevel * edge.length_m) return false;
    const vec3 inwards = corner[(side.corner + 2u) % 3u] - edge.from;
    vec3 out = glm::normalize(vec3(along.z, 0.0f, -along.x));
    if (glm::dot(out, inwards) > 0.0f) out = -out;
    edge.out = out;
    const vec3 n = up_of(triangles, side.triangle);
    edge.slope = glm::dot(n, out) / n.y;
    edge.level = n.y > 0.999f;
    return edge.slope > -0.02f;
}

// Edges beyond which no other surface that faces up goes on.
std::vector<Edge> edges_of(const Triangles& triangles, const DripOptions& options)
{
    const std::vector<Side> sides = sides_of(triangles);
    std::vector<Edge> edges;
    for (std::size_t first = 0; first < sides.size();) {
        std::size_t end = first;
        while (end < sides.size() && sides[end].points == sides[first].points) ++end;
        for (std::size_t i = first; i < end; ++i) {
            Edge edge;
            if (!drips(triangles, options, sides[i].triangle) || !edge_of(triangles, sides[i], edge)) continue;
            const bool goes_on = std::any_of(sides.begin() + static_cast<std::ptrdiff_t>(first),
                                             sides.begin() + static_cast<std::ptrdiff_t>(end), [&](const Side& other) {
                if (up_of(triangles, other.triangle).y <= kUp) return false;
                const vec3 third = corners_of(triangles, other.triangle)[(other.corner + 2u) % 3u];
                return glm::dot(third - edge.from, edge.out) > 0.0f;
            });
            if (goes_on) continue;
            edge.number = static_cast<std::uint32_t>(edges.size());
            edges.push_back(edge);
            break;  // the other side of the same sheet
        }
        first = end;
    }
    std::stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.length_m > b.length_m; });
    return edges;
}

// Where drops come off below an edge; false where none do.
bool leaves_at(const Tracer& tracer, const Edge& edge, const vec3& middle, DripPoint& point)
{
    const vec3 down(0.0f, -1.0f, 0.0f);
    vec3 at = middle + edge.out * kOut_m;
    if (tracer.blocked({at + vec3(0.0f, 0.01f, 0.0f), down, 0.01f + kOpenBelow_m})) return false;
    const vec3 over = middle + vec3(0.0f, 0.03f, 0.0f) - edge.out * 0.03f;
    if (tracer.blocked({over, edge.out, 0.03f + kRise_m})) return false;
    float board_m = 0.0f;
    while (tracer.blocked({at - vec3(0.0f, board_m + 0.5f * kFasciaStep_m, 0.0f), -edge.out, kFasciaNear_m})) {
        board_m += kFasciaStep_m;
        if (board_m > kFascia_m) return false;  // a wall
    }
    at.y -= board_m;
    const RayHit hit = tracer.nearest({at, down, kLongestFall_m});
    if (!hit.hit() || hit.distance_m < kOpenBelow_m) return false;
    point.from_m = at;
    point.ground_m = at.y - hit.distance_m;
    point.out = {edge.out.x, edge.out.z};
    return true;
}

// Where water runs over what catches it right below an edge, as a gutter does that is full of ice: from below its outer side,
// where that is free. False where it is none: the next row of tiles, a sill in front of a wall, the ground.
bool runs_over_at(const Tracer& tracer, const Edge& edge, const vec3& middle, DripPoint& point)
{
    const vec3 down(0.0f, -1.0f, 0.0f), above = middle + edge.out * kOut_m + vec3(0.0f, 0.01f, 0.0f);
    const RayHit caught = tracer.nearest({above, down, kCaughtBelow_m});
    if (!caught.hit()) return false;
    const float rim_m = above.y - caught.distance_m - kRim_m;
    const vec3 outside = vec3(above.x, rim_m, above.z) + edge.out * kGutter_m;
    const RayHit side = tracer.nearest({outside, -edge.out, kGutter_m});
    if (!side.hit() || side.distance_m < kClearOf_m) return false;
    const vec3 lip = outside - edge.out * side.distance_m;
    const vec3 beside = lip + edge.out * kClearOf_m;
    if (tracer.blocked({beside, down, kOpenBelow_m}) || tracer.blocked({beside, edge.out, kGutter_m})) return false;
    const vec3 below = lip - edge.out * kOut_m - vec3(0.0f, kOpenBelow_m, 0.0f);
    const RayHit under = tracer.nearest({below, -down, kOpenBelow_m});
    if (!under.hit()) return false;
    const vec3 at = below + vec3(0.0f, under.distance_m, 0.0f);
    const vec3 free = at + down * 0.005f;
    const RayHit hit = tracer.nearest({free, down, kLongestFall_m});
    if (!hit.hit() || hit.distance_m < kOpenBelow_m) return false;
    point.from_m = at + edge.out * kOut_m;
    point.ground_m = free.y - hit.distance_m;
    point.out = {edge.out.x, edge.out.z};
    point.gutter = 1;
    return true;
}

// How far in from an edge the same surface goes on up, in plan, as far as rain reaches it.
float open_run_m(const Tracer& tracer, const Edge& edge, const vec3& middle)
{
    float run_m = 0.0f;
    for (std::size_t k = 0; k < kAsked_m.size(); ++k) {
        const float slack_m = 0.02f + 0.15f * kAsked_m[k];
        const vec3 there = middle - edge.out * kAsked_m[k] + vec3(0.0f, edge.slope * kAsked_m[k], 0.0f);
        const vec3 above = there + vec3(0.0f, slack_m, 0.0f);
        const RayHit hit = tracer.nearest({above, vec3(0.0f, -1.0f, 0.0f), 2.0f * slack_m});
        if (!hit.hit() || std::abs(up_of(tracer.triangles(), hit.triangle).y) <= kUp) break;
        const vec3 on = above - vec3(0.0f, hit.distance_m - 0.005f, 0.0f);
        if (!tracer.blocked({on, vec3(0.0f, 1.0f, 0.0f)})) run_m += kStandsFor_m[k];
    }
    // What is level sheds to the nearest edge: to one of two sides, and at an end from the corner between them.
    return edge.level ? std::min(0.5f * run_m, 0.25f * edge.length_m) : run_m;
}

}  // namespace

std::vector<DripPoint> drip_points(const Tracer& tracer, const DripOptions& options)
{
    std::vector<DripPoint> points;
    std::size_t asked = 0;
    for (const Edge& edge : edges_of(tracer.triangles(), options)) {
        const int pieces = std::max(1, static_cast<int>(std::ceil(edge.length_m / kPiece_m)));
        for (int k = 0; k < pieces; ++k) {
            if (++asked > kMostPieces || points.size() >= options.most_points) return points;
            const float width_m = edge.length_m / static_cast<float>(pieces);
            const float t = (static_cast<float>(k) + 0.5f) / static_cast<float>(pieces);
            const vec3 middle = glm::mix(edge.from, edge.to, t);
            DripPoint point;
            if (!leaves_at(tracer, edge, middle, point) && !(options.gutters && runs_over_at(tracer, edge, middle, point))) continue;
            const float run_m = open_run_m(tracer, edge, middle);
            if (run_m < kLeastRun_m) continue;
            // So many as stand on it in the mean: short edges have one now and then.
            const std::uint32_t seed = shared::hash_u(edge.number * 4099u + static_cast<std::uint32_t>(k));
            const float wanted = width_m / kSpacing_m;
            const int count = static_cast<int>(wanted + shared::hash_f(seed));
            const vec3 along = (edge.to - edge.from) / static_cast<float>(pieces);
            for (int i = 0; i < count && points.size() < options.most_points; ++i) {
                DripPoint one = point;
                one.number = shared::hash_u(seed + 1u + static_cast<std::uint32_t>(i));
                const float at = (static_cast<float>(i) + shared::hash_f(one.number)) / static_cast<float>(count) - 0.5f;
                one.from_m += along * at;
                // Water gathers: one lets go often, its neighbour hardly ever.
                const float share = -portable_log(1.0f - 0.98f * shared::hash_f(one.number + 1u)) / 0.92f;
                one.drained_m2 = run_m * kSpacing_m * share;
                points.push_back(one);
            }
        }
    }
    return points;
}

}  // namespace petrichor::scene
