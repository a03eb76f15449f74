// The gatehouse that closes the street: an arch, a roof, a turret with a clock.
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

namespace {

// A timbered turret with a clock on the gate; a pyramid of tiles, a ball and a vane on top.
void add_clock_turret(Kit& kit, const vec3& foot)
{
    constexpr float kHalf = 0.72f;
    constexpr float kWall = 1.55f;
    kit[Slot::Plaster].box({.centre = foot + vec3(0.0f, 0.5f * kWall, 0.0f),
                            .half = vec3(kHalf, 0.5f * kWall, kHalf)});
    MeshBuilder& timber = kit[Slot::Timber];
    timber.color = vec4(0.50f, 0.48f, 0.46f, 1.0f);
    for (const float sx : {-1.0f, 1.0f}) {
        for (const float sz : {-1.0f, 1.0f}) {
            timber.box(
                {.centre = foot + vec3(sx * (kHalf - 0.05f), 0.5f * kWall, sz * (kHalf - 0.05f)),
                 .half = vec3(0.085f, 0.5f * kWall, 0.085f),
                 .bevel_m = 0.012f});
        }
    }
    for (const float v : {0.10f, kWall - 0.07f}) {
        timber.box({.centre = foot + vec3(0.0f, v, 0.0f),
                    .half = vec3(kHalf + 0.04f, 0.07f, kHalf + 0.04f),
                    .bevel_m = 0.012f,
                    .grain = 0});
    }
    timber.color = vec4(1.0f);
    // The clock: a white face, an iron ring, marks and two hands at ten past ten.
    const vec3 face = foot + vec3(0.0f, 0.86f, kHalf + 0.01f);
    const glm::mat3 forward(vec3(1, 0, 0), vec3(0, 0, 1), vec3(0, -1, 0));
    kit[Slot::Painted].color = vec4(0.80f, 0.77f, 0.68f, 1.0f);
    kit[Slot::Painted].lathe(face, {{0.50f, 0.0f}, {0.50f, 0.03f}, {0.0f, 0.03f}}, 40, forward);
    kit[Slot::Painted].color = vec4(1.0f);
    MeshBuilder& iron = kit[Slot::Iron];
    iron.lathe(face,
               {{0.54f, 0.0f}, {0.54f, 0.05f}, {0.52f, 0.065f}, {0.49f, 0.06f}, {0.485f, 0.03f}},
               40, forward);
    const auto hand = [&](float turns, float from, float to, float width) {
        const float angle = 6.2831853f * turns;
        const vec3 d(std::sin(angle), std::cos(angle), 0.0f);
        iron.beam(face + vec3(0, 0, 0.045f) + from * d, face + vec3(0, 0, 0.045f) + to * d, width,
                  0.012f, 0.002f, vec3(0, 0, 1));
    };
    for (int k = 0; k < 12; ++k)
        hand(static_cast<float>(k) / 12.0f, k % 3 == 0 ? 0.36f : 0.40f, 0.46f,
             k % 3 == 0 ? 0.035f : 0.022f);
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
        kit[Slot::Timber].quad(low + kEaves * (n - t) - vec3(0, 0.05f, 0),
                               low + kEaves * (n + t) - vec3(0, 0.05f, 0), low + kEaves * (n + t),
                               low + kEaves * (n - t));
        tiles.tube({low + kEaves * (n + t) + vec3(0, 0.02f, 0), apex}, {0.055f, 0.05f}, 8);
    }
    const vec3 under = foot + vec3(0.0f, kWall - 0.17f, 0.0f);
    kit[Slot::Timber].quad(under + kEaves * vec3(-1, 0, -1), under + kEaves * vec3(1, 0, -1),
                           under + kEaves * vec3(1, 0, 1), under + kEaves * vec3(-1, 0, 1));
    MeshBuilder& copper = kit[Slot::Awning];
    copper.lathe(apex - vec3(0, 0.1f, 0),
                 {{0.11f, 0.0f},
                  {0.05f, 0.12f},
                  {0.04f, 0.20f},
                  {0.075f, 0.24f},
                  {0.09f, 0.29f},
                  {0.075f, 0.34f},
                  {0.02f, 0.38f},
                  {0.012f, 0.62f},
                  {0.0f, 0.64f}},
                 14);
    iron.beam(apex + vec3(-0.20f, 0.42f, 0.0f), apex + vec3(0.22f, 0.42f, 0.0f), 0.02f, 0.012f,
              0.003f, vec3(0, 0, 1));
    iron.triangle(apex + vec3(-0.36f, 0.52f, 0.0f), apex + vec3(-0.36f, 0.32f, 0.0f),
                  apex + vec3(-0.14f, 0.42f, 0.0f), vec3(0, 1, 0));
    iron.triangle(apex + vec3(-0.36f, 0.32f, 0.0f), apex + vec3(-0.36f, 0.52f, 0.0f),
                  apex + vec3(-0.14f, 0.42f, 0.0f), vec3(0, 1, 0));
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
        face({kLeft, 0.0f}, {kCentre - kRadius, 0.0f}, {kCentre - kRadius, kSpring},
             {kLeft, kSpring});
        face({kCentre + kRadius, 0.0f}, {kRight, 0.0f}, {kRight, kSpring},
             {kCentre + kRadius, kSpring});
        face({kLeft, kSpring}, {kCentre - kRadius, kSpring}, {kCentre - kRadius, kTop},
             {kLeft, kTop});
        face({kCentre + kRadius, kSpring}, {kRight, kSpring}, {kRight, kTop},
             {kCentre + kRadius, kTop});
        for (int i = 0; i < kSegments; ++i) {
            const vec2 a = arc(i, kRadius);
            const vec2 b = arc(i + 1, kRadius);
            face(a, b, {b.x, kTop}, {a.x, kTop});
        }
    }
    // The inside of the arch.
    wall.color = vec4(0.8f, 0.8f, 0.8f, 1.0f);
    wall.grid(kSegments + 2, 1, [&](int i, int j) {
        vec2 p = i == 0               ? vec2(kCentre - kRadius, 0.0f)
                 : i == kSegments + 2 ? vec2(kCentre + kRadius, 0.0f)
                                      : arc(i - 1, kRadius);
        vec3 n = i <= 1               ? vec3(1, 0, 0)
                 : i >= kSegments + 1 ? vec3(-1, 0, 0)
                                      : glm::normalize(vec3(kCentre - p.x, kSpring - p.y, 0.0f));
        const float length =
            i == 0 ? -kSpring : kRadius * 3.14159265f * static_cast<float>(i - 1) / kSegments;
        return MeshBuilder::Point{vec3(p, kGate - kDepth * static_cast<float>(j)), n,
                                  vec2(kDepth * static_cast<float>(j), -length), vec4(0.8f),
                                  vec4(1.0f)};
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
        kit[Slot::Granite].box(
            {.centre = vec3(kCentre, kSpring, kGate) + radial * (kRadius + (key ? 0.21f : 0.16f)),
             .half = vec3(0.183f, key ? 0.24f : 0.17f, key ? 0.10f : 0.06f),
             .bevel_m = 0.012f,
             .axes = glm::mat3(glm::cross(radial, vec3(0, 0, 1)), radial, vec3(0, 0, 1))});
    }
    kit[Slot::Granite].color = vec4(1.0f);
    for (const float side : {-1.0f, 1.0f}) {
        for (int k = 0; k < 4; ++k) {
            const float v = 0.15f + 0.43f * static_cast<float>(k);
            kit[Slot::Granite].box(
                {.centre = vec3(kCentre + side * (kRadius + (k % 2 == 0 ? 0.20f : 0.14f)), v + 0.1f,
                                kGate),
                 .half = vec3(k % 2 == 0 ? 0.21f : 0.15f, 0.21f, 0.06f),
                 .bevel_m = 0.012f});
        }
    }
    kit[Slot::Granite].box({.centre = vec3(0.5f * (kLeft + kRight), 3.72f, kGate),
                            .half = vec3(0.5f * (kRight - kLeft), 0.06f, 0.08f),
                            .bevel_m = 0.015f});
    // The roof falls to the front and back; its ridge spans the street.
    const Frame roof{vec3(kLeft, 0.0f, kGate), vec3(1, 0, 0), vec3(0, 0, 1)};
    add_roof(kit, roof,
             {.width = kRight - kLeft,
              .depth = kDepth,
              .eave_v = kTop,
              .rise = 1.05f,
              .overhang = 0.20f});
    add_clock_turret(kit, vec3(kCentre, kTop - 0.15f, kGate - 0.55f));
    for (const float x : {kLeft, kRight}) {
        const vec3 a(x, kTop, kGate), b(x, kTop, kGate - kDepth),
            top(x, kTop + 1.05f, kGate - 0.5f * kDepth);
        const vec3 a0(x, 0.0f, kGate), b0(x, 0.0f, kGate - kDepth);
        if (x < 0.0f) {
            wall.triangle(b, a, top);
            wall.quad(b0, a0, a, b);
        } else {
            wall.triangle(a, b, top);
            wall.quad(a0, b0, b, a);
        }
    }
}

}  // namespace petrichor::demo
