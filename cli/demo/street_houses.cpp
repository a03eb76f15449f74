// House fronts with openings, roofs, chimneys, the timbered gable, the gate at the far end.
#include <algorithm>
#include <cmath>

#include "cli/demo/street_parts.h"
#include "texproc/noise.h"

namespace petrichor::cli {

using glm::vec2;
using glm::vec3;
using glm::vec4;
using texproc::hash_cell;
using texproc::hash_signed;
using texproc::hash_unit;
using texproc::smooth_step;

namespace {

struct Opening {
    float u0, u1, v0, v1;
};

// Walls are darker where rain splashes up and under the eaves.
vec4 wall_tint(float v, float height)
{
    const float splash = smooth_step(0.75f, 0.05f, v);
    const float soot = smooth_step(height - 0.5f, height, v);
    const float light = 1.0f - 0.34f * splash - 0.12f * soot;
    return {light, light * (1.0f - 0.01f * splash), light * (1.0f - 0.05f * splash), 1.0f};
}

void add_wall(Kit& kit, Slot slot, const Frame& frame, float width, float height,
              const std::vector<Opening>& openings, const vec3& tint = vec3(1.0f))
{
    std::vector<float> us = {0.0f, width};
    std::vector<float> vs = {0.0f, 0.12f, 0.4f, 0.8f, height - 0.5f, height};
    for (float u = 1.2f; u < width; u += 1.2f) us.push_back(u);
    for (const Opening& o : openings) {
        us.insert(us.end(), {o.u0, o.u1});
        vs.insert(vs.end(), {o.v0, o.v1});
    }
    const auto tidy = [](std::vector<float>& values) {
        std::sort(values.begin(), values.end());
        values.erase(std::unique(values.begin(), values.end(),
                                 [](float a, float b) { return b - a < 1e-4f; }),
                     values.end());
    };
    tidy(us);
    tidy(vs);
    MeshBuilder& wall = kit[slot];
    const vec3 axis_v(0.0f, -1.0f, 0.0f);
    for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
        for (std::size_t i = 0; i + 1 < us.size(); ++i) {
            const float u = 0.5f * (us[i] + us[i + 1]);
            const float v = 0.5f * (vs[j] + vs[j + 1]);
            const bool open = std::any_of(openings.begin(), openings.end(), [&](const Opening& o) {
                return u > o.u0 && u < o.u1 && v > o.v0 && v < o.v1;
            });
            if (open) continue;
            wall.grid(1, 1, [&](int a, int b) {
                const vec3 p = frame.at(us[i + static_cast<std::size_t>(a)], vs[j + static_cast<std::size_t>(b)]);
                return MeshBuilder::Point{p, frame.out, vec2(glm::dot(p, frame.along), glm::dot(p, axis_v)),
                                          wall_tint(vs[j + static_cast<std::size_t>(b)], height) * vec4(tint, 1.0f), vec4(1.0f)};
            });
        }
    }
}

// The sides of an opening, so deep into the wall.
void add_reveals(Kit& kit, Slot slot, const Frame& frame, const Opening& o, float depth)
{
    MeshBuilder& wall = kit[slot];
    wall.color = vec4(0.72f, 0.71f, 0.70f, 1.0f);
    wall.quad(frame.at(o.u0, o.v0), frame.at(o.u0, o.v0, -depth), frame.at(o.u0, o.v1, -depth), frame.at(o.u0, o.v1));
    wall.quad(frame.at(o.u1, o.v0, -depth), frame.at(o.u1, o.v0), frame.at(o.u1, o.v1), frame.at(o.u1, o.v1, -depth));
    wall.quad(frame.at(o.u0, o.v1, -depth), frame.at(o.u1, o.v1, -depth), frame.at(o.u1, o.v1), frame.at(o.u0, o.v1));
    wall.quad(frame.at(o.u0, o.v0), frame.at(o.u1, o.v0), frame.at(o.u1, o.v0, -depth), frame.at(o.u0, o.v0, -depth));
    wall.color = vec4(1.0f);
}

void add_box(Kit& kit, Slot slot, const Frame& frame, vec3 low, vec3 high, float bevel, int grain = 1)
{
    const vec3 middle = 0.5f * (low + high);
    kit[slot].box({.centre = frame.at(middle.x, middle.y, middle.z),
                   .half = 0.5f * (high - low),
                   .bevel_m = bevel,
                   .axes = frame.axes(),
                   .grain = grain});
}

// A pane whose texture coordinates run from 0 to 1 over it.
void add_pane(MeshBuilder& glass, const Frame& frame, const Opening& o, float d)
{
    glass.grid(1, 1, [&](int i, int j) {
        return MeshBuilder::Point{frame.at(i == 0 ? o.u0 : o.u1, j == 0 ? o.v1 : o.v0, d), frame.out,
                                  vec2(static_cast<float>(i), static_cast<float>(j))};
    });
}

struct WindowStyle {
    int panes_u = 2;
    int panes_v = 3;
    bool lit = false;
    bool lintel = true;
    bool shutters = false;
    bool flowers = false;
    float depth_m = 0.11f;
    vec4 paint{0.80f, 0.78f, 0.70f, 1.0f};
};

// A box of geraniums on the sill.
void add_flower_box(Kit& kit, const Frame& frame, const Opening& o)
{
    MeshBuilder& timber = kit[Slot::Timber];
    timber.color = vec4(0.62f, 0.60f, 0.56f, 1.0f);
    add_box(kit, Slot::Timber, frame, {o.u0 + 0.02f, o.v0 + 0.005f, 0.0f}, {o.u1 - 0.02f, o.v0 + 0.15f, 0.16f}, 0.008f, 0);
    timber.color = vec4(1.0f);
    const auto seed = static_cast<std::uint32_t>(std::lround(100.0f * (frame.origin.z + frame.origin.x + 3.0f * o.u0 + 7.0f * o.v0) + 5000.0f));
    MeshBuilder& plants = kit[Slot::Blades];
    plants.weather = vec4(1.0f, 0.0f, 0.6f, 1.0f);
    const auto count = static_cast<int>(330.0f * (o.u1 - o.u0));
    for (int k = 0; k < count; ++k) {
        const std::uint32_t h = hash_cell(k, static_cast<int>(seed), kit.seed + 90u);
        const float u = o.u0 + 0.03f + (o.u1 - o.u0 - 0.06f) * hash_unit(h, 60);
        const float mound = 0.75f + 0.25f * std::sin(9.0f * u + static_cast<float>(seed));
        const float angle = 3.14159265f * hash_unit(h, 61);
        const float r = 0.15f * mound * std::sqrt(hash_unit(h, 62));
        const vec3 at = frame.at(u, o.v0 + 0.15f + r * std::sin(angle) * 1.1f, 0.09f + r * std::cos(angle));
        const vec3 outward = glm::normalize(frame.out * std::cos(angle) + vec3(0.0f, 0.4f + std::sin(angle), 0.0f));
        const bool flower = r > 0.075f && hash_unit(h, 63) > 0.55f;
        const vec3 green = glm::mix(vec3(0.05f, 0.12f, 0.03f), vec3(0.12f, 0.20f, 0.05f), hash_unit(h, 64));
        const vec3 red = glm::mix(vec3(0.52f, 0.020f, 0.022f), vec3(0.62f, 0.07f, 0.10f), hash_unit(h, 64));
        add_leaf(plants, at, outward, flower ? 0.062f : 0.070f, h, flower ? red : green * (0.45f + 3.5f * r));
    }
    plants.color = vec4(1.0f);
    plants.weather = vec4(1.0f);
}

void add_window(Kit& kit, Slot wall, const Frame& frame, const Opening& o, const WindowStyle& style)
{
    add_reveals(kit, wall, frame, o, style.depth_m);
    const float back = -style.depth_m + 0.012f;
    add_pane(kit[style.lit ? Slot::LitGlass : Slot::Glass], frame, o, back);

    constexpr float kStile = 0.055f;
    MeshBuilder& paint = kit[Slot::Painted];
    paint.color = style.paint;
    const float front = back + 0.045f;
    add_box(kit, Slot::Painted, frame, {o.u0, o.v0, back - 0.01f}, {o.u0 + kStile, o.v1, front}, 0.008f);
    add_box(kit, Slot::Painted, frame, {o.u1 - kStile, o.v0, back - 0.01f}, {o.u1, o.v1, front}, 0.008f);
    add_box(kit, Slot::Painted, frame, {o.u0, o.v0, back - 0.01f}, {o.u1, o.v0 + kStile * 1.3f, front}, 0.008f, 0);
    add_box(kit, Slot::Painted, frame, {o.u0, o.v1 - kStile, back - 0.01f}, {o.u1, o.v1, front}, 0.008f, 0);
    for (int i = 1; i < style.panes_u; ++i) {
        const float u = o.u0 + (o.u1 - o.u0) * static_cast<float>(i) / static_cast<float>(style.panes_u);
        const float w = style.panes_u == 2 ? 0.032f : 0.018f;
        add_box(kit, Slot::Painted, frame, {u - w, o.v0, back - 0.01f}, {u + w, o.v1, front - 0.006f}, 0.006f);
    }
    for (int j = 1; j < style.panes_v; ++j) {
        const float v = o.v0 + (o.v1 - o.v0) * static_cast<float>(j) / static_cast<float>(style.panes_v);
        add_box(kit, Slot::Painted, frame, {o.u0, v - 0.013f, back - 0.01f}, {o.u1, v + 0.013f, front - 0.014f}, 0.005f, 0);
    }
    paint.color = vec4(1.0f);

    // The sill stone: a ledge for snow.
    add_box(kit, Slot::Granite, frame, {o.u0 - 0.07f, o.v0 - 0.085f, -style.depth_m}, {o.u1 + 0.07f, o.v0 + 0.004f, 0.085f}, 0.012f, 0);
    if (style.lintel) {
        add_box(kit, Slot::Granite, frame, {o.u0 - 0.12f, o.v1 - 0.003f, -0.10f}, {o.u1 + 0.12f, o.v1 + 0.20f, 0.016f}, 0.008f, 0);
    }
    if (style.flowers) add_flower_box(kit, frame, o);
    if (style.shutters) {
        paint.color = vec4(0.10f, 0.19f, 0.155f, 1.0f);
        const float w = 0.5f * (o.u1 - o.u0);
        for (const float s : {-1.0f, 1.0f}) {
            const float edge = s < 0.0f ? o.u0 - 0.03f : o.u1 + 0.03f;
            const float low = std::min(edge, edge + s * w);
            const float high = std::max(edge, edge + s * w);
            add_box(kit, Slot::Painted, frame, {low, o.v0, 0.012f}, {high, o.v1, 0.040f}, 0.008f);
            for (const float t : {0.14f, 0.86f}) {
                const float v = o.v0 + t * (o.v1 - o.v0);
                add_box(kit, Slot::Painted, frame, {low + 0.02f, v - 0.05f, 0.038f}, {high - 0.02f, v + 0.05f, 0.055f}, 0.006f, 0);
            }
        }
        paint.color = vec4(1.0f);
    }
}

void add_door(Kit& kit, Slot wall, const Frame& frame, const Opening& o, const vec4& color)
{
    constexpr float kDepth = 0.20f;
    add_reveals(kit, wall, frame, o, kDepth);
    MeshBuilder& paint = kit[Slot::Painted];
    const float split = o.v1 - 0.42f;  // a light above the leaf
    const float back = -kDepth + 0.01f;
    add_pane(kit[Slot::LitGlass], frame, {o.u0, o.u1, split, o.v1}, back);
    paint.color = vec4(0.80f, 0.78f, 0.70f, 1.0f);
    for (const float u : {o.u0 + 0.04f, o.u1 - 0.04f}) {
        add_box(kit, Slot::Painted, frame, {u - 0.04f, o.v0, back}, {u + 0.04f, o.v1, back + 0.09f}, 0.010f);
    }
    add_box(kit, Slot::Painted, frame, {o.u0, o.v1 - 0.06f, back}, {o.u1, o.v1, back + 0.09f}, 0.010f, 0);
    add_box(kit, Slot::Painted, frame, {o.u0, split - 0.05f, back}, {o.u1, split + 0.02f, back + 0.10f}, 0.010f, 0);
    for (const float t : {1.0f / 3.0f, 2.0f / 3.0f}) {
        const float u = o.u0 + t * (o.u1 - o.u0);
        add_box(kit, Slot::Painted, frame, {u - 0.012f, split, back}, {u + 0.012f, o.v1, back + 0.04f}, 0.005f);
    }
    paint.color = color;
    const float left = o.u0 + 0.08f;
    const float right = o.u1 - 0.08f;
    add_box(kit, Slot::Painted, frame, {left, o.v0 + 0.02f, back}, {right, split - 0.05f, back + 0.045f}, 0.004f);
    const float middle = 0.5f * (left + right);
    const float rows[] = {o.v0 + 0.16f, o.v0 + 0.78f, split - 0.15f};
    for (int j = 0; j < 2; ++j) {
        for (const float s : {-1.0f, 1.0f}) {
            const float u0 = s < 0.0f ? left + 0.09f : middle + 0.04f;
            const float u1 = s < 0.0f ? middle - 0.04f : right - 0.09f;
            add_box(kit, Slot::Painted, frame, {u0, rows[j] + 0.05f, back + 0.03f}, {u1, rows[j + 1] - 0.05f, back + 0.062f}, 0.020f);
        }
    }
    paint.color = vec4(1.0f);
    MeshBuilder& iron = kit[Slot::Iron];
    iron.tube({frame.at(right - 0.06f, o.v0 + 1.02f, back + 0.05f), frame.at(right - 0.06f, o.v0 + 1.02f, back + 0.10f),
               frame.at(right - 0.17f, o.v0 + 1.02f, back + 0.10f)}, 0.009f, 8);
    // A worn step.
    add_box(kit, Slot::Granite, frame, {o.u0 - 0.10f, -0.02f, -kDepth}, {o.u1 + 0.10f, o.v0 + 0.01f, 0.26f}, 0.022f, 0);
    add_box(kit, Slot::Granite, frame, {o.u0 - 0.14f, o.v1 - 0.003f, -0.12f}, {o.u1 + 0.14f, o.v1 + 0.24f, 0.022f}, 0.010f, 0);
}

// A roof with its ridge along the wall's direction, on a house that stands behind `frame`.
struct Roof {
    float width;      ///< along the wall
    float depth;      ///< of the house
    float eave_v;
    float rise;
    float overhang = 0.32f;
};

void add_roof(Kit& kit, const Frame& frame, const Roof& roof)
{
    MeshBuilder& tiles = kit[Slot::RoofTile];
    const float half = 0.5f * roof.depth;
    const float slope = roof.rise / half;
    const float drop = roof.overhang * slope;
    constexpr float kVerge = 0.18f;
    constexpr float kThick = 0.05f;
    const vec3 up_front = glm::normalize(-frame.out + vec3(0.0f, slope, 0.0f));
    const vec3 up_back = glm::normalize(frame.out + vec3(0.0f, slope, 0.0f));
    const float ridge_v = roof.eave_v + roof.rise;
    const vec3 lift(0.0f, kThick, 0.0f);
    const vec3 a = frame.at(-kVerge, roof.eave_v - drop, roof.overhang);
    const vec3 b = frame.at(roof.width + kVerge, roof.eave_v - drop, roof.overhang);
    const vec3 c = frame.at(roof.width + kVerge, ridge_v, -half);
    const vec3 d = frame.at(-kVerge, ridge_v, -half);
    const vec3 e = frame.at(-kVerge, roof.eave_v - drop, -roof.depth - roof.overhang);
    const vec3 f = frame.at(roof.width + kVerge, roof.eave_v - drop, -roof.depth - roof.overhang);
    // Long slopes are cut into bands: the roof sags a little between its rafters.
    tiles.grid(static_cast<int>(roof.width / 0.8f), 3, [&](int i, int j) {
        const float s = static_cast<float>(i) / std::floor(roof.width / 0.8f);
        const float t = static_cast<float>(j) / 3.0f;
        const std::uint32_t h = hash_cell(i, j, kit.seed + 77u + static_cast<std::uint32_t>(std::lround(std::abs(frame.origin.z) * 10.0f)));
        const vec3 flat = glm::mix(glm::mix(a, b, s), glm::mix(d, c, s), t) + lift;
        const vec3 n = glm::normalize(glm::cross(b - a, d - a));
        return MeshBuilder::Point{flat + n * (0.012f * hash_signed(h, 1) - 0.03f * std::sin(3.14159f * t) * std::sin(3.14159f * s)), n,
                                  vec2(glm::dot(flat, frame.along), -glm::dot(flat, up_front)), vec4(1.0f), vec4(1.0f)};
    });
    tiles.quad(f + lift, e + lift, d + lift, c + lift, up_back);
    MeshBuilder& timber = kit[Slot::Timber];
    timber.color = vec4(0.7f, 0.7f, 0.7f, 1.0f);
    timber.quad(b, a, d, c, frame.along);
    timber.quad(e, f, c, d, frame.along);
    timber.color = vec4(1.0f);
    // Tile edge along the eaves and bargeboards along the verges.
    tiles.quad(a - 0.4f * lift, b - 0.4f * lift, b + lift, a + lift);
    timber.beam(a - 0.6f * lift, d - 0.6f * lift, 0.035f, 0.16f, 0.006f, vec3(0, 1, 0));
    timber.beam(b - 0.6f * lift, c - 0.6f * lift, 0.035f, 0.16f, 0.006f, vec3(0, 1, 0));
    timber.beam(e - 0.6f * lift, d - 0.6f * lift, 0.035f, 0.16f, 0.006f, vec3(0, 1, 0));
    timber.beam(f - 0.6f * lift, c - 0.6f * lift, 0.035f, 0.16f, 0.006f, vec3(0, 1, 0));
    // Ridge tiles, overlapping.
    const int count = static_cast<int>((roof.width + 2.0f * kVerge) / 0.38f);
    const float step = (roof.width + 2.0f * kVerge) / static_cast<float>(count);
    for (int i = 0; i < count; ++i) {
        const std::uint32_t h = hash_cell(i, 5, kit.seed + 78u);
        const float light = 0.8f + 0.2f * hash_unit(h, 1);
        tiles.color = vec4(light, light, light, 1.0f);
        const float u = -kVerge + step * static_cast<float>(i);
        const float v = ridge_v + kThick - 0.06f + 0.008f * hash_signed(h, 2);
        tiles.tube({frame.at(u - 0.03f, v + 0.012f, -half), frame.at(u + step, v, -half)}, {0.125f, 0.115f}, 10);
    }
    tiles.color = vec4(1.0f);
    // Rain gutter along the front.
    const float gutter_v = roof.eave_v - drop - 0.045f;
    kit[Slot::Zinc].tube({frame.at(-kVerge, gutter_v, roof.overhang + 0.05f),
                          frame.at(roof.width + kVerge, gutter_v, roof.overhang + 0.05f)}, 0.062f, 10);
}

// A pipe from the rain gutter down the wall.
void add_downpipe(Kit& kit, const Frame& frame, float u, float eave_v, float overhang, float bottom_v)
{
    MeshBuilder& zinc = kit[Slot::Zinc];
    zinc.tube({frame.at(u, eave_v - 0.03f, overhang + 0.03f), frame.at(u, eave_v - 0.16f, overhang),
               frame.at(u, eave_v - 0.48f, 0.10f), frame.at(u, eave_v - 0.60f, 0.075f), frame.at(u, bottom_v + 0.14f, 0.075f),
               frame.at(u, bottom_v + 0.05f, 0.10f), frame.at(u, bottom_v, 0.17f)}, 0.042f, 12);
    for (float v = bottom_v + 0.5f; v < eave_v - 0.6f; v += 1.5f) {
        zinc.tube({frame.at(u, v, 0.075f), frame.at(u, v + 0.035f, 0.075f)}, 0.050f, 12);
        add_box(kit, Slot::Iron, frame, {u - 0.012f, v + 0.008f, -0.02f}, {u + 0.012f, v + 0.03f, 0.04f}, 0.0f);
    }
}

void add_chimney(Kit& kit, const vec3& foot, float height)
{
    MeshBuilder& brick = kit[Slot::Brick];
    brick.color = vec4(0.75f, 0.72f, 0.70f, 1.0f);
    brick.box({.centre = foot + vec3(0.0f, 0.5f * height, 0.0f), .half = vec3(0.34f, 0.5f * height, 0.45f), .bevel_m = 0.01f});
    brick.box({.centre = foot + vec3(0.0f, height - 0.20f, 0.0f), .half = vec3(0.39f, 0.075f, 0.50f), .bevel_m = 0.01f});
    brick.color = vec4(1.0f);
    kit[Slot::Granite].box({.centre = foot + vec3(0.0f, height + 0.03f, 0.0f), .half = vec3(0.42f, 0.045f, 0.53f), .bevel_m = 0.015f});
    for (const float s : {-1.0f, 1.0f}) {
        kit[Slot::RoofTile].lathe(foot + vec3(0.0f, height + 0.06f, 0.22f * s),
                                  {{0.13f, 0.0f}, {0.12f, 0.05f}, {0.10f, 0.32f}, {0.115f, 0.35f}, {0.115f, 0.39f}, {0.085f, 0.40f}, {0.08f, 0.2f}}, 12);
    }
}

// The gable triangle above a wall.
void add_gable(Kit& kit, Slot slot, const vec3& a, const vec3& b, const vec3& top)
{
    kit[slot].triangle(a, b, top);
}

void add_brick_house(Kit& kit)
{
    constexpr float kStart = kNear + 0.2f;
    constexpr float kEnd = -5.7f;
    constexpr float kWidth = kStart - kEnd;
    constexpr float kEave = 5.35f;
    constexpr float kDepth = 5.8f;
    // u runs away from the viewer: u = kStart - z.
    const Frame front{vec3(kLeftWall, 0.0f, kStart), vec3(0, 0, -1), vec3(1, 0, 0)};
    const auto u = [&](float z) { return kStart - z; };
    const Opening door{u(0.55f), u(-0.50f), 0.27f, 2.62f};
    const Opening shop{u(-1.95f), u(-4.35f), 0.86f, 2.30f};
    const Opening low[] = {{u(3.1f), u(1.9f), 1.05f, 2.55f}, {u(6.4f), u(5.2f), 1.05f, 2.55f}};
    std::vector<Opening> openings = {door, shop, low[0], low[1]};
    std::vector<Opening> upper;
    for (const float z : {6.4f, 3.1f, 0.62f, -1.75f, -3.95f}) upper.push_back({u(z), u(z - 1.15f), 3.30f, 4.72f});
    openings.insert(openings.end(), upper.begin(), upper.end());
    add_wall(kit, Slot::Brick, front, kWidth, kEave, openings);
    add_door(kit, Slot::Brick, front, door, vec4(0.085f, 0.14f, 0.19f, 1.0f));
    add_window(kit, Slot::Brick, front, shop, {.panes_u = 4, .panes_v = 2, .lit = true, .paint = vec4(0.085f, 0.14f, 0.19f, 1.0f)});
    for (const Opening& o : low) add_window(kit, Slot::Brick, front, o, {});
    for (std::size_t i = 0; i < upper.size(); ++i) {
        add_window(kit, Slot::Brick, front, upper[i], {.lit = i == 3, .flowers = i >= 3});
    }
    // A string course between the floors, and a plinth.
    add_box(kit, Slot::Granite, front, {0.0f, 2.98f, -0.05f}, {kWidth, 3.10f, 0.05f}, 0.012f, 0);
    const float plinth[] = {0.0f, door.u0 - 0.1f, door.u1 + 0.1f, kWidth};
    for (const int k : {0, 2}) {
        add_box(kit, Slot::Granite, front, {plinth[k], -0.05f, -0.05f}, {plinth[k + 1], 0.34f, 0.035f}, 0.014f, 0);
    }

    MeshBuilder& brick = kit[Slot::Brick];
    for (const float z : {kStart, kEnd}) {
        const bool near_side = z == kStart;
        const vec3 a(kLeftWall, 0.0f, z), b(kLeftWall - kDepth, 0.0f, z);
        const vec3 up(0.0f, kEave, 0.0f);
        const vec3 top(kLeftWall - 0.5f * kDepth, kEave + 3.0f, z);
        if (near_side) {
            brick.quad(b, a, a + up, b + up);
            add_gable(kit, Slot::Brick, b + up, a + up, top);
        } else {
            brick.quad(a, b, b + up, a + up);
            add_gable(kit, Slot::Brick, a + up, b + up, top);
        }
    }
    brick.quad(vec3(kLeftWall - kDepth, 0, kEnd), vec3(kLeftWall - kDepth, 0, kStart), vec3(kLeftWall - kDepth, kEave, kStart), vec3(kLeftWall - kDepth, kEave, kEnd));
    add_roof(kit, front, {.width = kWidth, .depth = kDepth, .eave_v = kEave, .rise = 3.0f});
    add_downpipe(kit, front, u(1.02f), kEave - 0.33f, 0.36f, 1.05f);
    add_downpipe(kit, front, u(-5.52f), kEave - 0.33f, 0.36f, 0.22f);
    add_chimney(kit, vec3(kLeftWall - 2.2f, kEave + 1.6f, -4.6f), 2.6f);
    add_chimney(kit, vec3(kLeftWall - 2.2f, kEave + 1.6f, 1.5f), 2.6f);
}

void add_plaster_house(Kit& kit)
{
    constexpr float kStart = -5.7f;
    constexpr float kWidth = kStart - kGate;
    constexpr float kEave = 4.55f;
    constexpr float kDepth = 5.0f;
    const Frame front{vec3(kLeftWall - 0.12f, 0.0f, kStart), vec3(0, 0, -1), vec3(1, 0, 0)};
    const Opening door{0.55f, 1.50f, 0.22f, 2.36f};
    std::vector<Opening> windows = {{2.25f, 3.35f, 1.0f, 2.35f}, {0.65f, 1.55f, 3.0f, 4.15f}, {2.45f, 3.35f, 3.0f, 4.15f}};
    std::vector<Opening> openings = windows;
    openings.push_back(door);
    const vec3 kRose(1.0f, 0.80f, 0.66f);
    add_wall(kit, Slot::Plaster, front, kWidth, kEave, openings, kRose);
    add_door(kit, Slot::Plaster, front, door, vec4(0.20f, 0.055f, 0.035f, 1.0f));
    for (std::size_t i = 0; i < windows.size(); ++i) {
        add_window(kit, Slot::Plaster, front, windows[i], {.lit = i == 0, .lintel = false, .shutters = i > 0, .flowers = i > 0});
    }
    MeshBuilder& plaster = kit[Slot::Plaster];
    plaster.color = vec4(kRose, 1.0f);
    const vec3 up(0.0f, kEave, 0.0f);
    const vec3 a(front.origin), b(front.origin - vec3(kDepth, 0, 0));
    plaster.quad(b, a, a + up, b + up);
    add_gable(kit, Slot::Plaster, b + up, a + up, 0.5f * (a + b) + vec3(0.0f, kEave + 2.6f, 0.0f));
    plaster.color = vec4(1.0f);
    add_roof(kit, front, {.width = kWidth, .depth = kDepth, .eave_v = kEave, .rise = 2.6f});
    add_chimney(kit, front.origin + vec3(-1.6f, kEave + 1.2f, -3.4f), 2.4f);
}

void add_beam(Kit& kit, const Frame& frame, vec2 from, vec2 to, float width, float proud = 0.022f)
{
    // Sunk into the plaster so that only `proud` shows.
    const std::uint32_t h = hash_cell(static_cast<int>(std::lround(from.x * 100.0f)), static_cast<int>(std::lround(to.y * 100.0f)), kit.seed + 9u);
    MeshBuilder& timber = kit[Slot::Timber];
    const float light = 0.36f + 0.22f * hash_unit(h, 1);
    timber.color = vec4(light, light * 0.97f, light * 0.94f, 1.0f);
    timber.uv_offset_m = vec2(0.15f * std::floor(8.0f * hash_unit(h, 2)) + 0.075f, hash_unit(h, 3));
    timber.beam(frame.at(from.x, from.y, proud - 0.06f), frame.at(to.x, to.y, proud - 0.06f), width, 0.12f, 0.010f, frame.out);
    timber.uv_offset_m = vec2(0.0f);
    timber.color = vec4(1.0f);
}

// Posts, rails and braces over a rectangle of plaster.
void add_timber_frame(Kit& kit, const Frame& frame, float width, float v0, float v1, int bays, bool braces)
{
    constexpr float kPost = 0.17f;
    add_beam(kit, frame, {0.0f, v0 + 0.5f * kPost}, {width, v0 + 0.5f * kPost}, kPost, 0.03f);
    add_beam(kit, frame, {0.0f, v1 - 0.5f * kPost}, {width, v1 - 0.5f * kPost}, kPost, 0.03f);
    for (int i = 0; i <= bays; ++i) {
        const float u = 0.5f * kPost + (width - kPost) * static_cast<float>(i) / static_cast<float>(bays);
        add_beam(kit, frame, {u, v0 + kPost}, {u, v1 - kPost}, i == 0 || i == bays ? kPost : 0.14f, 0.026f);
    }
    const float rail = v0 + 0.42f * (v1 - v0);
    add_beam(kit, frame, {kPost, rail}, {width - kPost, rail}, 0.12f, 0.018f);
    if (!braces) return;
    const float bay = (width - kPost) / static_cast<float>(bays);
    add_beam(kit, frame, {kPost + 0.02f, v0 + kPost}, {bay + 0.02f, v1 - kPost - 0.1f}, 0.13f, 0.022f);
    add_beam(kit, frame, {width - kPost - 0.02f, v0 + kPost}, {width - bay - 0.02f, v1 - kPost - 0.1f}, 0.13f, 0.022f);
}

void add_timber_house(Kit& kit)
{
    constexpr float kWidth = kGarden - kGate;  // along the street
    constexpr float kDepth = 5.2f;
    constexpr float kFloor = 2.55f;
    constexpr float kEave = 4.95f;
    constexpr float kJetty = 0.32f;
    // u runs towards the viewer here: the street side looks to -x.
    const Frame ground{vec3(kRightWall, 0.0f, kGate), vec3(0, 0, 1), vec3(-1, 0, 0)};
    const Frame upper{vec3(kRightWall - kJetty, 0.0f, kGate), vec3(0, 0, 1), vec3(-1, 0, 0)};
    const Opening door{4.6f, 5.55f, 0.22f, 2.25f};
    const Opening low[] = {{1.0f, 2.1f, 0.95f, 2.15f}, {2.85f, 3.95f, 0.95f, 2.15f}, {6.25f, 7.35f, 0.95f, 2.15f}};
    add_wall(kit, Slot::Plaster, ground, kWidth, kFloor, {door, low[0], low[1], low[2]});
    add_door(kit, Slot::Plaster, ground, door, vec4(0.055f, 0.10f, 0.06f, 1.0f));
    const vec4 white(0.72f, 0.70f, 0.64f, 1.0f);
    for (int i = 0; i < 3; ++i) {
        add_window(kit, Slot::Plaster, ground, low[i], {.lit = i == 2, .lintel = false, .paint = white});
    }
    add_box(kit, Slot::Granite, ground, {0.0f, -0.05f, -0.05f}, {door.u0 - 0.1f, 0.42f, 0.04f}, 0.016f, 0);
    add_box(kit, Slot::Granite, ground, {door.u1 + 0.1f, -0.05f, -0.05f}, {kWidth, 0.42f, 0.04f}, 0.016f, 0);

    // Openings of the upper floor lie between the posts of its frame.
    std::vector<Opening> top;
    constexpr int kBays = 7;
    constexpr float kBay = (kWidth - 0.17f) / kBays;
    for (const int bay : {1, 3, 5}) {
        const float u0 = 0.085f + kBay * static_cast<float>(bay) + 0.085f;
        top.push_back({u0, u0 + kBay - 0.17f, kFloor + 1.02f, kEave - 0.25f});
    }
    Frame upper_wall = upper;
    upper_wall.origin.y = kFloor;
    std::vector<Opening> shifted = top;
    for (Opening& o : shifted) {
        o.v0 -= kFloor;
        o.v1 -= kFloor;
    }
    add_wall(kit, Slot::Plaster, upper_wall, kWidth, kEave - kFloor, shifted);
    for (std::size_t i = 0; i < shifted.size(); ++i) {
        add_window(kit, Slot::Plaster, upper_wall, shifted[i], {.panes_u = 2, .panes_v = 2, .lit = i == 1, .lintel = false, .depth_m = 0.07f, .paint = white});
    }
    add_timber_frame(kit, upper, kWidth, kFloor, kEave, kBays, true);
    // The jetty: joist ends under the upper floor.
    kit[Slot::Timber].quad(upper.at(0.0f, kFloor), ground.at(0.0f, kFloor), ground.at(kWidth, kFloor), upper.at(kWidth, kFloor), vec3(1, 0, 0));
    for (float u = 0.25f; u < kWidth; u += 0.62f) {
        kit[Slot::Timber].color = vec4(0.50f, 0.48f, 0.46f, 1.0f);
        add_box(kit, Slot::Timber, upper, {u, kFloor - 0.14f, -kJetty - 0.1f}, {u + 0.14f, kFloor + 0.02f, 0.05f}, 0.012f, 2);
    }

    kit[Slot::Timber].color = vec4(1.0f);

    // The gable towards the garden.
    const Frame gable{vec3(kRightWall - kJetty, 0.0f, kGarden), vec3(1, 0, 0), vec3(0, 0, 1)};
    constexpr float kGableWidth = kDepth + kJetty;
    const Opening gable_low{2.9f, 4.0f, 0.95f, 2.15f};
    const Opening gable_top{2.15f, 3.15f, kFloor + 1.02f, kEave - 0.25f};
    Frame low_wall = gable;
    low_wall.origin.x += kJetty;
    add_wall(kit, Slot::Plaster, low_wall, kDepth, kFloor, {gable_low});
    add_window(kit, Slot::Plaster, low_wall, gable_low, {.lintel = false, .paint = white});
    add_box(kit, Slot::Granite, low_wall, {0.0f, -0.05f, -0.05f}, {kDepth, 0.42f, 0.04f}, 0.016f, 0);
    Frame high_wall = gable;
    high_wall.origin.y = kFloor;
    const Opening high{gable_top.u0, gable_top.u1, gable_top.v0 - kFloor, gable_top.v1 - kFloor};
    add_wall(kit, Slot::Plaster, high_wall, kGableWidth, kEave - kFloor, {high});
    add_window(kit, Slot::Plaster, high_wall, high, {.panes_v = 2, .lit = false, .lintel = false, .depth_m = 0.07f, .paint = white});
    add_timber_frame(kit, gable, kGableWidth, kFloor, kEave, 5, true);
    const float rise = 2.9f;
    const vec3 apex = gable.at(0.5f * kGableWidth, kEave + rise);
    add_gable(kit, Slot::Plaster, gable.at(0.0f, kEave), gable.at(kGableWidth, kEave), apex);
    const float half = 0.5f * kGableWidth;
    add_beam(kit, gable, {0.1f, kEave + 0.06f}, {half, kEave + rise - 0.05f}, 0.15f, 0.03f);
    add_beam(kit, gable, {kGableWidth - 0.1f, kEave + 0.06f}, {half, kEave + rise - 0.05f}, 0.15f, 0.03f);
    add_beam(kit, gable, {half, kEave}, {half, kEave + rise - 0.15f}, 0.14f, 0.026f);
    add_beam(kit, gable, {0.5f * half, kEave + 0.42f * rise}, {1.5f * half, kEave + 0.42f * rise}, 0.12f, 0.022f);
    for (const float s : {-1.0f, 1.0f}) {
        add_beam(kit, gable, {half + 0.5f * s * half, kEave}, {half + 0.5f * s * half, kEave + 0.42f * rise}, 0.12f, 0.022f);
    }
    Frame roof_frame = upper;
    add_roof(kit, roof_frame, {.width = kWidth, .depth = kGableWidth, .eave_v = kEave, .rise = rise});
    MeshBuilder& plaster = kit[Slot::Plaster];
    const vec3 back = vec3(kRightWall + kDepth, 0.0f, 0.0f);
    plaster.quad(vec3(back.x, 0, kGarden), vec3(back.x, 0, kGate), vec3(back.x, kEave, kGate), vec3(back.x, kEave, kGarden));
    add_chimney(kit, vec3(kRightWall + 2.6f, kEave + 2.2f, -5.5f), 2.0f);
    add_downpipe(kit, upper, kWidth - 0.1f, kEave - 0.34f, 0.36f, 2.70f);
    add_downpipe(kit, ground, kWidth - 0.12f, kFloor + 0.3f, 0.25f, 0.22f);
}

}  // namespace

