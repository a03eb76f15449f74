// The floor of the street: cobbles with relief, gutters, kerbs, pavements, the land around.
#include <algorithm>
#include <cmath>

#include "demo/street_parts.h"
#include "texproc/generate/noise.h"

namespace petrichor::demo {

using glm::vec2;
using glm::vec3;
using glm::vec4;
using texproc::gradient_noise;
using texproc::hash_cell;
using texproc::hash_signed;
using texproc::hash_unit;
using texproc::smooth_step;

namespace {

constexpr int kFree = 1 << 20;  // a period that is never reached: noise over the open ground

float ground_noise(const Kit& kit, float x, float z, float cells_per_m, std::uint32_t salt)
{
    return gradient_noise(x * cells_per_m + 512.0f, z * cells_per_m + 512.0f, kFree, kFree,
                          kit.seed * 31u + salt);
}

// Hollows where setts have sunk: centre, radii and depth.
struct Hollow {
    float x, z, radius_x, radius_z, depth_m;
};
constexpr Hollow kHollows[] = {
    {0.30f, 1.50f, 1.20f, 0.58f, 0.040f},   {1.55f, 0.10f, 0.42f, 1.30f, 0.034f},
    {-1.45f, -0.95f, 0.50f, 1.45f, 0.034f}, {0.60f, -2.55f, 0.85f, 0.80f, 0.036f},
    {-0.75f, -5.10f, 0.95f, 1.15f, 0.036f}, {1.10f, -7.30f, 0.65f, 1.35f, 0.032f},
    {0.45f, 3.55f, 0.75f, 0.45f, 0.030f},   {0.25f, 6.20f, 1.10f, 1.00f, 0.034f},
};

constexpr vec2 kCover{-1.05f, 1.75f};  // the iron cover in the road
constexpr float kCoverRadius = 0.33f;
constexpr float kCoverFrame = kCoverRadius + 0.045f;
constexpr float kMortar_m = 0.004f;  // below the stones, where joints around it are filled

// The cover is level, and the road is not: it comes up to it on all sides.
float cover_level(const Kit& kit)
{
    return road_at(kit, kCover.x, kCover.y).height_m - 0.004f;
}

float cobble_relief(const Kit& kit, float x, float z, float step_m)
{
    // The mean over the footprint of a grid cell, by a few taps.
    constexpr int kTaps = 3;
    const Image& map = kit.cobble_height;
    const float to_texels = static_cast<float>(map.width) / kit.cobble_tile_m;
    float sum = 0.0f;
    for (int j = 0; j < kTaps; ++j) {
        for (int i = 0; i < kTaps; ++i) {
            const float dx = (static_cast<float>(i) - 1.0f) * step_m / kTaps;
            const float dz = (static_cast<float>(j) - 1.0f) * step_m / kTaps;
            const int px = static_cast<int>(std::floor((x + dx) * to_texels));
            const int py = static_cast<int>(std::floor((z + dz) * to_texels));
            sum +=
                map.at(texproc::wrap_index(px, map.width), texproc::wrap_index(py, map.height), 0);
        }
    }
    return (sum / (kTaps * kTaps) - 0.8f) * kit.cobble_scale_m;
}

float road_surface(const Kit& kit, float x, float z, float step_m)
{
    float y = road_at(kit, x, z).height_m;
    const float from_cover = glm::length(vec2(x, z) - kCover);
    if (from_cover > kCoverFrame + 0.3f) return y + cobble_relief(kit, x, z, step_m);
    // Down it goes below the frame alone, a step of the grid before its rim: else there is a ditch around it.
    const float level = cover_level(kit);
    y = level + (y - level) * smooth_step(kCoverFrame, kCoverFrame + 0.25f, from_cover);
    const float relief = cobble_relief(kit, x, z, step_m);
    const float joints = smooth_step(kCoverFrame + 0.01f, kCoverFrame + 0.06f, from_cover);
    const float filled = std::max(relief, -kMortar_m);
    const float open = smooth_step(kCoverFrame - 0.08f, kCoverFrame - 0.035f, from_cover);
    return y + open * (filled + (relief - filled) * joints) - (1.0f - open) * 0.035f;
}

// Slow stains: darker where wheels and water run, paler where feet polish.
vec4 ground_tint(const Kit& kit, float x, float z)
{
    const float slow =
        ground_noise(kit, x, z, 0.45f, 21) + 0.5f * ground_noise(kit, x, z, 1.1f, 22);
    const float edge = smooth_step(1.2f, 2.4f, std::abs(x));
    const float light = std::clamp(0.90f + 0.13f * slow - 0.16f * edge, 0.55f, 1.0f);
    return {light, light * (1.0f - 0.02f * edge), light * (1.0f - 0.05f * edge), 1.0f};
}

// Strips of the road with their own grid step; where a fine strip meets a coarse one, its last row
// lies on the straight edges of the coarse one, so no crack opens.
struct Strip {
    float z_near, z_far, step_m;
};
// Steps divide the road's width. Triangles smaller than a few pixels cost more than they show.
constexpr Strip kStrips[] = {{kNear, 3.6f, 0.11f},
                             {3.6f, -0.4f, 0.0275f},
                             {-0.4f, -4.4f, 0.055f},
                             {-4.4f, -10.4f, 0.11f},
                             {-10.4f, kFar, 0.44f}};

float on_coarse_edge(const Kit& kit, float x, float z, float coarse_m)
{
    const float cell = std::floor((x + kRoadHalf) / coarse_m + 1e-3f);
    const float x0 = -kRoadHalf + cell * coarse_m;
    const float x1 = std::min(x0 + coarse_m, kRoadHalf);
    const float y0 = road_surface(kit, x0, z, coarse_m);
    if (x1 <= x0) return y0;
    return y0 + (road_surface(kit, x1, z, coarse_m) - y0) * (x - x0) / (x1 - x0);
}

void add_carriageway(Kit& kit)
{
    const std::size_t count = std::size(kStrips);
    for (std::size_t s = 0; s < count; ++s) {
        const Strip& strip = kStrips[s];
        const int columns = static_cast<int>(std::lround(2.0f * kRoadHalf / strip.step_m));
        const int rows = static_cast<int>(std::lround((strip.z_near - strip.z_far) / strip.step_m));
        const float near_m = s > 0 ? kStrips[s - 1].step_m : 0.0f;
        const float far_m = s + 1 < count ? kStrips[s + 1].step_m : 0.0f;
        kit[Slot::Cobble].grid(columns, rows, [&](int i, int j) {
            const float x =
                -kRoadHalf + 2.0f * kRoadHalf * static_cast<float>(i) / static_cast<float>(columns);
            const float z = strip.z_near + (strip.z_far - strip.z_near) * static_cast<float>(j) /
                                               static_cast<float>(rows);
            float y;
            if (j == 0 && near_m > strip.step_m) {
                y = on_coarse_edge(kit, x, z, near_m);
            } else if (j == rows && far_m > strip.step_m) {
                y = on_coarse_edge(kit, x, z, far_m);
            } else {
                y = road_surface(kit, x, z, strip.step_m);
            }
            // Normals follow the slow shape only: the relief of the stones is in the normal map.
            constexpr float e = 0.05f;
            const vec3 normal = glm::normalize(
                vec3(road_at(kit, x - e, z).height_m - road_at(kit, x + e, z).height_m, 2.0f * e,
                     road_at(kit, x, z - e).height_m - road_at(kit, x, z + e).height_m));
            return MeshBuilder::Point{vec3(x, y, z), normal, vec2(x, z), ground_tint(kit, x, z),
                                      vec4(1.0f, road_at(kit, x, z).puddle, 1.0f, 1.0f)};
        });
    }
}

// A shallow channel of hammered granite, block by block, with open joints.
void add_gutter(Kit& kit, float side)
{
    constexpr int kColumns = 6;
    float z = kNear;
    int index = 0;
    while (z > kFar) {
        const std::uint32_t h = hash_cell(index++, side > 0.0f ? 1 : 2, kit.seed + 40u);
        const float length = 0.55f + 0.30f * hash_unit(h, 1);
        const float end = std::max(z - length, kFar);
        const float level = 0.003f * hash_signed(h, 2);
        const float gap = 0.006f;
        MeshBuilder& granite = kit[Slot::Granite];
        granite.uv_offset_m = vec2(3.0f * hash_unit(h, 3), 3.0f * hash_unit(h, 4));
        const float light = 0.86f + 0.12f * hash_unit(h, 5);
        const auto profile = [&](float t) {  // t 0 at the road, 1 at the kerb
            return -0.052f * std::sin(3.14159265f * std::min(t * 1.05f, 1.0f)) - 0.012f * t + level;
        };
        // Rounded ends: the first and last rows drop into the joint.
        const float stations[] = {z - gap,           z - gap - 0.006f,   z - gap - 0.02f,
                                  end + gap + 0.02f, end + gap + 0.006f, end + gap};
        const float drops[] = {0.022f, 0.004f, 0.0f, 0.0f, 0.004f, 0.022f};
        granite.grid(kColumns, 5, [&](int i, int j) {
            const float t = static_cast<float>(i) / kColumns;
            const float x = side * (kRoadHalf - 0.02f + t * (kGutterEnd - kRoadHalf + 0.03f));
            const float slope =
                (profile(t + 0.02f) - profile(t - 0.02f)) / (0.04f * (kGutterEnd - kRoadHalf));
            const float low = smooth_step(-0.012f, -0.040f, profile(t));
            const float end_normal = j == 0 ? 0.7f : j == 5 ? -0.7f : 0.0f;
            return MeshBuilder::Point{
                vec3(x, profile(t) - drops[j], stations[j]),
                glm::normalize(vec3(-side * slope, 1.0f, end_normal)), vec2(x, stations[j]),
                vec4(light * (0.95f - 0.20f * low), light * (0.94f - 0.2f * low),
                     light * (0.91f - 0.21f * low), 1.0f),
                vec4(1.0f, low, 1.0f, 1.0f)};
        });
        granite.uv_offset_m = vec2(0.0f);
        z = end;
    }
}

void add_kerb(Kit& kit, float side)
{
    float z = kNear;
    int index = 0;
    while (z > kFar + 0.2f) {
        const std::uint32_t h = hash_cell(index++, side > 0.0f ? 3 : 4, kit.seed + 50u);
        const float length = std::min(0.75f + 0.45f * hash_unit(h, 1), z - kFar);
        MeshBuilder& granite = kit[Slot::Granite];
        granite.uv_offset_m = vec2(4.0f * hash_unit(h, 2), 4.0f * hash_unit(h, 3));
        const float light = 0.88f + 0.12f * hash_unit(h, 4);
        granite.color = vec4(light, light * 0.99f, light * 0.97f, 1.0f);
        granite.weather = vec4(1.0f, 0.0f, 1.0f, 1.0f);
        const float turn = 0.006f * hash_signed(h, 5);
        const float tip = 0.010f * hash_signed(h, 6);
        const glm::mat3 axes(vec3(1.0f, tip, -turn), vec3(-tip, 1.0f, 0.0f),
                             vec3(turn, 0.0f, 1.0f));
        granite.box(
            {.centre = vec3(side * (0.5f * (kGutterEnd + kKerbEnd) + 0.004f * hash_signed(h, 7)),
                            kKerbTop - 0.125f + 0.005f * hash_signed(h, 8), z - 0.5f * length),
             .half = vec3(0.5f * (kKerbEnd - kGutterEnd), 0.125f, 0.5f * length - 0.004f),
             .bevel_m = 0.016f,
             .axes = axes,
             .grain = 2});
        granite.color = vec4(1.0f);
        granite.weather = vec4(1.0f);
        granite.uv_offset_m = vec2(0.0f);
        z -= length;
    }
}

void add_pavement(Kit& kit, float x0, float x1, float z_near, float z_far)
{
    const int columns = std::max(2, static_cast<int>(std::abs(x1 - x0) / 0.15f));
    const int rows = std::max(2, static_cast<int>((z_near - z_far) / 0.2f));
    kit[Slot::Paving].grid(columns, rows, [&](int i, int j) {
        // The first column reaches under the bevel of the kerb.
        const bool hidden = i == 0;
        const float x =
            hidden ? x0 - std::copysign(0.03f, x0)
                   : x0 + (x1 - x0) * static_cast<float>(i - 1) / static_cast<float>(columns - 1);
        const float z =
            z_near + (z_far - z_near) * static_cast<float>(j) / static_cast<float>(rows);
        const float sunk = smooth_step(
            0.05f, 0.75f,
            ground_noise(kit, x, z, 0.8f, 31) + 0.4f * ground_noise(kit, x, z, 1.9f, 32));
        const float dirt =
            1.0f -
            smooth_step(0.0f, 0.35f, std::min(std::abs(x - kLeftWall), std::abs(x - kRightWall)));
        const float slow = ground_noise(kit, x, z, 0.6f, 33);
        const float light = std::clamp(0.90f + 0.10f * slow - 0.22f * dirt, 0.5f, 1.0f);
        return MeshBuilder::Point{
            vec3(x, pavement_height(x) - 0.008f * sunk - (hidden ? 0.012f : 0.0f), z),
            vec3(0, 1, 0), vec2(x, z), vec4(light, light, light * (1.0f - 0.03f * dirt), 1.0f),
            vec4(1.0f, 0.85f * sunk, 1.0f, 1.0f)};
    });
}

// A round iron cover: frame, rim and studs. The frame's side is below the mortar: what shows is its chamfer.
void add_cover(Kit& kit)
{
    MeshBuilder& iron = kit[Slot::Iron];
    const float y = cover_level(kit);
    const vec3 foot(kCover.x, y, kCover.y);
    iron.color = vec4(1.0f);
    iron.lathe(foot,
               {{kCoverRadius + 0.045f, -0.03f},
                {kCoverRadius + 0.043f, -kMortar_m - 0.002f},
                {kCoverRadius + 0.032f, 0.006f},
                {kCoverRadius + 0.006f, 0.006f},
                {kCoverRadius, 0.003f},
                {kCoverRadius - 0.004f, -0.012f},
                {kCoverRadius - 0.008f, 0.002f},
                {kCoverRadius - 0.014f, 0.005f},
                {kCoverRadius - 0.045f, 0.005f},
                {kCoverRadius - 0.050f, 0.0f},
                {0.115f, 0.0f},
                {0.110f, 0.004f},
                {0.070f, 0.004f},
                {0.066f, 0.0f},
                {0.0f, 0.0f}},
               36);
    for (int j = -6; j <= 6; ++j) {
        for (int i = -6; i <= 6; ++i) {
            const vec2 p(0.043f * static_cast<float>(i), 0.043f * static_cast<float>(j));
            const float r = glm::length(p);
            if (r > kCoverRadius - 0.065f || r < 0.13f) continue;
            iron.box({.centre = foot + vec3(p.x, 0.001f, p.y),
                      .half = vec3(0.0125f, 0.004f, 0.0125f),
                      .bevel_m = 0.003f});
        }
    }
}

// A grating in the right gutter.
void add_grating(Kit& kit)
{
    MeshBuilder& iron = kit[Slot::Iron];
    const vec3 centre(0.5f * (kRoadHalf + kGutterEnd) + 0.005f, -0.036f, 0.9f);
    for (int i = 0; i < 9; ++i) {
        const float z = centre.z - 0.20f + 0.05f * static_cast<float>(i);
        iron.box({.centre = vec3(centre.x, centre.y, z),
                  .half = vec3(0.15f, 0.012f, 0.011f),
                  .bevel_m = 0.004f});
    }
    for (const float s : {-1.0f, 1.0f}) {
        iron.box({.centre = centre + vec3(0.145f * s, 0.003f, 0.0f),
                  .half = vec3(0.014f, 0.013f, 0.235f),
                  .bevel_m = 0.004f});
        iron.box({.centre = centre + vec3(0.0f, 0.003f, 0.235f * s),
                  .half = vec3(0.155f, 0.013f, 0.014f),
                  .bevel_m = 0.004f});
    }
    kit[Slot::Grass].color = vec4(0.05f, 0.04f, 0.05f, 1.0f);
    kit[Slot::Grass].quad(
        centre + vec3(-0.15f, -0.012f, 0.23f), centre + vec3(0.15f, -0.012f, 0.23f),
        centre + vec3(0.15f, -0.012f, -0.23f), centre + vec3(-0.15f, -0.012f, -0.23f));
    kit[Slot::Grass].color = vec4(1.0f);
}

}  // namespace

RoadPoint road_at(const Kit& kit, float x, float z)
{
    const float crown = 0.045f * (1.0f - x * x / (kRoadHalf * kRoadHalf));
    const float wobble_x =
        0.34f * ground_noise(kit, x, z, 1.1f, 1) + 0.10f * ground_noise(kit, x, z, 3.1f, 2);
    const float wobble_z =
        0.34f * ground_noise(kit, x, z, 1.1f, 3) + 0.10f * ground_noise(kit, x, z, 3.1f, 4);
    float dip = 0.0f;
    for (const Hollow& hollow : kHollows) {
        const float dx = (x + wobble_x - hollow.x) / hollow.radius_x;
        const float dz = (z + wobble_z - hollow.z) / hollow.radius_z;
        const float r2 = dx * dx + dz * dz;
        if (r2 < 9.0f) dip = std::max(dip, hollow.depth_m * std::exp(-0.9f * r2));
    }
    // Two wheel ruts, deeper here and there.
    const float rut = (std::abs(x + 0.2f * wobble_x) - 0.78f) / 0.20f;
    const float worn = 0.5f + 0.5f * ground_noise(kit, 0.25f * x, z, 0.7f, 5);
    const float rut_dip = 0.013f * std::max(worn, 0.0f) * std::exp(-rut * rut);
    const float inside = smooth_step(kRoadHalf, kRoadHalf - 0.25f, std::abs(x));
    dip = (dip + rut_dip) * inside;
    return {crown - dip, smooth_step(0.006f, 0.024f, dip)};
}

float pavement_height(float x)
{
    return kKerbTop + 0.012f * (std::abs(x) - kKerbEnd);
}

void add_ground(Kit& kit)
{
    add_carriageway(kit);
    for (const float side : {-1.0f, 1.0f}) {
        add_gutter(kit, side);
        add_kerb(kit, side);
    }
    add_pavement(kit, -kKerbEnd, kLeftWall - 0.2f, kNear, kGate);
    add_pavement(kit, kKerbEnd, kRightWall + 0.1f, kGarden + 0.1f, kGate);
    add_pavement(kit, -kKerbEnd, -4.4f, kGate, kFar);
    add_pavement(kit, kKerbEnd, 4.2f, kGate, kFar);
    add_cover(kit);
    add_grating(kit);

    // Earth under the joints of the gutters.
    MeshBuilder& grass = kit[Slot::Grass];
    grass.color = vec4(0.40f, 0.30f, 0.35f, 1.0f);
    for (const float side : {-1.0f, 1.0f}) {
        const float a = side < 0.0f ? -kKerbEnd : kRoadHalf - 0.1f;
        const float b = side < 0.0f ? -kRoadHalf + 0.1f : kKerbEnd;
        grass.quad(vec3(a, -0.075f, kNear), vec3(b, -0.075f, kNear), vec3(b, -0.075f, kFar),
                   vec3(a, -0.075f, kFar));
    }
    grass.color = vec4(1.0f);
    // The verge along the garden wall and the garden behind it.
    grass.grid(8, 40, [&](int i, int j) {
        const float x = kKerbEnd + 0.10f * static_cast<float>(i);
        const float z = kNear + (kGarden + 0.1f - kNear) * static_cast<float>(j) / 40.0f;
        const float mound = 0.02f * std::sin(3.14159265f * static_cast<float>(i) / 8.0f) +
                            0.012f * ground_noise(kit, x, z, 2.5f, 41);
        return MeshBuilder::Point{vec3(x, kKerbTop - 0.025f + mound, z), vec3(0, 1, 0), vec2(x, z),
                                  vec4(0.72f, 0.66f, 0.62f, 1.0f), vec4(1.0f, 0.0f, 1.0f, 1.0f)};
    });
    grass.grid(16, 24, [&](int i, int j) {
        const float x = kRightWall + 0.3f + 0.5f * static_cast<float>(i);
        const float z = kNear + (kGarden - kNear) * static_cast<float>(j) / 24.0f;
        return MeshBuilder::Point{vec3(x, 0.16f + 0.05f * ground_noise(kit, x, z, 0.8f, 42), z),
                                  vec3(0, 1, 0), vec2(x, z), vec4(1.0f),
                                  vec4(1.0f, 0.0f, 1.0f, 1.0f)};
    });
    // The land around, below everything else.
    constexpr float kLand = 60.0f;
    grass.quad(vec3(-kLand, -0.20f, kLand), vec3(kLand, -0.20f, kLand), vec3(kLand, -0.20f, -kLand),
               vec3(-kLand, -0.20f, -kLand));
}

}  // namespace petrichor::demo
