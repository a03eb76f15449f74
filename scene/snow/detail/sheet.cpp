#include "scene/snow/detail/sheet.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "formulas/noise/noise.h"
#include "formulas/weather/surface_weather.h"
#include "scene/snow/detail/circle_plane.h"

namespace petrichor::scene::detail {
namespace {

using glm::vec2;
using glm::vec3;

constexpr double kMostCells = 4.0e6;
constexpr float kWidth = 1.6f;     // radius of the circle, over the depth
constexpr float kUnder_m = 0.01f;  // snow of what lies below something goes so far under the snow on that
constexpr float kCovered_m = 0.06f; // the road under a lid, a gutter under bars
constexpr float kShelter_m = SnowCaps::kFillDepths_m[2];  // around which shelter is as one
constexpr float kBroad_m = SnowCaps::kFillDepths_m[3];  // whose surface tells how steep deep snow is
constexpr float kBuries_m = 0.08f;  // what lies so far over something all around leaves it no snow
constexpr float kRelief_m = 0.02f;
constexpr float kMostFill = 0.9f;   // of the depth, up or down
constexpr float kThin_m = 0.02f;    // half the width of what keeps its own cap in any snow ..
constexpr float kNotThin_m = 0.045f;  // .. and of a kerb, which does not
constexpr float kNear_m = 14.0f;
constexpr float kOfBanks_m = 24.0f;
constexpr float kCell_m = 0.025f;
constexpr float kClose_m = 2.2f;      // what is looked at from here is a thing on a table ..
constexpr float kCloseCell_m = 0.006f;
constexpr float kSmallClimbs = 0.55f;  // against the sides of a small model snow lies: it closes no steps higher than about its depth
constexpr float kCloseUp = 0.5f;      // .. as long as its cells are so much finer
constexpr float kCells = 9.0f;        // along a radius: a circle of a few hundred cells is enough
constexpr float kFarCell_m = 0.1f;
constexpr float kHolds = 0.02f;    // share of the depth: less is no ground that snow lies on

constexpr float kAtBorder_m = 1.0e-3f;
constexpr float kLaid_m = 0.06f;      // a lid on the ground stands at most so far over it
constexpr float kAtEdge_m = 0.08f;    // what lies so near an open edge keeps its height there
constexpr float kDips_m = 0.03f;      // its snow goes under that of the ground so far at its rim ..
constexpr float kDipWidth_m = 0.05f;  // .. from there on
constexpr int kSpread = 12;           // edges that the rim of a lid is told over

// How far points are from the rim of what lies on ground that goes on below it, as a manhole's lid: 0 at its rim, far for
// all others. There are two sheets of snow, which would meet in a hair line.
std::vector<float> rims_on_ground(const SnowCaps& caps, const CutMesh& mesh, const std::vector<Joint>& joints, const Tracer& tracer)
{
    std::vector<bool> joined(caps.points.size(), false);
    for (const Joint& joint : joints) joined[joint.here] = true;
    std::vector<float> away(caps.points.size(), kDipWidth_m);
    for (std::size_t i = 0; i < caps.points.size(); ++i) {
        const SnowCaps::Point& point = caps.points[i];
        const float length = glm::length(point.bridge_m);
        if (!(length > 0.0f) || point.slot_m < kAtBorder_m || point.edge_m < kAtBorder_m || joined[i]) continue;
        const vec2 in = point.bridge_m * (-0.02f / length);
        // Against a wall it ends, whatever is below.
        if (tracer.blocked({point.base_m + vec3(in.x, 0.015f, in.y), vec3(-in.x, 0.0f, -in.y) / 0.02f, 0.06f})) continue;
        const vec3 below = point.base_m + vec3(in.x, -0.002f, in.y);
        if (tracer.blocked({below, vec3(0.0f, -1.0f, 0.0f), kLaid_m})) away[i] = 0.0f;
    }
    for (int pass = 0; pass < kSpread; ++pass) {
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            const Primitive& p = mesh.primitives[i];
            for (std::size_t k = 0; k < p.indices.size(); ++k) {
                const std::uint32_t a = mesh.points[i][p.indices[k]];
                const std::uint32_t b = mesh.points[i][p.indices[k % 3 == 2 ? k - 2 : k + 1]];
                const float length = glm::distance(caps.points[a].base_m, caps.points[b].base_m);
                away[a] = std::min(away[a], away[b] + length);
                away[b] = std::min(away[b], away[a] + length);
            }
        }
    }
    return away;
}

}  // namespace