void add_houses(Kit& kit)
{
    add_brick_house(kit);
    add_plaster_house(kit);
    add_timber_house(kit);
    // The house that closes the view beyond the gate, and the walls that lead to it.
    const Frame end{vec3(-5.0f, 0.0f, kFar), vec3(1, 0, 0), vec3(0, 0, 1)};
    const Opening windows[] = {{3.4f, 4.3f, 1.0f, 2.3f}, {5.9f, 6.8f, 1.0f, 2.3f}, {3.4f, 4.3f, 3.2f, 4.4f}, {5.9f, 6.8f, 3.2f, 4.4f}};
    add_wall(kit, Slot::Plaster, end, 10.0f, 5.0f, {windows[0], windows[1], windows[2], windows[3]}, vec3(0.92f, 0.93f, 0.90f));
    for (int i = 0; i < 4; ++i) add_window(kit, Slot::Plaster, end, windows[i], {.lit = i == 1, .lintel = false, .shutters = true});
    add_roof(kit, end, {.width = 10.0f, .depth = 5.0f, .eave_v = 5.0f, .rise = 3.0f});
    for (const float side : {-1.0f, 1.0f}) {
        kit[Slot::Cobble].box({.centre = vec3(4.2f * side, 0.9f, 0.5f * (kGate - 1.8f + kFar)),
                               .half = vec3(0.25f, 0.95f, 0.5f * (kGate - 1.8f - kFar)), .bevel_m = 0.02f});
        kit[Slot::Granite].box({.centre = vec3(4.2f * side, 1.90f, 0.5f * (kGate - 1.8f + kFar)),
                                .half = vec3(0.32f, 0.06f, 0.5f * (kGate - 1.8f - kFar)), .bevel_m = 0.02f});
    }
}

