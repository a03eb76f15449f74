// Roofs, rain gutters and pipes, chimneys.
#include <algorithm>
#include <cmath>

#include "demo/street_walls.h"
#include "texproc/generate/noise.h"

namespace petrichor::demo {

using glm::vec2;
using glm::vec3;
using glm::vec4;
using texproc::hash_cell;
using texproc::hash_signed;
using texproc::hash_unit;

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
        const std::uint32_t h = hash_cell(
            i, j,
            kit.seed + 77u +
                static_cast<std::uint32_t>(std::lround(std::abs(frame.origin.z) * 10.0f)));
        const vec3 flat = glm::mix(glm::mix(a, b, s), glm::mix(d, c, s), t) + lift;
        const vec3 n = glm::normalize(glm::cross(b - a, d - a));
        return MeshBuilder::Point{
            flat + n * (0.012f * hash_signed(h, 1) -
                        0.03f * std::sin(3.14159f * t) * std::sin(3.14159f * s)),
            n, vec2(glm::dot(flat, frame.along), -glm::dot(flat, up_front)), vec4(1.0f),
            vec4(1.0f)};
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
        tiles.tube({frame.at(u - 0.03f, v + 0.012f, -half), frame.at(u + step, v, -half)},
                   {0.125f, 0.115f}, 10);
    }
    tiles.color = vec4(1.0f);
    // Rain gutter along the front.
    const float gutter_v = roof.eave_v - drop - 0.045f;
    kit[Slot::Zinc].tube({frame.at(-kVerge, gutter_v, roof.overhang + 0.05f),
                          frame.at(roof.width + kVerge, gutter_v, roof.overhang + 0.05f)},
                         0.062f, 10);
}

// A pipe from the rain gutter down the wall.
void add_downpipe(Kit& kit, const Frame& frame, float u, float eave_v, float overhang,
                  float bottom_v)
{
    MeshBuilder& zinc = kit[Slot::Zinc];
    zinc.tube({frame.at(u, eave_v - 0.03f, overhang + 0.03f), frame.at(u, eave_v - 0.16f, overhang),
               frame.at(u, eave_v - 0.48f, 0.10f), frame.at(u, eave_v - 0.60f, 0.075f),
               frame.at(u, bottom_v + 0.14f, 0.075f), frame.at(u, bottom_v + 0.05f, 0.10f),
               frame.at(u, bottom_v, 0.17f)},
              0.042f, 12);
    for (float v = bottom_v + 0.5f; v < eave_v - 0.6f; v += 1.5f) {
        zinc.tube({frame.at(u, v, 0.075f), frame.at(u, v + 0.035f, 0.075f)}, 0.050f, 12);
        add_box(kit, Slot::Iron, frame, {u - 0.012f, v + 0.008f, -0.02f},
                {u + 0.012f, v + 0.03f, 0.04f}, 0.0f);
    }
}

void add_chimney(Kit& kit, const vec3& foot, float height)
{
    MeshBuilder& brick = kit[Slot::Brick];
    brick.color = vec4(0.75f, 0.72f, 0.70f, 1.0f);
    brick.box({.centre = foot + vec3(0.0f, 0.5f * height, 0.0f),
               .half = vec3(0.34f, 0.5f * height, 0.45f),
               .bevel_m = 0.01f});
    brick.box({.centre = foot + vec3(0.0f, height - 0.20f, 0.0f),
               .half = vec3(0.39f, 0.075f, 0.50f),
               .bevel_m = 0.01f});
    brick.color = vec4(1.0f);
    kit[Slot::Granite].box({.centre = foot + vec3(0.0f, height + 0.03f, 0.0f),
                            .half = vec3(0.42f, 0.045f, 0.53f),
                            .bevel_m = 0.015f});
    for (const float s : {-1.0f, 1.0f}) {
        kit[Slot::RoofTile].lathe(foot + vec3(0.0f, height + 0.06f, 0.22f * s),
                                  {{0.13f, 0.0f},
                                   {0.12f, 0.05f},
                                   {0.10f, 0.32f},
                                   {0.115f, 0.35f},
                                   {0.115f, 0.39f},
                                   {0.085f, 0.40f},
                                   {0.08f, 0.2f}},
                                  12);
    }
}

}  // namespace petrichor::demo
