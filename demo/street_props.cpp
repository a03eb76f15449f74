// What stands in the street: bollards, a bench, barrels, a bucket, crates, the garden wall, a sign.
#include <algorithm>
#include <cmath>

#include "demo/street_parts.h"
#include "texproc/generate/noise.h"

namespace petrichor::demo {

using glm::vec2;
using glm::vec3;
using glm::vec4;
using texproc::hash_cell;
using texproc::hash_signed;
using texproc::hash_unit;

namespace {

void add_bollard(Kit& kit, const vec3& foot)
{
    kit[Slot::Iron].lathe(foot,
                          {{0.105f, -0.02f},
                           {0.105f, 0.05f},
                           {0.085f, 0.075f},
                           {0.078f, 0.10f},
                           {0.068f, 0.55f},
                           {0.066f, 0.62f},
                           {0.084f, 0.645f},
                           {0.086f, 0.675f},
                           {0.062f, 0.70f},
                           {0.056f, 0.73f},
                           {0.074f, 0.765f},
                           {0.082f, 0.805f},
                           {0.074f, 0.845f},
                           {0.046f, 0.872f},
                           {0.0f, 0.882f}},
                          20);
}

void add_bench(Kit& kit, const vec3& foot)
{
    // Its back to the wall at -x; it runs along z.
    MeshBuilder& iron = kit[Slot::Iron];
    MeshBuilder& wood = kit[Slot::Timber];
    constexpr float kLength = 1.5f;
    for (const float s : {-1.0f, 1.0f}) {
        const vec3 at = foot + vec3(0.0f, 0.0f, s * (0.5f * kLength - 0.16f));
        iron.tube(
            {at + vec3(0.40f, 0.0f, 0), at + vec3(0.36f, 0.20f, 0), at + vec3(0.37f, 0.40f, 0)},
            0.017f, 8);
        iron.tube({at + vec3(0.02f, 0.0f, 0), at + vec3(0.06f, 0.22f, 0),
                   at + vec3(0.05f, 0.42f, 0), at + vec3(-0.03f, 0.80f, 0)},
                  0.017f, 8);
        iron.beam(at + vec3(0.03f, 0.405f, 0), at + vec3(0.40f, 0.395f, 0), 0.03f, 0.02f, 0.004f);
        iron.tube(
            {at + vec3(0.02f, 0.62f, 0), at + vec3(0.20f, 0.64f, 0), at + vec3(0.38f, 0.60f, 0),
             at + vec3(0.40f, 0.54f, 0), at + vec3(0.37f, 0.40f, 0)},
            0.013f, 8);
    }
    const auto slat = [&](vec3 centre, vec3 half, float tilt, std::uint32_t k) {
        const float c = std::cos(tilt), sn = std::sin(tilt);
        wood.uv_offset_m =
            vec2(0.15f * static_cast<float>(k) + 0.075f, 0.37f * static_cast<float>(k));
        const float light = 0.95f + 0.05f * hash_signed(k, 3);
        wood.color = vec4(light, 0.92f * light, 0.82f * light, 1.0f);
        wood.box({.centre = foot + centre,
                  .half = half,
                  .bevel_m = 0.007f,
                  .axes = glm::mat3(vec3(c, sn, 0), vec3(-sn, c, 0), vec3(0, 0, 1)),
                  .grain = 2});
    };
    for (std::uint32_t k = 0; k < 4; ++k) {
        slat(vec3(0.075f + 0.096f * static_cast<float>(k), 0.425f - 0.003f * static_cast<float>(k),
                  0),
             vec3(0.043f, 0.014f, 0.5f * kLength), -0.03f, k);
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
        const float t = static_cast<float>(k);
        slat(vec3(0.055f - 0.024f * t, 0.52f + 0.105f * t, 0), vec3(0.045f, 0.013f, 0.5f * kLength),
             1.5707963f + 0.22f, k + 7u);
    }
    wood.color = vec4(1.0f);
    wood.uv_offset_m = vec2(0.0f);
}

void add_barrel(Kit& kit, const vec3& foot, float radius, float height)
{
    MeshBuilder& wood = kit[Slot::Timber];
    constexpr int kStaves = 20;
    const auto bulge = [&](float t) {
        return radius * (0.84f + 0.16f * std::sin(3.14159265f * t));
    };
    for (int s = 0; s < kStaves; ++s) {
        const std::uint32_t h = hash_cell(s, static_cast<int>(foot.z * 100.0f), kit.seed + 5u);
        const float light = 0.75f + 0.25f * hash_unit(h, 1);
        const vec4 tint(light, light * 0.95f, light * 0.90f, 1.0f);
        wood.uv_offset_m = vec2(0.15f * std::floor(8.0f * hash_unit(h, 2)), hash_unit(h, 3));
        const float proud = 0.0025f * hash_unit(h, 4);
        wood.grid(2, 8, [&](int i, int j) {
            // Each stave is a little rounded and set off from its neighbours.
            const float inner = i == 1 ? 0.004f : 0.0f;
            const float angle = 6.2831853f *
                                (static_cast<float>(s) + 0.03f + 0.47f * static_cast<float>(i)) /
                                kStaves;
            const float t = static_cast<float>(j) / 8.0f;
            const float r = bulge(t) + inner + proud;
            const float lean = 0.16f * radius * 3.14159265f * std::cos(3.14159265f * t) / height;
            const float tilted = angle + (static_cast<float>(i) - 1.0f) * 0.10f;
            return MeshBuilder::Point{
                foot + vec3(r * std::cos(angle), t * height, r * std::sin(angle)),
                glm::normalize(vec3(std::cos(tilted), -lean, std::sin(tilted))),
                vec2(0.06f * static_cast<float>(i), -t * height), tint, vec4(1.0f)};
        });
    }
    wood.uv_offset_m = vec2(0.0f);
    // Rim, inside and a dark sheet of water.
    const float top = bulge(1.0f);
    wood.color = vec4(0.8f, 0.76f, 0.7f, 1.0f);
    wood.lathe(foot,
               {{top + 0.003f, height - 0.01f},
                {top + 0.003f, height},
                {top - 0.024f, height},
                {top - 0.024f, height - 0.12f}},
               32);
    wood.color = vec4(1.0f);
    kit[Slot::Glass].lathe(foot, {{top, height - 0.055f}, {0.0f, height - 0.055f}}, 32);
    for (const float t : {0.07f, 0.27f, 0.73f, 0.93f}) {
        const float half = 0.018f / height;
        const float a = bulge(t - half) + 0.007f, b = bulge(t + half) + 0.007f;
        kit[Slot::Iron].lathe(foot,
                              {{a - 0.008f, (t - half) * height},
                               {a, (t - half) * height},
                               {b, (t + half) * height},
                               {b - 0.008f, (t + half) * height}},
                              32);
    }
}

void add_bucket(Kit& kit, const vec3& foot)
{
    MeshBuilder& zinc = kit[Slot::Zinc];
    zinc.lathe(foot,
               {{0.098f, 0.0f},
                {0.102f, 0.004f},
                {0.104f, 0.022f},
                {0.100f, 0.026f},
                {0.118f, 0.12f},
                {0.121f, 0.124f},
                {0.121f, 0.130f},
                {0.119f, 0.134f},
                {0.142f, 0.262f},
                {0.147f, 0.266f},
                {0.149f, 0.272f},
                {0.147f, 0.278f},
                {0.141f, 0.277f},
                {0.139f, 0.270f},
                {0.100f, 0.03f},
                {0.0f, 0.028f}},
               28);
    std::vector<vec3> handle;
    for (int k = 0; k <= 16; ++k) {
        const float angle = 3.14159265f * static_cast<float>(k) / 16.0f;
        handle.push_back(foot + vec3(0.146f * std::cos(angle), 0.255f + 0.05f * std::sin(angle),
                                     0.135f * std::sin(angle)));
    }
    zinc.tube(handle, 0.0035f, 6);
    for (const float s : {-1.0f, 1.0f}) {
        zinc.box({.centre = foot + vec3(0.146f * s, 0.25f, 0.0f),
                  .half = vec3(0.006f, 0.022f, 0.022f),
                  .bevel_m = 0.004f});
    }
}

void add_crate(Kit& kit, const vec3& foot, vec3 half, float turn)
{
    MeshBuilder& wood = kit[Slot::Timber];
    const glm::mat3 axes(vec3(std::cos(turn), 0, -std::sin(turn)), vec3(0, 1, 0),
                         vec3(std::sin(turn), 0, std::cos(turn)));
    const auto board = [&](vec3 centre, vec3 size, int grain, std::uint32_t k) {
        const std::uint32_t h =
            hash_cell(static_cast<int>(k), static_cast<int>(foot.z * 50.0f), kit.seed + 6u);
        const float light = 0.85f + 0.15f * hash_unit(h, 1);
        wood.color = vec4(light, light * 0.97f, light * 0.90f, 1.0f);
        wood.uv_offset_m =
            vec2(0.15f * std::floor(8.0f * hash_unit(h, 2)) + 0.075f, hash_unit(h, 3));
        wood.box({.centre = foot + axes * (centre + vec3(0, half.y, 0)),
                  .half = size,
                  .bevel_m = 0.004f,
                  .axes = axes,
                  .grain = grain});
    };
    std::uint32_t k = 0;
    const float pitch = 2.0f * half.y / 3.0f;
    for (int row = 0; row < 3; ++row) {
        const float y = -half.y + pitch * (static_cast<float>(row) + 0.5f);
        const float h = 0.5f * pitch - 0.008f;
        for (const float s : {-1.0f, 1.0f}) {
            board(vec3(0, y, s * (half.z - 0.008f)), vec3(half.x, h, 0.008f), 0, k++);
            board(vec3(s * (half.x - 0.008f), y, 0), vec3(0.008f, h, half.z - 0.017f), 2, k++);
        }
    }
    for (const float sx : {-1.0f, 1.0f}) {
        for (const float sz : {-1.0f, 1.0f}) {
            board(vec3(sx * (half.x - 0.03f), 0, sz * (half.z - 0.028f)),
                  vec3(0.018f, half.y, 0.014f), 1, k++);
        }
    }
    board(vec3(0, -half.y + 0.012f, 0), vec3(half.x - 0.016f, 0.008f, half.z - 0.016f), 0, k++);
    wood.color = vec4(1.0f);
    wood.uv_offset_m = vec2(0.0f);
}

// The garden wall: rough stone with coping slabs.
void add_garden_wall(Kit& kit)
{
    constexpr float kX = kRightWall + 0.12f;
    constexpr float kHeight = 0.88f;
    MeshBuilder& stone = kit[Slot::Paving];  // smaller, it makes a wall of squared rubble
    stone.uv_scale = 2.4f;
    stone.weather = vec4(1.0f, 0.0f, 1.0f, 1.0f);
    stone.color = vec4(0.86f, 0.82f, 0.76f, 1.0f);
    stone.box({.centre = vec3(kX, 0.5f * kHeight - 0.05f, 0.5f * (kNear + kGarden)),
               .half = vec3(0.16f, 0.5f * kHeight + 0.05f, 0.5f * (kNear - kGarden)),
               .bevel_m = 0.02f});
    stone.color = vec4(1.0f);
    stone.weather = vec4(1.0f);
    stone.uv_scale = 1.0f;
    float z = kNear;
    int index = 0;
    while (z > kGarden + 0.3f) {
        const std::uint32_t h = hash_cell(index++, 8, kit.seed + 60u);
        const float length = std::min(0.55f + 0.35f * hash_unit(h, 1), z - kGarden);
        MeshBuilder& granite = kit[Slot::Granite];
        const float light = 0.84f + 0.16f * hash_unit(h, 2);
        granite.color = vec4(light, light * 0.98f, light * 0.95f, 1.0f);
        granite.uv_offset_m = vec2(3.0f * hash_unit(h, 3), 3.0f * hash_unit(h, 4));
        const float tip = 0.02f * hash_signed(h, 5);
        granite.box(
            {.centre = vec3(kX + 0.008f * hash_signed(h, 6),
                            kHeight + 0.045f + 0.006f * hash_signed(h, 7), z - 0.5f * length),
             .half = vec3(0.215f, 0.055f, 0.5f * length - 0.006f),
             .bevel_m = 0.022f,
             .axes = glm::mat3(vec3(1, tip, 0), vec3(-tip, 1, 0), vec3(0, 0, 1)),
             .grain = 2});
        granite.color = vec4(1.0f);
        granite.uv_offset_m = vec2(0.0f);
        z -= length;
    }
}

// A shop sign on an iron arm.
void add_sign(Kit& kit, const vec3& at)
{
    MeshBuilder& iron = kit[Slot::Iron];
    iron.tube({at, at + vec3(0.85f, 0.0f, 0.0f)}, 0.014f, 8);
    iron.tube({at + vec3(0.0f, -0.35f, 0.0f), at + vec3(0.35f, -0.28f, 0.0f),
               at + vec3(0.62f, -0.01f, 0.0f)},
              0.010f, 8);
    for (const float x : {0.30f, 0.74f}) {
        iron.tube({at + vec3(x, 0.0f, 0.0f), at + vec3(x, -0.09f, 0.0f)}, 0.006f, 6);
    }
    kit[Slot::Painted].color = vec4(0.33f, 0.09f, 0.055f, 1.0f);
    kit[Slot::Painted].lathe(at + vec3(0.52f, -0.37f, -0.018f),
                             {{0.0f, 0.0f},
                              {0.26f, 0.0f},
                              {0.28f, 0.008f},
                              {0.28f, 0.028f},
                              {0.26f, 0.036f},
                              {0.0f, 0.036f}},
                             32, glm::mat3(vec3(1, 0, 0), vec3(0, 0, 1), vec3(0, -1, 0)));
    kit[Slot::Painted].color = vec4(1.0f);
    iron.lathe(at + vec3(0.52f, -0.37f, -0.024f),
               {{0.275f, 0.0f}, {0.295f, 0.006f}, {0.295f, 0.042f}, {0.275f, 0.048f}}, 32,
               glm::mat3(vec3(1, 0, 0), vec3(0, 0, 1), vec3(0, -1, 0)));
}

}  // namespace

void add_furniture(Kit& kit)
{
    for (const float z : {1.35f, -0.45f, -6.0f, -7.8f}) {
        add_bollard(kit, vec3(-kKerbEnd - 0.16f, pavement_height(kKerbEnd + 0.16f), z));
    }
    for (const float z : {-3.4f, -5.6f, -7.8f}) {
        add_bollard(kit, vec3(kKerbEnd + 0.16f, pavement_height(kKerbEnd + 0.16f), z));
    }
    const float wall_foot = pavement_height(kLeftWall);
    add_bench(kit, vec3(kLeftWall + 0.12f, wall_foot, -3.1f));
    add_barrel(kit, vec3(kLeftWall + 0.42f, wall_foot - 0.005f, 1.02f), 0.30f, 0.92f);
    add_bucket(kit, vec3(kLeftWall + 0.78f, wall_foot - 0.008f, 0.62f));
    add_crate(kit, vec3(kLeftWall + 0.34f, wall_foot, -4.62f), vec3(0.25f, 0.17f, 0.20f), 0.15f);
    add_crate(kit, vec3(kLeftWall + 0.32f, wall_foot + 0.34f, -4.60f), vec3(0.24f, 0.15f, 0.19f),
              -0.12f);
    add_barrel(kit, vec3(kLeftWall + 0.40f, wall_foot - 0.005f, -1.58f), 0.27f, 0.80f);
    add_garden_wall(kit);
    add_sign(kit, vec3(kLeftWall, 3.55f, -5.35f));
}

}  // namespace petrichor::demo