namespace {

// A timbered turret with a clock on the gate; a pyramid of tiles, a ball and a vane on top.
void add_clock_turret(Kit& kit, const vec3& foot)
{
    constexpr float kHalf = 0.72f;
    constexpr float kWall = 1.55f;
    kit[Slot::Plaster].box({.centre = foot + vec3(0.0f, 0.5f * kWall, 0.0f), .half = vec3(kHalf, 0.5f * kWall, kHalf)});
    MeshBuilder& timber = kit[Slot::Timber];
    timber.color = vec4(0.50f, 0.48f, 0.46f, 1.0f);
    for (const float sx : {-1.0f, 1.0f}) {
        for (const float sz : {-1.0f, 1.0f}) {
            timber.box({.centre = foot + vec3(sx * (kHalf - 0.05f), 0.5f * kWall, sz * (kHalf - 0.05f)), .half = vec3(0.085f, 0.5f * kWall, 0.085f), .bevel_m = 0.012f});
        }
    }
    for (const float v : {0.10f, kWall - 0.07f}) {
        timber.box({.centre = foot + vec3(0.0f, v, 0.0f), .half = vec3(kHalf + 0.04f, 0.07f, kHalf + 0.04f), .bevel_m = 0.012f, .grain = 0});
    }
    timber.color = vec4(1.0f);
    // The clock: a white face, an iron ring, marks and two hands at ten past ten.
    const vec3 face = foot + vec3(0.0f, 0.86f, kHalf + 0.01f);
    const glm::mat3 forward(vec3(1, 0, 0), vec3(0, 0, 1), vec3(0, -1, 0));
    kit[Slot::Painted].color = vec4(0.80f, 0.77f, 0.68f, 1.0f);
    kit[Slot::Painted].lathe(face, {{0.50f, 0.0f}, {0.50f, 0.03f}, {0.0f, 0.03f}}, 40, forward);
    kit[Slot::Painted].color = vec4(1.0f);
    MeshBuilder& iron = kit[Slot::Iron];
    iron.lathe(face, {{0.54f, 0.0f}, {0.54f, 0.05f}, {0.52f, 0.065f}, {0.49f, 0.06f}, {0.485f, 0.03f}}, 40, forward);
    const auto hand = [&](float turns, float from, float to, float width) {
        const float angle = 6.2831853f * turns;
        const vec3 d(std::sin(angle), std::cos(angle), 0.0f);
        iron.beam(face + vec3(0, 0, 0.045f) + from * d, face + vec3(0, 0, 0.045f) + to * d, width, 0.012f, 0.002f, vec3(0, 0, 1));
    };
    for (int k = 0; k < 12; ++k) hand(static_cast<float>(k) / 12.0f, k % 3 == 0 ? 0.36f : 0.40f, 0.46f, k % 3 == 0 ? 0.035f : 0.022f);
    hand(10.17f / 12.0f, -0.06f, 0.27f, 0.035f);
    hand(10.0f / 60.0f, -0.08f, 0.41f, 0.026f);

    MeshBuilder& tiles = kit[Slot::RoofTile];
    constexpr float kEaves = kHalf + 0.22f;
    const vec3 apex = foot + vec3(0.0f, kWall + 1.25f, 0.0f);
    for (int side = 0; side < 4; ++side) {
        const float angle = 1.5707963f * static_cast<float>(side);
        const vec3 n(std::sin(angle), 0.0f, std::cos(angle));
        const vec3 t(std::cos(angle), 0.0f, -std::sin(angle));
        const vec3 low = foot + vec3(0.0f, kWall - 0.12f, 0.0f);
        tiles.triangle(low + kEaves * (n - t), low + kEaves * (n + t), apex);
        kit[Slot::Timber].quad(low + kEaves * (n - t) - vec3(0, 0.05f, 0), low + kEaves * (n + t) - vec3(0, 0.05f, 0), low + kEaves * (n + t), low + kEaves * (n - t));
        tiles.tube({low + kEaves * (n + t) + vec3(0, 0.02f, 0), apex}, {0.055f, 0.05f}, 8);
    }
    const vec3 under = foot + vec3(0.0f, kWall - 0.17f, 0.0f);
    kit[Slot::Timber].quad(under + kEaves * vec3(-1, 0, -1), under + kEaves * vec3(1, 0, -1), under + kEaves * vec3(1, 0, 1), under + kEaves * vec3(-1, 0, 1));
    MeshBuilder& copper = kit[Slot::Awning];
    copper.lathe(apex - vec3(0, 0.1f, 0), {{0.11f, 0.0f}, {0.05f, 0.12f}, {0.04f, 0.20f}, {0.075f, 0.24f}, {0.09f, 0.29f}, {0.075f, 0.34f}, {0.02f, 0.38f}, {0.012f, 0.62f}, {0.0f, 0.64f}}, 14);
    iron.beam(apex + vec3(-0.20f, 0.42f, 0.0f), apex + vec3(0.22f, 0.42f, 0.0f), 0.02f, 0.012f, 0.003f, vec3(0, 0, 1));
    iron.triangle(apex + vec3(-0.36f, 0.52f, 0.0f), apex + vec3(-0.36f, 0.32f, 0.0f), apex + vec3(-0.14f, 0.42f, 0.0f), vec3(0, 1, 0));
    iron.triangle(apex + vec3(-0.36f, 0.32f, 0.0f), apex + vec3(-0.36f, 0.52f, 0.0f), apex + vec3(-0.14f, 0.42f, 0.0f), vec3(0, 1, 0));
}

}  // namespace