Sheet::Sheet(const SnowCaps& caps, const CutMesh& mesh, float cell_m, const std::function<bool(const vec3&)>& near, float climbs)
    : cell_m_(cell_m), climbs_(climbs)
{
    vec2 low(1.0e30f), high(-1.0e30f);
    for (const SnowCaps::Point& point : caps.points) {
        if (!near(point.base_m)) continue;
        low = glm::min(low, vec2(point.base_m.x, point.base_m.z));
        high = glm::max(high, vec2(point.base_m.x, point.base_m.z));
    }
    if (!(low.x <= high.x)) return;
    const glm::dvec2 size = glm::dvec2(high) - glm::dvec2(low) + 1.0;
    cell_m_ = std::max(cell_m, static_cast<float>(std::sqrt(size.x * size.y / kMostCells)));
    low_ = low - 2.0f * cell_m_;
    width_ = static_cast<int>((high.x - low_.x) / cell_m_) + 3;
    height_ = static_cast<int>((high.y - low_.y) / cell_m_) + 3;
    first_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), kNoLayer);
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const Primitive& p = mesh.primitives[i];
        for (std::size_t k = 0; k + 2 < p.indices.size(); k += 3) {
            const SnowCaps::Point* t[3];
            vec2 at[3];
            for (std::size_t c = 0; c < 3; ++c) {
                t[c] = &caps.points[mesh.points[i][p.indices[k + c]]];
                at[c] = (vec2(t[c]->base_m.x, t[c]->base_m.z) - low_) / cell_m_;
            }
            if (std::max({t[0]->share, t[1]->share, t[2]->share}) <= kHolds) continue;
            const vec2 u = at[1] - at[0], v = at[2] - at[0];
            const float area = u.x * v.y - u.y * v.x;
            if (!(std::abs(area) > 1.0e-9f)) continue;
            const vec2 from = glm::min(at[0], glm::min(at[1], at[2])), to = glm::max(at[0], glm::max(at[1], at[2]));
            const int x0 = std::max(static_cast<int>(std::ceil(from.x - 0.5f)), 0), x1 = std::min(static_cast<int>(std::floor(to.x - 0.5f)), width_ - 1);
            const int z0 = std::max(static_cast<int>(std::ceil(from.y - 0.5f)), 0), z1 = std::min(static_cast<int>(std::floor(to.y - 0.5f)), height_ - 1);
            for (int z = z0; z <= z1; ++z) {
                for (int x = x0; x <= x1; ++x) {
                    const vec2 w = vec2(static_cast<float>(x) + 0.5f, static_cast<float>(z) + 0.5f) - at[0];
                    const float b1 = (w.x * v.y - w.y * v.x) / area, b2 = (u.x * w.y - u.y * w.x) / area;
                    if (b1 < 0.0f || b2 < 0.0f || b1 + b2 > 1.0f) continue;
                    const float b0 = 1.0f - b1 - b2;
                    std::uint32_t& head = first_[static_cast<std::size_t>(z) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
                    layers_.push_back({b0 * t[0]->base_m.y + b1 * t[1]->base_m.y + b2 * t[2]->base_m.y,
                                       b0 * t[0]->broad + b1 * t[1]->broad + b2 * t[2]->broad, head, static_cast<std::uint32_t>(i),
                                       static_cast<std::uint32_t>(k)});
                    head = static_cast<std::uint32_t>(layers_.size() - 1);
                }
            }
        }
    }
}

