// The awning over the pavement and the street lamp.
#include <algorithm>
#include <cmath>

#include "demo/street_parts.h"

namespace petrichor::demo {

using glm::vec3;

void add_awning(Kit& kit)
{
    constexpr float kZ0 = -1.2f;
    constexpr float kZ1 = -5.2f;
    constexpr float kInner = kLeftWall;
    constexpr float kOuter = -1.92f;
    constexpr float kHigh = 2.86f;
    constexpr float kLow = 2.36f;
    constexpr float kSheet = 0.4f;  // as the seams of the material
    const vec3 down = glm::normalize(vec3(kOuter - kInner, kLow - kHigh, 0.0f));
    const vec3 normal = glm::normalize(vec3(kHigh - kLow, kOuter - kInner, 0.0f));
    const vec3 thick = 0.012f * normal;

    MeshBuilder& sheet = kit[Slot::Awning];
    const vec3 a(kOuter, kLow, kZ0), b(kOuter, kLow, kZ1), c(kInner, kHigh, kZ1),
        d(kInner, kHigh, kZ0);
    sheet.quad(a + thick, b + thick, c + thick, d + thick, -down);
    // The folded edge along the eaves and the two ends.
    const vec3 fold = vec3(0.0f, -0.055f, 0.0f);
    sheet.quad(a + fold, b + fold, b + thick, a + thick);
    sheet.quad(a + fold, a + thick, d + thick, d + fold);
    sheet.quad(b + thick, b + fold, c + fold, c + thick);
    const vec3 bead = vec3(0.004f, -0.055f, 0.0f);
    sheet.tube({a + bead, b + bead}, 0.009f, 8);
    for (float z = kZ0; z > kZ1 - 0.01f; z -= kSheet) {
        const float inset = z == kZ0 ? -0.008f : z < kZ1 + 0.1f ? 0.008f : 0.0f;
        const vec3 offset(0.0f, 0.0f, z + inset);
        sheet.beam(vec3(kOuter + 0.012f, kLow, 0.0f) + offset + 0.024f * normal,
                   vec3(kInner, kHigh, 0.0f) + offset + 0.024f * normal, 0.010f, 0.030f, 0.004f,
                   normal);
    }
    // A flashing against the wall.
    sheet.box({.centre = vec3(kInner + 0.012f, kHigh + 0.06f, 0.5f * (kZ0 + kZ1)),
               .half = vec3(0.012f, 0.07f, 0.5f * (kZ0 - kZ1) + 0.02f),
               .bevel_m = 0.004f,
               .grain = 1});

    // Boards and rafters below.
    MeshBuilder& timber = kit[Slot::Timber];
    const vec3 under = -0.035f * normal;
    timber.quad(b + under, a + under, d + under, c + under, vec3(0, 0, 1));
    for (int i = 0; i <= 6; ++i) {
        const float z = kZ0 - 0.06f + (kZ1 - kZ0 + 0.12f) * static_cast<float>(i) / 6.0f;
        timber.beam(vec3(kOuter + 0.10f, kLow - 0.095f, z), vec3(kInner, kHigh - 0.065f, z), 0.055f,
                    0.085f, 0.006f, normal);
    }
    timber.beam(vec3(-2.12f, kLow - 0.115f, kZ0 + 0.02f), vec3(-2.12f, kLow - 0.115f, kZ1 - 0.02f),
                0.08f, 0.10f, 0.008f);
    timber.beam(vec3(kInner + 0.035f, kHigh - 0.16f, kZ0),
                vec3(kInner + 0.035f, kHigh - 0.16f, kZ1), 0.07f, 0.11f, 0.008f);

    // Brackets: a strut, a tie and a scroll of iron at four places.
    MeshBuilder& iron = kit[Slot::Iron];
    for (int i = 0; i < 4; ++i) {
        const float z = kZ0 - 0.12f + (kZ1 - kZ0 + 0.24f) * static_cast<float>(i) / 3.0f;
        iron.box({.centre = vec3(kInner + 0.02f, 2.22f, z),
                  .half = vec3(0.02f, 0.46f, 0.028f),
                  .bevel_m = 0.006f});
        iron.beam(vec3(kInner, kLow - 0.14f + 0.21f, z), vec3(-2.12f, kLow - 0.18f, z), 0.035f,
                  0.035f, 0.006f);
        std::vector<vec3> strut;
        for (int k = 0; k <= 10; ++k) {
            const float angle = 1.5707963f * static_cast<float>(k) / 10.0f;
            strut.emplace_back(kInner + 0.04f + 1.30f * (1.0f - std::cos(angle)),
                               1.80f + 0.45f * std::sin(angle), z);
        }
        iron.tube(strut, 0.017f, 8);
        std::vector<vec3> scroll;
        for (int k = 0; k <= 24; ++k) {
            const float t = static_cast<float>(k) / 24.0f;
            const float angle = 1.2f + 8.2f * t;
            const float r = 0.17f * (1.0f - 0.72f * t);
            scroll.emplace_back(kInner + 0.27f + r * std::cos(angle), 2.14f + r * std::sin(angle),
                                z);
        }
        iron.tube(scroll, 0.010f, 6);
    }
}

void add_lamp(Kit& kit, const vec3& foot)
{
    MeshBuilder& iron = kit[Slot::Iron];
    // A stepped plinth, a fluted base, a slender column with rings.
    iron.box({.centre = foot + vec3(0.0f, 0.05f, 0.0f),
              .half = vec3(0.17f, 0.07f, 0.17f),
              .bevel_m = 0.018f});
    iron.lathe(foot,
               {{0.150f, 0.10f}, {0.150f, 0.14f}, {0.135f, 0.17f}, {0.118f, 0.19f}, {0.112f, 0.24f},
                {0.100f, 0.60f}, {0.108f, 0.63f}, {0.112f, 0.66f}, {0.100f, 0.69f}, {0.078f, 0.72f},
                {0.062f, 0.80f}, {0.055f, 0.92f}, {0.066f, 0.95f}, {0.068f, 0.98f}, {0.052f, 1.01f},
                {0.046f, 1.10f}, {0.040f, 2.30f}, {0.058f, 2.33f}, {0.062f, 2.36f}, {0.045f, 2.40f},
                {0.040f, 2.46f}, {0.034f, 2.64f}, {0.060f, 2.68f}, {0.072f, 2.74f}, {0.050f, 2.77f},
                {0.030f, 2.80f}, {0.0f, 2.81f}},
               20);
    for (int k = 0; k < 12; ++k) {  // flutes of the base
        const float angle = 6.2831853f * static_cast<float>(k) / 12.0f;
        const vec3 n(std::cos(angle), 0.0f, std::sin(angle));
        iron.tube({foot + 0.112f * n + vec3(0, 0.235f, 0), foot + 0.101f * n + vec3(0, 0.60f, 0)},
                  0.011f, 6);
    }
    // The ladder bar.
    const vec3 bar(0.0f, 2.52f, 0.0f);
    iron.tube({foot + bar - vec3(0.34f, 0, 0), foot + bar + vec3(0.34f, 0, 0)}, 0.015f, 10);
    for (const float s : {-1.0f, 1.0f}) {
        iron.lathe(
            foot + bar + vec3(0.34f * s, -0.03f, 0.0f),
            {{0.0f, 0.0f}, {0.022f, 0.010f}, {0.030f, 0.030f}, {0.022f, 0.050f}, {0.0f, 0.060f}},
            10);
        std::vector<vec3> arm;
        for (int k = 0; k <= 8; ++k) {
            const float angle = 1.5707963f * static_cast<float>(k) / 8.0f;
            arm.push_back(foot + vec3(s * (0.05f + 0.19f * std::sin(angle)),
                                      2.33f + 0.19f * (1.0f - std::cos(angle)), 0.0f));
        }
        iron.tube(arm, 0.009f, 6);
    }

    // The lantern: four leaning panes in a frame, a vented roof, a finial.
    constexpr float kLow = 2.83f;
    constexpr float kHigh = 3.32f;
    constexpr float kNarrow = 0.115f;
    constexpr float kWide = 0.205f;
    iron.box({.centre = foot + vec3(0, kLow - 0.010f, 0),
              .half = vec3(kNarrow + 0.02f, 0.016f, kNarrow + 0.02f),
              .bevel_m = 0.006f});
    iron.box({.centre = foot + vec3(0, kHigh + 0.012f, 0),
              .half = vec3(kWide + 0.025f, 0.018f, kWide + 0.025f),
              .bevel_m = 0.006f});
    MeshBuilder& glass = kit[Slot::LampGlass];
    for (int side = 0; side < 4; ++side) {
        const float angle = 1.5707963f * static_cast<float>(side);
        const vec3 n(std::sin(angle), 0.0f, std::cos(angle));
        const vec3 t(std::cos(angle), 0.0f, -std::sin(angle));
        const vec3 low = foot + vec3(0, kLow, 0);
        const vec3 high = foot + vec3(0, kHigh, 0);
        const auto corner = [&](float s, bool top) {
            const float r = top ? kWide : kNarrow;
            return (top ? high : low) + r * n + s * r * t;
        };
        glass.quad(corner(-1, false), corner(1, false), corner(1, true), corner(-1, true));
        iron.beam(corner(1, false), corner(1, true), 0.020f, 0.020f, 0.004f, n);
        const vec3 middle_low = 0.5f * (corner(-1, false) + corner(1, false));
        const vec3 middle_high = 0.5f * (corner(-1, true) + corner(1, true));
        iron.beam(middle_low + 0.004f * n, middle_high + 0.004f * n, 0.008f, 0.008f, 0.002f, n);
    }
    const auto pyramid = [&](float y0, float r0, float y1, float r1) {
        for (int side = 0; side < 4; ++side) {
            const float angle = 1.5707963f * static_cast<float>(side);
            const vec3 n(std::sin(angle), 0.0f, std::cos(angle));
            const vec3 t(std::cos(angle), 0.0f, -std::sin(angle));
            const vec3 a = foot + vec3(0, y0, 0), b = foot + vec3(0, y1, 0);
            iron.quad(a + r0 * (n - t), a + r0 * (n + t), b + r1 * (n + t), b + r1 * (n - t));
        }
    };
    pyramid(kHigh + 0.03f, kWide + 0.045f, kHigh + 0.19f, 0.085f);
    pyramid(kHigh + 0.19f, 0.085f, kHigh + 0.24f, 0.085f);
    pyramid(kHigh + 0.24f, 0.105f, kHigh + 0.31f, 0.02f);
    iron.lathe(foot + vec3(0, kHigh + 0.30f, 0),
               {{0.02f, 0.0f},
                {0.032f, 0.02f},
                {0.036f, 0.045f},
                {0.022f, 0.07f},
                {0.010f, 0.085f},
                {0.012f, 0.11f},
                {0.0f, 0.15f}},
               10);
}

}  // namespace petrichor::demo