void add_gate(Kit& kit)
{
    // A gatehouse over the street: a round arch in a brick wall, a steep roof.
    constexpr float kLeft = kLeftWall - 0.9f;
    constexpr float kRight = kRightWall + 0.6f;
    constexpr float kCentre = -0.25f;
    constexpr float kRadius = 1.70f;
    constexpr float kSpring = 1.60f;
    constexpr float kTop = 4.35f;
    constexpr float kDepth = 1.8f;
    constexpr int kSegments = 16;
    const auto arc = [&](int i, float radius) {
        const float angle = 3.14159265f * (1.0f - static_cast<float>(i) / kSegments);
        return vec2(kCentre + radius * std::cos(angle), kSpring + radius * std::sin(angle));
    };
    MeshBuilder& wall = kit[Slot::Brick];
    for (const float z : {kGate, kGate - kDepth}) {
        const bool front = z == kGate;
        const auto face = [&](vec2 a, vec2 b, vec2 c, vec2 d) {  // counter-clockwise from the front
            if (front) {
                wall.quad(vec3(a, z), vec3(b, z), vec3(c, z), vec3(d, z));
            } else {
                wall.quad(vec3(b, z), vec3(a, z), vec3(d, z), vec3(c, z));
            }
        };
        face({kLeft, 0.0f}, {kCentre - kRadius, 0.0f}, {kCentre - kRadius, kSpring}, {kLeft, kSpring});
        face({kCentre + kRadius, 0.0f}, {kRight, 0.0f}, {kRight, kSpring}, {kCentre + kRadius, kSpring});
        face({kLeft, kSpring}, {kCentre - kRadius, kSpring}, {kCentre - kRadius, kTop}, {kLeft, kTop});
        face({kCentre + kRadius, kSpring}, {kRight, kSpring}, {kRight, kTop}, {kCentre + kRadius, kTop});
        for (int i = 0; i < kSegments; ++i) {
            const vec2 a = arc(i, kRadius);
            const vec2 b = arc(i + 1, kRadius);
            face(a, b, {b.x, kTop}, {a.x, kTop});
        }
    }
    // The inside of the arch.
    wall.color = vec4(0.8f, 0.8f, 0.8f, 1.0f);
    wall.grid(kSegments + 2, 1, [&](int i, int j) {
        vec2 p = i == 0 ? vec2(kCentre - kRadius, 0.0f) : i == kSegments + 2 ? vec2(kCentre + kRadius, 0.0f) : arc(i - 1, kRadius);
        vec3 n = i <= 1 ? vec3(1, 0, 0) : i >= kSegments + 1 ? vec3(-1, 0, 0) : glm::normalize(vec3(kCentre - p.x, kSpring - p.y, 0.0f));
        const float length = i == 0 ? -kSpring : kRadius * 3.14159265f * static_cast<float>(i - 1) / kSegments;
        return MeshBuilder::Point{vec3(p, kGate - kDepth * static_cast<float>(j)), n, vec2(kDepth * static_cast<float>(j), -length), vec4(0.8f), vec4(1.0f)};
    });
    wall.color = vec4(1.0f);
    // Voussoirs and a keystone.
    for (int i = 0; i < 15; ++i) {
        const float angle = 3.14159265f * (static_cast<float>(i) + 0.5f) / 15.0f;
        const vec3 radial(std::cos(angle), std::sin(angle), 0.0f);
        const bool key = i == 7;
        const std::uint32_t h = hash_cell(i, 2, kit.seed + 3u);
        const float light = 0.85f + 0.15f * hash_unit(h, 1);
        kit[Slot::Granite].color = vec4(light, light, light, 1.0f);
        kit[Slot::Granite].box({.centre = vec3(kCentre, kSpring, kGate) + radial * (kRadius + (key ? 0.21f : 0.16f)),
                                .half = vec3(0.183f, key ? 0.24f : 0.17f, key ? 0.10f : 0.06f),
                                .bevel_m = 0.012f,
                                .axes = glm::mat3(glm::cross(radial, vec3(0, 0, 1)), radial, vec3(0, 0, 1))});
    }
    kit[Slot::Granite].color = vec4(1.0f);
    for (const float side : {-1.0f, 1.0f}) {
        for (int k = 0; k < 4; ++k) {
            const float v = 0.15f + 0.43f * static_cast<float>(k);
            kit[Slot::Granite].box({.centre = vec3(kCentre + side * (kRadius + (k % 2 == 0 ? 0.20f : 0.14f)), v + 0.1f, kGate),
                                    .half = vec3(k % 2 == 0 ? 0.21f : 0.15f, 0.21f, 0.06f), .bevel_m = 0.012f});
        }
    }
    kit[Slot::Granite].box({.centre = vec3(0.5f * (kLeft + kRight), 3.72f, kGate), .half = vec3(0.5f * (kRight - kLeft), 0.06f, 0.08f), .bevel_m = 0.015f});
    // The roof falls to the front and back; its ridge spans the street.
    const Frame roof{vec3(kLeft, 0.0f, kGate), vec3(1, 0, 0), vec3(0, 0, 1)};
    add_roof(kit, roof, {.width = kRight - kLeft, .depth = kDepth, .eave_v = kTop, .rise = 1.05f, .overhang = 0.20f});
    add_clock_turret(kit, vec3(kCentre, kTop - 0.15f, kGate - 0.55f));
    for (const float x : {kLeft, kRight}) {
        const vec3 a(x, kTop, kGate), b(x, kTop, kGate - kDepth), top(x, kTop + 1.05f, kGate - 0.5f * kDepth);
        const vec3 a0(x, 0.0f, kGate), b0(x, 0.0f, kGate - kDepth);
        if (x < 0.0f) {
            add_gable(kit, Slot::Brick, b, a, top);
            wall.quad(b0, a0, a, b);
        } else {
            add_gable(kit, Slot::Brick, a, b, top);
            wall.quad(a0, b0, b, a);
        }
    }
}

}  // namespace petrichor::cli