Sheet::Smoothed Sheet::smoothed(const vec2& place, float own_m, float depth_m) const
{
    const Smoothed none{own_m};
    const float radius = std::max(kWidth * depth_m, 1.5f * cell_m_);
    const vec2 at = (place - low_) / cell_m_ - 0.5f;
    const float reach = radius / cell_m_;
    const float highest = std::max(1.75f * depth_m, kCovered_m);
    const int stride = std::max(static_cast<int>(std::ceil(reach / kCells)), 1);
    const int x0 = std::max(static_cast<int>(std::ceil(at.x - reach)), 0), x1 = std::min(static_cast<int>(std::floor(at.x + reach)), width_ - 1);
    const int z0 = std::max(static_cast<int>(std::ceil(at.y - reach)), 0), z1 = std::min(static_cast<int>(std::floor(at.y + reach)), height_ - 1);
    CirclePlane plane;
    float open = 0.0f, bare = 0.0f, all = 0.0f;
    for (int z = z0; z <= z1; z += stride) {
        for (int x = x0; x <= x1; x += stride) {
            const vec2 way = (vec2(static_cast<float>(x), static_cast<float>(z)) - at) / reach;
            const float in = 1.0f - glm::dot(way, way);
            if (!(in > 0.0f)) continue;
            all += in * in;
            const std::uint32_t head = first_[static_cast<std::size_t>(z) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
            if (head == kNoLayer) continue;
            const Layer* own = &layers_[head];
            for (std::uint32_t k = own->next; k != kNoLayer; k = layers_[k].next)
                if (std::abs(layers_[k].height_m - own_m) < std::abs(own->height_m - own_m)) own = &layers_[k];
            float here = own->height_m;
            bool covered = false;
            for (std::uint32_t k = head; k != kNoLayer; k = layers_[k].next) {
                const float over = layers_[k].height_m;
                if (over < own_m + highest) here = std::max(here, over - kUnder_m);
                covered = covered || (over > own_m + kBuries_m && over < own_m + kDeepestSnow_m);
            }
            const float step = std::abs(here - own_m);
            const float w = in * in * step_closed(step, climbs_ * depth_m);
            plane.add(w, way, here - own_m);
            open += w * own->open;
            bare += covered ? 0.0f : w * own->open;
        }
    }
    const float weight = plane.weight();
    if (!(weight > 0.0f)) return none;
    const CirclePlane::Fit fit = plane.fit();
    return {own_m + fit.rise_m, fit.slope_m / radius, open / weight, bare / weight, weight / all};
}

Sheet fill_relief(SnowCaps& caps, const CutMesh& mesh, const std::vector<Joint>& joints, const Tracer& tracer, const SnowCapOptions& options)
{
    const auto eye_m = [&](const vec3& p) {
        float nearest = options.eyes_m.empty() ? 0.0f : 1.0e30f;
        for (const vec3& eye : options.eyes_m) nearest = std::min(nearest, glm::distance(eye, p));
        return nearest;
    };
    const float climbs = glm::mix(1.0f, kSmallClimbs, small_model(tracer));
    const Sheet near(caps, mesh, kCell_m, [&](const vec3& p) { return eye_m(p) < kOfBanks_m; }, climbs);
    const Sheet close(caps, mesh, kCloseCell_m, [&](const vec3& p) { return !options.eyes_m.empty() && eye_m(p) < kClose_m; }, climbs);
    const float close_m = !options.eyes_m.empty() && close.width() > 0 && close.cell_m() < kCloseUp * kCell_m ? kClose_m - 0.5f : 0.0f;
    const Sheet far(caps, mesh, kFarCell_m, [](const vec3&) { return true; }, climbs);
    const std::vector<float> away = rims_on_ground(caps, mesh, joints, tracer);
    parallel_for(caps.points.size(), 0, [&](std::size_t i) {
        SnowCaps::Point& point = caps.points[i];
        const float eye = eye_m(point.base_m);
        const Sheet& sheet = eye < close_m ? close : eye < kNear_m - 1.0f ? near : far;
        point.drop_m /= climbs;
        const float dip = 1.0f - shared::smooth_edge(0.0f, kDipWidth_m, away[i]);
        const float inside = shared::smooth_edge(0.0f, kAtEdge_m, point.edge_m);
        float open = point.broad, broad = point.share, seen = 1.0f;
        const vec2 here(point.base_m.x, point.base_m.z);
        for (std::size_t k = 0; k < SnowCaps::kFills; ++k) {
            const float depth = SnowCaps::kFillDepths_m[k];
            const Sheet::Smoothed there = sheet.smoothed(here + point.bridge_m, point.base_m.y, depth);
            const float closed = step_closed(point.drop_m, depth);
            const float counts = inside + closed * (1.0f - inside);
            // Of posts and small things most of the circle is not: they keep their shape.
            const float most = std::max(kRelief_m, kMostFill * depth);
            const float whole = shared::smooth_edge(0.35f, 0.6f, there.whole);
            // Nor is a tube or a strap a step of what it lies on.
            if (depth == kShelter_m) point.wide = whole * shared::smooth_edge(kThin_m, kNotThin_m, point.support_m);
            float fill = counts * whole * std::clamp(there.height_m - point.base_m.y, -most, most);
            fill -= dip * (k == 0 ? 0.5f : 1.0f) * (kDips_m + std::max(fill, 0.0f));
            point.fill_m[k] = fill;
            if (depth == kShelter_m) {
                open = there.open;
                seen = shared::smooth_edge(0.08f, 0.2f, there.bare);
            }
            if (depth == kBroad_m) {
                point.broad_slope = snow_on_slope(1.0f / std::sqrt(1.0f + glm::dot(there.slope, there.slope)));
                broad = open * point.broad_slope;
            }
        }
        // What lies below something else all around, as a wall below its coping, carries none.
        point.share *= seen;
        point.broad = seen * broad;
    });
    return near;
}

namespace {

// Swells of a size: narrower than the edges can carry they would be creases along the triangles.
float swell(const vec3& at, float size_m, std::uint32_t seed, float edge_m)
{
    const float carried = 1.0f - shared::smooth_edge(0.35f * size_m, 0.9f * size_m, edge_m);
    return 0.5f + carried * (shared::tileable_noise(vec2(at.x, at.z) / size_m, 1 << 20, seed) - 0.5f);
}

}  // namespace

float uneven_at(const vec3& place, float edge_m)
{
    return 0.78f + 0.3f * swell(place, 1.7f, 11u, edge_m) + 0.14f * swell(place, 0.43f, 12u, edge_m);
}

}  // namespace petrichor::scene::detail
