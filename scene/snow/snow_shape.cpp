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

// What rounding takes from an edge, (1 - pi / 4) of its depth squared a metre, leans against the step below it: a bank of
// moist snow, 55 degrees steep. It is enough for a step that is so high over the snow at its foot, in depths.
constexpr float kBankSlope = 1.428f;
constexpr float kBank = 0.7829f;      // sqrt(2 kBankSlope (1 - pi / 4))
constexpr float kAtRim_m = 1.0e-3f;
constexpr float kIntoSnow_m = 0.045f; // banks end so deep in the snow at their foot

// Deep snow forgets the stones below it.
float filled_m(const SnowCaps::Point& p, float thickness_m)
{
    return p.fill_m * shared::smooth_edge(0.01f, 0.06f, thickness_m);
}

// How far in a cap is rounded off.
float width_m(const SnowCaps::Point& p, float deep_m)
{
    return std::max(std::min(deep_m, 0.95f * p.support_m), 1.0e-4f);
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
    // As if nothing lay beyond the edges, and steps were level.
    std::vector<float> fallen(count), top(count);
    for (std::size_t i = 0; i < count; ++i) {
        const SnowCaps::Point& p = caps.points[i];
        fallen[i] = drawn_snow_m(depth_m[i]) * p.uneven * p.share;
        const float held = lesser(std::min(fallen[i], kMostOverWidth * p.support_m), p.most_m);
        const float thickness = held * rounded(p.edge_m / width_m(p, held));
        top[i] = p.base_m.y + thickness + filled_m(p, thickness);
    }
    for (std::size_t i = 0; i < count; ++i) {
        const SnowCaps::Point& p = caps.points[i];
        // How far what lies beyond the edge reaches over it.
        const float beyond = p.beyond != SnowCaps::kNone ? top[p.beyond] - p.base_m.y : -1.0e9f;
        const float over = std::clamp(beyond, 0.0f, fallen[i]);
        const float held = lesser(std::min(fallen[i], kMostOverWidth * p.support_m + over), p.most_m + over);
        // Or how far what the edge sheds closes the step down to it.
        const float step = std::max(-beyond, 0.0f);
        float bank = 0.0f;
        if (p.beyond != SnowCaps::kNone && p.above != SnowCaps::kNone) {
            const float shed = fallen[p.above];
            bank = (1.0f - shared::smooth_edge(0.35f * kBank * shed, kBank * shed, step)) *
                   shared::smooth_edge(0.01f, 0.03f, std::min(shed, fallen[p.beyond]));
        }
        const bool rim = p.edge_m < kAtRim_m;
        const float deep = bank > 0.0f && p.edge_m < fallen[p.above] ? std::max(held, bank * fallen[p.above]) : held;
        const float width = width_m(p, held);
        const float s = p.edge_m / width;
        const float slot = std::clamp(2.0f * held / (kClosed * p.gap_m) - 1.0f, 0.0f, 1.0f);
        const float kept = std::min(over / std::max(held, 1.0e-6f), 1.0f);
        const float round = rounded(s), round_slot = rounded(p.slot_m / width);
        // The edge of a low step is lost where the snow below it reaches half up its own.
        const float lower = p.below != SnowCaps::kNone ? std::max(top[p.below] - p.base_m.y, 0.0f) : 0.0f;
        const float lost = shared::smooth_edge(0.0f, 0.5f, lower / std::max(held, 1.0e-6f));
        const float round_low = rounded(p.low_m / width);
        const float thickness = held * (round_low + lost * (1.0f - round_low)) * (round + kept * (1.0f - round)) * (round_slot + slot * (1.0f - round_slot));
        const float sunk = kSunk_m * std::exp(-thickness / 0.02f);
        vec3 at = p.base_m;
        at.y += thickness - sunk + filled_m(p, thickness);
        const float bridged = p.slot_m < 1.0e-3f ? slot : std::min(thickness / 0.03f, 1.0f);
        at.x += p.bridge_m.x * bridged;
        at.z += p.bridge_m.y * bridged;
        if (rim && bank > 0.0f) {
            at.y -= bank * (step + kIntoSnow_m);
            const float out = bank * (step + kIntoSnow_m) / kBankSlope;
            at.x += p.out.x * out;
            at.z += p.out.y * out;
        } else if (s < 1.0f && held > 0.0f) {
            const float bulge = 3.5f * std::sqrt(s) * (1.0f - s) * (1.0f - s);
            const float out = std::min(kOverhang * held, kMostOverhang_m) * bulge * (1.0f - std::max(kept, bank));
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
