#include <algorithm>
#include <array>
#include <cmath>

#include "formulas/weather/surface_weather.h"
#include "scene/snow/snow_caps.h"

namespace petrichor::scene {

float step_closed(float step_m, float depth_m)
{
    if (!(step_m < kHighestClosed * depth_m)) return 0.0f;
    return 1.0f - shared::smooth_edge(1.45f, kHighestClosed, step_m / depth_m);
}

float snow_on_slope(float up)
{
    return std::clamp((1.04719755f - std::acos(std::clamp(up, 0.0f, 1.0f))) / 0.52359878f, 0.0f, 1.0f);
}

namespace {

using glm::vec3;

constexpr float kSunk_m = 0.012f;       // of a cap without snow, below its surface
constexpr float kNotSunk_m = 0.16f;     // less than a hundredth of a millimetre is left of that
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

constexpr float kAtRim_m = 1.0e-3f;
constexpr float kNearEdge_m = 0.25f;
constexpr float kSmoothedDown = 0.75f;  // of the thickness
constexpr float kBankSlope = 1.428f;  // of what leans against a step: moist snow, 55 degrees
constexpr float kIntoSnow_m = 0.055f; // it ends so deep in the snow at its foot
constexpr float kMostOut_m = 0.06f;
// A bank is as high as what the edge above it sheds lets it be: (1 - pi / 4) of the depth squared a metre, at a slope of 0.9.
constexpr float kShed = 0.62f;
constexpr float kSlit_m = 0.05f;       // less of a step than this is not left open
constexpr float kThinBank_m = 0.02f;   // snow of this depth has no bank ..
constexpr float kWholeBank_m = 0.05f;  // .. and of this a whole one
constexpr float kOverCorner = 0.65f;   // of the depth: caps go no lower for a bank
constexpr float kBelowBank_m = 0.008f;  // caps below a whole bank
constexpr float kOverCaps_m = 0.002f;  // a bank lies so far over the caps ..
constexpr float kUnderCaps_m = 0.02f;  // .. and goes so far under them where it ends
constexpr float kOnCorner_m = 0.018f;  // so much lies at least on an edge that a bank closes

// Of a bank: how much lower it lies than a sheet that closes the step.
float bank_low_m(const SnowCaps::Point& p, float depth_m)
{
    const float low = std::max(0.5f * p.bank_m - kShed * depth_m, 0.0f);
    return low * shared::smooth_edge(0.0f, kSlit_m, low);
}

// How much higher it is heaped up where stones that are half as high as it is deep would stand out of it.
float corner_m(const SnowCaps::Point& p, float depth_m)
{
    const float low = std::max(0.5f * p.bank_m + kOnCorner_m - depth_m, 0.0f);
    return p.corner * (1.0f - p.fade) * low * (1.0f - shared::smooth_edge(0.5f * kSlit_m, kSlit_m, low));
}

// Share of the bank over a cap that is one sheet with what lies beside it.
float whole_bank(const SnowCaps::Point& p, float depth_m)
{
    return (1.0f - shared::smooth_edge(0.0f, kSlit_m, bank_low_m(p, depth_m))) * shared::smooth_edge(kThinBank_m, kWholeBank_m, depth_m);
}

// Deep snow forgets the ground below it. sheet_m: what of it holds as one sheet over steps.
float filled_m(const SnowCaps::Point& p, float depth_m, float sheet_m)
{
    const auto of = [&](const std::array<float, SnowCaps::kFills>& fills) {
        float from_m = 0.0f, from = 0.0f;
        for (std::size_t k = 0; k < SnowCaps::kFills; ++k) {
            const float to_m = SnowCaps::kFillDepths_m[k];
            if (depth_m < to_m) return from + (fills[k] - from) * (depth_m - from_m) / (to_m - from_m);
            from_m = to_m;
            from = fills[k];
        }
        return from;
    };
    const float own = of(p.fill_m);
    if (p.bank > 0.0f || !(p.fade > 0.0f)) return own;
    // Where a bank is one sheet with what lies beside it, that is below it.
    const float one = p.fade * whole_bank(p, sheet_m);
    // Corners stand out of it with a cap of their own.
    return own + one * (std::max(of(p.bank_fill_m) - kBelowBank_m, -kOverCorner * depth_m) - own);
}

// What falls at a point: shoulders of stones, which hold little, are lost below deep snow.
float fallen_m(const SnowCaps::Point& p, float depth_m, float held)
{
    constexpr float kLeastHeld = 0.02f;
    // Thinner snow lies in the relief of a slope, as between its tiles, and is less of a body: whole it would be islands with edges of triangles.
    constexpr float kInRelief_m = 0.03f, kOverRelief_m = 0.08f;
    const float drawn = drawn_snow_m(depth_m) * p.uneven;
    const float once = held < 1.0f ? shared::smooth_edge(kInRelief_m, kOverRelief_m, depth_m) : 0.0f;
    const auto of_place = [held, once](float share, float slope) {
        return once > 0.0f ? share + once * (share / std::max({slope, held, kLeastHeld}) - share) : share;
    };
    const float share = of_place(p.share, p.slope), broad = of_place(p.broad, p.broad_slope);
    if (share == broad) return drawn * share;
    const float inside = p.edge_m < 0.25f ? shared::smooth_edge(0.05f, 0.25f, p.edge_m) : 1.0f;
    const float open = inside < 1.0f ? inside + p.wide * step_closed(p.drop_m, drawn) * (1.0f - inside) : 1.0f;
    return drawn * (share + shared::smooth_edge(0.0f, 0.17f, drawn) * open * (broad - share));
}

// The lesser of two depths, rounded where they meet.
float lesser(float a, float b)
{
    if (!(a > 0.0f) || !(b > 0.0f)) return 0.0f;
    const float r = std::min(a, b) / std::max(a, b);
    return std::min(a, b) / std::sqrt(1.0f + r * r);
}

// What of it holds where it lies over steps as one sheet: a stair of tiles on a steep roof carries no more than its eaves hold.
float sheet_m(const SnowCaps::Point& p, float fallen_m)
{
    constexpr float kMost_m = 1.0f;  // of depths between which it is linear
    constexpr float kMeets = 0.3f;   // of the depth
    const auto& depths = SnowCaps::kFillDepths_m;
    const auto& most = p.sheet_most_m;
    if (std::all_of(most.begin(), most.end(), [](float m) { return m >= SnowCaps::kAnyDepth_m; })) return fallen_m;
    float holds = std::min(most.front(), kMost_m);
    for (std::size_t k = 1; k < SnowCaps::kFills; ++k) {
        const float share = std::clamp((fallen_m - depths[k - 1]) / (depths[k] - depths[k - 1]), 0.0f, 1.0f);
        holds += share * (std::min(most[k], kMost_m) - holds);
    }
    // Rounded where they meet, and as it fell where there is room enough.
    const float width = kMeets * fallen_m;
    const float meets = std::max(width - std::abs(fallen_m - holds), 0.0f);
    return width > 0.0f ? std::max(std::min(fallen_m, holds) - 0.25f * meets * meets / width, 0.0f) : 0.0f;
}

// How far in a cap is rounded off.
float width_m(const SnowCaps::Point& p, float deep_m)
{
    return std::max(std::min(deep_m, 0.95f * p.support_m), 1.0e-4f);
}

// How far a cap lies below its surface.
float sunk_m(float thickness_m)
{
    return thickness_m < kNotSunk_m ? kSunk_m * std::exp(-thickness_m / 0.02f) : 0.0f;
}

// Too far from edges, slots and steps for them to shape a cap so deep.
bool in_the_midst(const SnowCaps::Point& p, float held_m)
{
    return p.edge_m >= std::max(held_m, kNearEdge_m) && p.slot_m >= std::max(held_m, kAtRim_m) && p.low_m >= std::max(held_m, kAtRim_m) &&
           p.beyond == SnowCaps::kNone && !(p.fade > 0.0f) && p.bridge_m == glm::vec2(0.0f);
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

DrawnSnow all_drawn(const SnowCaps& caps)
{
    DrawnSnow all{std::vector<std::uint8_t>(caps.points.size(), DrawnSnow::kDrawn), {}};
    for (const std::uint32_t corner : caps.indices) all.triangles.push_back(caps.corner_points[corner]);
    return all;
}

SnowShape snow_shape(const SnowCaps& caps, std::span<const float> depth_m)
{
    return snow_shape(caps, depth_m, all_drawn(caps));
}

SnowShape snow_shape(const SnowCaps& caps, std::span<const float> depth_m, const DrawnSnow& drawn, std::span<const float> held_shares)
{
    const std::size_t count = caps.points.size();
    SnowShape shape{std::vector<vec3>(count), {}, std::vector<float>(count), std::vector<float>(count)};
    // As if nothing lay beyond the edges.
    // A bank needs no edges: it lies where deep snow closes the steps below it, and goes under the caps where it does not.
    const auto bank_m = [](const SnowCaps::Point& p, float fallen_m) {
        const float thin = 1.0f - shared::smooth_edge(kThinBank_m, kWholeBank_m, fallen_m);
        return kOverCaps_m - p.fade * kUnderCaps_m - bank_low_m(p, fallen_m) - thin * (fallen_m + kUnderCaps_m);
    };
    const auto put = [&shape](std::size_t i, const vec3& at, float thickness, float deep) {
        shape.positions[i] = at;
        shape.thickness_m[i] = thickness;
        shape.deep_m[i] = deep;
        shape.thickest_m = std::max(shape.thickest_m, thickness);
    };
    std::vector<float> fallen(count), sheet(count), closing(count), bare(count), top(count);
    std::vector<std::uint32_t> edges;  // points that ask what lies beside them
    for (std::size_t i = 0; i < count; ++i) {
        const SnowCaps::Point& p = caps.points[i];
        if (drawn.points[i] != DrawnSnow::kDrawn) shape.positions[i] = p.base_m;
        if (drawn.points[i] == 0) continue;
        fallen[i] = fallen_m(p, depth_m[i], held_shares.empty() ? 1.0f : held_shares[i]);
        sheet[i] = sheet_m(p, fallen[i]);
        if (p.bank > 0.0f) {
            if (drawn.points[i] != DrawnSnow::kDrawn) continue;
            const float lies = sheet[i];
            const float over = lies + filled_m(p, lies, lies) + bank_m(p, lies) + corner_m(p, lies);
            put(i, p.base_m + vec3(0.0f, over, 0.0f), std::max(std::min(over, lies), 0.0f), lies);
            continue;
        }
        // Below a bank the caps close where it does.
        const float alone = p.wide * step_closed(p.drop_m, sheet[i]);
        const float closed = closing[i] = p.fade > 0.0f ? glm::mix(alone, whole_bank(p, sheet[i]), p.fade) : alone;
        const float open = lesser(std::min(fallen[i], kMostOverWidth * p.support_m), p.most_m);
        const float held = open + closed * std::max(sheet[i] - open, 0.0f);
        const float round = p.edge_m < held ? rounded(p.edge_m / width_m(p, held)) : 1.0f;
        bare[i] = p.base_m.y + held * (round + closed * (1.0f - round));
        top[i] = bare[i] + filled_m(p, fallen[i], sheet[i]);
        if (drawn.points[i] != DrawnSnow::kDrawn) continue;
        if (closed == 0.0f && in_the_midst(p, held)) {
            put(i, p.base_m + vec3(0.0f, held - sunk_m(held) + (top[i] - bare[i]), 0.0f), held, held);
        } else {
            edges.push_back(static_cast<std::uint32_t>(i));
        }
    }
    std::vector<std::uint8_t> sunk_rim(count, 0);
    for (const std::uint32_t i : edges) {
        const SnowCaps::Point& p = caps.points[i];
        // How far what lies beyond the edge reaches over it.
        const float beyond = p.beyond != SnowCaps::kNone ? top[p.beyond] - p.base_m.y : -1.0e9f;
        const float over = std::clamp(beyond, 0.0f, fallen[i]);
        // Or how far there is one sheet over the step, where as much lies at its foot.
        const float foot = p.beyond != SnowCaps::kNone ? bare[p.beyond] - caps.points[p.beyond].base_m.y : 0.0f;
        const float closed = closing[i] > 0.0f ? closing[i] * shared::smooth_edge(0.35f, 0.8f, foot / fallen[i]) : 0.0f;
        const float open = lesser(std::min(fallen[i], kMostOverWidth * p.support_m + over), p.most_m + over);
        const float held = open + closed * std::max(sheet[i] - open, 0.0f);
        const bool rim = p.edge_m < kAtRim_m;
        const float width = width_m(p, held);
        const float s = p.edge_m / width;
        const float slot = std::clamp(2.0f * held / (kClosed * p.gap_m) - 1.0f, 0.0f, 1.0f);
        const float kept = std::max(closed, std::min(over / std::max(held, 1.0e-6f), 1.0f));
        const float round = rounded(s), round_slot = rounded(p.slot_m / width);
        // The edge of a low step is lost where the snow below it reaches half up its own.
        const float lower = p.below != SnowCaps::kNone ? std::max(bare[p.below] - p.base_m.y, 0.0f) : 0.0f;
        const float lost = shared::smooth_edge(0.0f, 0.5f, lower / std::max(held, 1.0e-6f));
        const float round_low = rounded(p.low_m / width);
        const float thickness = held * (round_low + lost * (1.0f - round_low)) * (round + kept * (1.0f - round)) * (round_slot + slot * (1.0f - round_slot));
        vec3 at = p.base_m;
        // Near an edge snow that is smoothed down still lies on what is below it.
        const float smoothed = top[i] - bare[i];
        const float filled = p.edge_m < kNearEdge_m ? glm::mix(std::max(smoothed, -kSmoothedDown * thickness), smoothed, closed) : smoothed;
        at.y += thickness - sunk_m(thickness) + filled;
        const float bridged = p.slot_m < 1.0e-3f ? slot : std::min(thickness / 0.03f, 1.0f);
        at.x += p.bridge_m.x * bridged;
        at.z += p.bridge_m.y * bridged;
        const float bank = rim && p.beyond != SnowCaps::kNone ? shared::smooth_edge(0.0f, 0.4f, closed) : 0.0f;
        if (bank > 0.0f) {
            const float step = std::max(at.y - top[p.beyond], 0.0f) + kIntoSnow_m;
            at.y -= bank * step;
            const float out = bank * std::min(step / kBankSlope, kMostOut_m);
            at.x += p.out.x * out;
            at.z += p.out.y * out;
            sunk_rim[i] = bank > 0.5f ? 1 : 0;
        } else if (rim && held > 0.0f) {
            // Its last triangles go into the stone: along its face they would be a dashed line.
            at.x -= p.out.x * kSunk_m;
            at.z -= p.out.y * kSunk_m;
        } else if (s < 1.0f && held > 0.0f) {
            const float bulge = 3.5f * std::sqrt(s) * (1.0f - s) * (1.0f - s);
            const float out = std::min(kOverhang * held, kMostOverhang_m) * bulge * (1.0f - kept);
            at.x += p.out.x * out;
            at.z += p.out.y * out;
        }
        put(i, at, thickness, held);
    }
    shape.normals.assign(count, vec3(0.0f));
    // What sinks into the snow at its foot is not seen, and bends no light at the edge.
    std::vector<std::array<std::uint32_t, 3>> sinking;
    for (std::size_t k = 0; k + 2 < drawn.triangles.size(); k += 3) {
        const std::array t{drawn.triangles[k], drawn.triangles[k + 1], drawn.triangles[k + 2]};
        if (sunk_rim[t[0]] || sunk_rim[t[1]] || sunk_rim[t[2]]) {
            sinking.push_back(t);
            continue;
        }
        const vec3 face = glm::cross(shape.positions[t[1]] - shape.positions[t[0]], shape.positions[t[2]] - shape.positions[t[0]]);
        for (const std::uint32_t i : t) shape.normals[i] += face;
    }
    for (const auto& t : sinking) {
        for (std::size_t c = 0; c < 3; ++c) {
            if (!sunk_rim[t[c]]) continue;
            for (const std::size_t o : {(c + 1) % 3, (c + 2) % 3})
                if (!sunk_rim[t[o]]) shape.normals[t[c]] += shape.normals[t[o]];
        }
    }
    for (vec3& n : shape.normals) {
        const float length = glm::length(n);
        n = length > 1.0e-12f ? n / length : vec3(0.0f, 1.0f, 0.0f);
    }
    return shape;
}

}  // namespace petrichor::scene
