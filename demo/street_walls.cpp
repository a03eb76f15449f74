// Walls with holes, and what fills the holes: windows and doors.
#include <algorithm>
#include <cmath>

#include "demo/street_walls.h"
#include "texproc/generate/noise.h"

namespace petrichor::demo {

using glm::vec2;
using glm::vec3;
using glm::vec4;
using texproc::hash_cell;
using texproc::hash_unit;
using texproc::smooth_step;

void add_box(Kit& kit, Slot slot, const Frame& frame, vec3 low, vec3 high, float bevel, int grain)
{
    const vec3 middle = 0.5f * (low + high);
    kit[slot].box({.centre = frame.at(middle.x, middle.y, middle.z),
                   .half = 0.5f * (high - low),
                   .bevel_m = bevel,
                   .axes = frame.axes(),
                   .grain = grain});
}

namespace {

// Walls are darker where rain splashes up and under the eaves.
vec4 wall_tint(float v, float height)
{
    const float splash = smooth_step(0.75f, 0.05f, v);
    const float soot = smooth_step(height - 0.5f, height, v);
    const float light = 1.0f - 0.34f * splash - 0.12f * soot;
    return {light, light * (1.0f - 0.01f * splash), light * (1.0f - 0.05f * splash), 1.0f};
}

// The sides of an opening, so deep into the wall.
void add_reveals(Kit& kit, Slot slot, const Frame& frame, const Opening& o, float depth)
{
    MeshBuilder& wall = kit[slot];
    wall.color = vec4(0.72f, 0.71f, 0.70f, 1.0f);
    wall.quad(frame.at(o.u0, o.v0), frame.at(o.u0, o.v0, -depth), frame.at(o.u0, o.v1, -depth),
              frame.at(o.u0, o.v1));
    wall.quad(frame.at(o.u1, o.v0, -depth), frame.at(o.u1, o.v0), frame.at(o.u1, o.v1),
              frame.at(o.u1, o.v1, -depth));
    wall.quad(frame.at(o.u0, o.v1, -depth), frame.at(o.u1, o.v1, -depth), frame.at(o.u1, o.v1),
              frame.at(o.u0, o.v1));
    wall.quad(frame.at(o.u0, o.v0), frame.at(o.u1, o.v0), frame.at(o.u1, o.v0, -depth),
              frame.at(o.u0, o.v0, -depth));
    wall.color = vec4(1.0f);
}

// A box of geraniums on the sill.
void add_flower_box(Kit& kit, const Frame& frame, const Opening& o)
{
    MeshBuilder& timber = kit[Slot::Timber];
    timber.color = vec4(0.62f, 0.60f, 0.56f, 1.0f);
    add_box(kit, Slot::Timber, frame, {o.u0 + 0.02f, o.v0 + 0.005f, 0.0f},
            {o.u1 - 0.02f, o.v0 + 0.15f, 0.16f}, 0.008f, 0);
    timber.color = vec4(1.0f);
    const auto seed = static_cast<std::uint32_t>(std::lround(
        100.0f * (frame.origin.z + frame.origin.x + 3.0f * o.u0 + 7.0f * o.v0) + 5000.0f));
    MeshBuilder& plants = kit[Slot::Blades];
    plants.weather = vec4(1.0f, 0.0f, 0.6f, 1.0f);
    const auto count = static_cast<int>(330.0f * (o.u1 - o.u0));
    for (int k = 0; k < count; ++k) {
        const std::uint32_t h = hash_cell(k, static_cast<int>(seed), kit.seed + 90u);
        const float u = o.u0 + 0.03f + (o.u1 - o.u0 - 0.06f) * hash_unit(h, 60);
        const float mound = 0.75f + 0.25f * std::sin(9.0f * u + static_cast<float>(seed));
        const float angle = 3.14159265f * hash_unit(h, 61);
        const float r = 0.15f * mound * std::sqrt(hash_unit(h, 62));
        const vec3 at =
            frame.at(u, o.v0 + 0.15f + r * std::sin(angle) * 1.1f, 0.09f + r * std::cos(angle));
        const vec3 outward =
            glm::normalize(frame.out * std::cos(angle) + vec3(0.0f, 0.4f + std::sin(angle), 0.0f));
        const bool flower = r > 0.075f && hash_unit(h, 63) > 0.55f;
        const vec3 green =
            glm::mix(vec3(0.05f, 0.12f, 0.03f), vec3(0.12f, 0.20f, 0.05f), hash_unit(h, 64));
        const vec3 red =
            glm::mix(vec3(0.52f, 0.020f, 0.022f), vec3(0.62f, 0.07f, 0.10f), hash_unit(h, 64));
        add_leaf(plants, at, outward, flower ? 0.062f : 0.070f, h,
                 flower ? red : green * (0.45f + 3.5f * r));
    }
    plants.color = vec4(1.0f);
    plants.weather = vec4(1.0f);
}

// A pane whose texture coordinates run from 0 to 1 over it.
void add_pane(MeshBuilder& glass, const Frame& frame, const Opening& o, float d)
{
    glass.grid(1, 1, [&](int i, int j) {
        return MeshBuilder::Point{frame.at(i == 0 ? o.u0 : o.u1, j == 0 ? o.v1 : o.v0, d),
                                  frame.out, vec2(static_cast<float>(i), static_cast<float>(j))};
    });
}

}  // namespace

void add_wall(Kit& kit, Slot slot, const Frame& frame, float width, float height,
              const std::vector<Opening>& openings, const vec3& tint)
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
                const vec3 p = frame.at(us[i + static_cast<std::size_t>(a)],
                                        vs[j + static_cast<std::size_t>(b)]);
                return MeshBuilder::Point{
                    p, frame.out, vec2(glm::dot(p, frame.along), glm::dot(p, axis_v)),
                    wall_tint(vs[j + static_cast<std::size_t>(b)], height) * vec4(tint, 1.0f),
                    vec4(1.0f)};
            });
        }
    }
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
    add_box(kit, Slot::Painted, frame, {o.u0, o.v0, back - 0.01f}, {o.u0 + kStile, o.v1, front},
            0.008f);
    add_box(kit, Slot::Painted, frame, {o.u1 - kStile, o.v0, back - 0.01f}, {o.u1, o.v1, front},
            0.008f);
    add_box(kit, Slot::Painted, frame, {o.u0, o.v0, back - 0.01f},
            {o.u1, o.v0 + kStile * 1.3f, front}, 0.008f, 0);
    add_box(kit, Slot::Painted, frame, {o.u0, o.v1 - kStile, back - 0.01f}, {o.u1, o.v1, front},
            0.008f, 0);
    for (int i = 1; i < style.panes_u; ++i) {
        const float u =
            o.u0 + (o.u1 - o.u0) * static_cast<float>(i) / static_cast<float>(style.panes_u);
        const float w = style.panes_u == 2 ? 0.032f : 0.018f;
        add_box(kit, Slot::Painted, frame, {u - w, o.v0, back - 0.01f},
                {u + w, o.v1, front - 0.006f}, 0.006f);
    }
    for (int j = 1; j < style.panes_v; ++j) {
        const float v =
            o.v0 + (o.v1 - o.v0) * static_cast<float>(j) / static_cast<float>(style.panes_v);
        add_box(kit, Slot::Painted, frame, {o.u0, v - 0.013f, back - 0.01f},
                {o.u1, v + 0.013f, front - 0.014f}, 0.005f, 0);
    }
    paint.color = vec4(1.0f);

    // The sill stone: a ledge for snow.
    add_box(kit, Slot::Granite, frame, {o.u0 - 0.07f, o.v0 - 0.085f, -style.depth_m},
            {o.u1 + 0.07f, o.v0 + 0.004f, 0.085f}, 0.012f, 0);
    if (style.lintel) {
        add_box(kit, Slot::Granite, frame, {o.u0 - 0.12f, o.v1 - 0.003f, -0.10f},
                {o.u1 + 0.12f, o.v1 + 0.20f, 0.016f}, 0.008f, 0);
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
                add_box(kit, Slot::Painted, frame, {low + 0.02f, v - 0.05f, 0.038f},
                        {high - 0.02f, v + 0.05f, 0.055f}, 0.006f, 0);
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
        add_box(kit, Slot::Painted, frame, {u - 0.04f, o.v0, back}, {u + 0.04f, o.v1, back + 0.09f},
                0.010f);
    }
    add_box(kit, Slot::Painted, frame, {o.u0, o.v1 - 0.06f, back}, {o.u1, o.v1, back + 0.09f},
            0.010f, 0);
    add_box(kit, Slot::Painted, frame, {o.u0, split - 0.05f, back},
            {o.u1, split + 0.02f, back + 0.10f}, 0.010f, 0);
    for (const float t : {1.0f / 3.0f, 2.0f / 3.0f}) {
        const float u = o.u0 + t * (o.u1 - o.u0);
        add_box(kit, Slot::Painted, frame, {u - 0.012f, split, back},
                {u + 0.012f, o.v1, back + 0.04f}, 0.005f);
    }
    paint.color = color;
    const float left = o.u0 + 0.08f;
    const float right = o.u1 - 0.08f;
    add_box(kit, Slot::Painted, frame, {left, o.v0 + 0.02f, back},
            {right, split - 0.05f, back + 0.045f}, 0.004f);
    const float middle = 0.5f * (left + right);
    const float rows[] = {o.v0 + 0.16f, o.v0 + 0.78f, split - 0.15f};
    for (int j = 0; j < 2; ++j) {
        for (const float s : {-1.0f, 1.0f}) {
            const float u0 = s < 0.0f ? left + 0.09f : middle + 0.04f;
            const float u1 = s < 0.0f ? middle - 0.04f : right - 0.09f;
            add_box(kit, Slot::Painted, frame, {u0, rows[j] + 0.05f, back + 0.03f},
                    {u1, rows[j + 1] - 0.05f, back + 0.062f}, 0.020f);
        }
    }
    paint.color = vec4(1.0f);
    MeshBuilder& iron = kit[Slot::Iron];
    iron.tube({frame.at(right - 0.06f, o.v0 + 1.02f, back + 0.05f),
               frame.at(right - 0.06f, o.v0 + 1.02f, back + 0.10f),
               frame.at(right - 0.17f, o.v0 + 1.02f, back + 0.10f)},
              0.009f, 8);
    // A worn step.
    add_box(kit, Slot::Granite, frame, {o.u0 - 0.10f, -0.02f, -kDepth},
            {o.u1 + 0.10f, o.v0 + 0.01f, 0.26f}, 0.022f, 0);
    add_box(kit, Slot::Granite, frame, {o.u0 - 0.14f, o.v1 - 0.003f, -0.12f},
            {o.u1 + 0.14f, o.v1 + 0.24f, 0.022f}, 0.010f, 0);
}

}  // namespace petrichor::demo
