// The houses along the street: brick, plaster and timber.
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
    for (const float z : {6.4f, 3.1f, 0.62f, -1.75f, -3.95f})
        upper.push_back({u(z), u(z - 1.15f), 3.30f, 4.72f});
    openings.insert(openings.end(), upper.begin(), upper.end());
    add_wall(kit, Slot::Brick, front, kWidth, kEave, openings);
    add_door(kit, Slot::Brick, front, door, vec4(0.085f, 0.14f, 0.19f, 1.0f));
    add_window(
        kit, Slot::Brick, front, shop,
        {.panes_u = 4, .panes_v = 2, .lit = true, .paint = vec4(0.085f, 0.14f, 0.19f, 1.0f)});
    for (const Opening& o : low) add_window(kit, Slot::Brick, front, o, {});
    for (std::size_t i = 0; i < upper.size(); ++i) {
        add_window(kit, Slot::Brick, front, upper[i], {.lit = i == 3, .flowers = i >= 3});
    }
    // A string course between the floors, and a plinth.
    add_box(kit, Slot::Granite, front, {0.0f, 2.98f, -0.05f}, {kWidth, 3.10f, 0.05f}, 0.012f, 0);
    const float plinth[] = {0.0f, door.u0 - 0.1f, door.u1 + 0.1f, kWidth};
    for (const int k : {0, 2}) {
        add_box(kit, Slot::Granite, front, {plinth[k], -0.05f, -0.05f},
                {plinth[k + 1], 0.34f, 0.035f}, 0.014f, 0);
    }

    MeshBuilder& brick = kit[Slot::Brick];
    for (const float z : {kStart, kEnd}) {
        const bool near_side = z == kStart;
        const vec3 a(kLeftWall, 0.0f, z), b(kLeftWall - kDepth, 0.0f, z);
        const vec3 up(0.0f, kEave, 0.0f);
        const vec3 top(kLeftWall - 0.5f * kDepth, kEave + 3.0f, z);
        if (near_side) {
            brick.quad(b, a, a + up, b + up);
            kit[Slot::Brick].triangle(b + up, a + up, top);
        } else {
            brick.quad(a, b, b + up, a + up);
            kit[Slot::Brick].triangle(a + up, b + up, top);
        }
    }
    brick.quad(vec3(kLeftWall - kDepth, 0, kEnd), vec3(kLeftWall - kDepth, 0, kStart),
               vec3(kLeftWall - kDepth, kEave, kStart), vec3(kLeftWall - kDepth, kEave, kEnd));
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
    std::vector<Opening> windows = {
        {2.25f, 3.35f, 1.0f, 2.35f}, {0.65f, 1.55f, 3.0f, 4.15f}, {2.45f, 3.35f, 3.0f, 4.15f}};
    std::vector<Opening> openings = windows;
    openings.push_back(door);
    const vec3 kRose(1.0f, 0.80f, 0.66f);
    add_wall(kit, Slot::Plaster, front, kWidth, kEave, openings, kRose);
    add_door(kit, Slot::Plaster, front, door, vec4(0.20f, 0.055f, 0.035f, 1.0f));
    for (std::size_t i = 0; i < windows.size(); ++i) {
        add_window(kit, Slot::Plaster, front, windows[i],
                   {.lit = i == 0, .lintel = false, .shutters = i > 0, .flowers = i > 0});
    }
    MeshBuilder& plaster = kit[Slot::Plaster];
    plaster.color = vec4(kRose, 1.0f);
    const vec3 up(0.0f, kEave, 0.0f);
    const vec3 a(front.origin), b(front.origin - vec3(kDepth, 0, 0));
    plaster.quad(b, a, a + up, b + up);
    kit[Slot::Plaster].triangle(b + up, a + up, 0.5f * (a + b) + vec3(0.0f, kEave + 2.6f, 0.0f));
    plaster.color = vec4(1.0f);
    add_roof(kit, front, {.width = kWidth, .depth = kDepth, .eave_v = kEave, .rise = 2.6f});
    add_chimney(kit, front.origin + vec3(-1.6f, kEave + 1.2f, -3.4f), 2.4f);
}

void add_beam(Kit& kit, const Frame& frame, vec2 from, vec2 to, float width, float proud = 0.022f)
{
    // Sunk into the plaster so that only `proud` shows.
    const std::uint32_t h = hash_cell(static_cast<int>(std::lround(from.x * 100.0f)),
                                      static_cast<int>(std::lround(to.y * 100.0f)), kit.seed + 9u);
    MeshBuilder& timber = kit[Slot::Timber];
    const float light = 0.36f + 0.22f * hash_unit(h, 1);
    timber.color = vec4(light, light * 0.97f, light * 0.94f, 1.0f);
    timber.uv_offset_m = vec2(0.15f * std::floor(8.0f * hash_unit(h, 2)) + 0.075f, hash_unit(h, 3));
    timber.beam(frame.at(from.x, from.y, proud - 0.06f), frame.at(to.x, to.y, proud - 0.06f), width,
                0.12f, 0.010f, frame.out);
    timber.uv_offset_m = vec2(0.0f);
    timber.color = vec4(1.0f);
}

// Posts, rails and braces over a rectangle of plaster.
void add_timber_frame(Kit& kit, const Frame& frame, float width, float v0, float v1, int bays,
                      bool braces)
{
    constexpr float kPost = 0.17f;
    add_beam(kit, frame, {0.0f, v0 + 0.5f * kPost}, {width, v0 + 0.5f * kPost}, kPost, 0.03f);
    add_beam(kit, frame, {0.0f, v1 - 0.5f * kPost}, {width, v1 - 0.5f * kPost}, kPost, 0.03f);
    for (int i = 0; i <= bays; ++i) {
        const float u =
            0.5f * kPost + (width - kPost) * static_cast<float>(i) / static_cast<float>(bays);
        add_beam(kit, frame, {u, v0 + kPost}, {u, v1 - kPost}, i == 0 || i == bays ? kPost : 0.14f,
                 0.026f);
    }
    const float rail = v0 + 0.42f * (v1 - v0);
    add_beam(kit, frame, {kPost, rail}, {width - kPost, rail}, 0.12f, 0.018f);
    if (!braces) return;
    const float bay = (width - kPost) / static_cast<float>(bays);
    add_beam(kit, frame, {kPost + 0.02f, v0 + kPost}, {bay + 0.02f, v1 - kPost - 0.1f}, 0.13f,
             0.022f);
    add_beam(kit, frame, {width - kPost - 0.02f, v0 + kPost},
             {width - bay - 0.02f, v1 - kPost - 0.1f}, 0.13f, 0.022f);
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
    const Opening low[] = {
        {1.0f, 2.1f, 0.95f, 2.15f}, {2.85f, 3.95f, 0.95f, 2.15f}, {6.25f, 7.35f, 0.95f, 2.15f}};
    add_wall(kit, Slot::Plaster, ground, kWidth, kFloor, {door, low[0], low[1], low[2]});
    add_door(kit, Slot::Plaster, ground, door, vec4(0.055f, 0.10f, 0.06f, 1.0f));
    const vec4 white(0.72f, 0.70f, 0.64f, 1.0f);
    for (int i = 0; i < 3; ++i) {
        add_window(kit, Slot::Plaster, ground, low[i],
                   {.lit = i == 2, .lintel = false, .paint = white});
    }
    add_box(kit, Slot::Granite, ground, {0.0f, -0.05f, -0.05f}, {door.u0 - 0.1f, 0.42f, 0.04f},
            0.016f, 0);
    add_box(kit, Slot::Granite, ground, {door.u1 + 0.1f, -0.05f, -0.05f}, {kWidth, 0.42f, 0.04f},
            0.016f, 0);

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
        add_window(kit, Slot::Plaster, upper_wall, shifted[i],
                   {.panes_u = 2,
                    .panes_v = 2,
                    .lit = i == 1,
                    .lintel = false,
                    .depth_m = 0.07f,
                    .paint = white});
    }
    add_timber_frame(kit, upper, kWidth, kFloor, kEave, kBays, true);
    // The jetty: joist ends under the upper floor.
    kit[Slot::Timber].quad(upper.at(0.0f, kFloor), ground.at(0.0f, kFloor),
                           ground.at(kWidth, kFloor), upper.at(kWidth, kFloor), vec3(1, 0, 0));
    for (float u = 0.25f; u < kWidth; u += 0.62f) {
        kit[Slot::Timber].color = vec4(0.50f, 0.48f, 0.46f, 1.0f);
        add_box(kit, Slot::Timber, upper, {u, kFloor - 0.14f, -kJetty - 0.1f},
                {u + 0.14f, kFloor + 0.02f, 0.05f}, 0.012f, 2);
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
    add_box(kit, Slot::Granite, low_wall, {0.0f, -0.05f, -0.05f}, {kDepth, 0.42f, 0.04f}, 0.016f,
            0);
    Frame high_wall = gable;
    high_wall.origin.y = kFloor;
    const Opening high{gable_top.u0, gable_top.u1, gable_top.v0 - kFloor, gable_top.v1 - kFloor};
    add_wall(kit, Slot::Plaster, high_wall, kGableWidth, kEave - kFloor, {high});
    add_window(kit, Slot::Plaster, high_wall, high,
               {.panes_v = 2, .lit = false, .lintel = false, .depth_m = 0.07f, .paint = white});
    add_timber_frame(kit, gable, kGableWidth, kFloor, kEave, 5, true);
    const float rise = 2.9f;
    const vec3 apex = gable.at(0.5f * kGableWidth, kEave + rise);
    kit[Slot::Plaster].triangle(gable.at(0.0f, kEave), gable.at(kGableWidth, kEave), apex);
    const float half = 0.5f * kGableWidth;
    add_beam(kit, gable, {0.1f, kEave + 0.06f}, {half, kEave + rise - 0.05f}, 0.15f, 0.03f);
    add_beam(kit, gable, {kGableWidth - 0.1f, kEave + 0.06f}, {half, kEave + rise - 0.05f}, 0.15f,
             0.03f);
    add_beam(kit, gable, {half, kEave}, {half, kEave + rise - 0.15f}, 0.14f, 0.026f);
    add_beam(kit, gable, {0.5f * half, kEave + 0.42f * rise}, {1.5f * half, kEave + 0.42f * rise},
             0.12f, 0.022f);
    for (const float s : {-1.0f, 1.0f}) {
        add_beam(kit, gable, {half + 0.5f * s * half, kEave},
                 {half + 0.5f * s * half, kEave + 0.42f * rise}, 0.12f, 0.022f);
    }
    Frame roof_frame = upper;
    add_roof(kit, roof_frame,
             {.width = kWidth, .depth = kGableWidth, .eave_v = kEave, .rise = rise});
    MeshBuilder& plaster = kit[Slot::Plaster];
    const vec3 back = vec3(kRightWall + kDepth, 0.0f, 0.0f);
    plaster.quad(vec3(back.x, 0, kGarden), vec3(back.x, 0, kGate), vec3(back.x, kEave, kGate),
                 vec3(back.x, kEave, kGarden));
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
    const Opening windows[] = {{3.4f, 4.3f, 1.0f, 2.3f},
                               {5.9f, 6.8f, 1.0f, 2.3f},
                               {3.4f, 4.3f, 3.2f, 4.4f},
                               {5.9f, 6.8f, 3.2f, 4.4f}};
    add_wall(kit, Slot::Plaster, end, 10.0f, 5.0f, {windows[0], windows[1], windows[2], windows[3]},
             vec3(0.92f, 0.93f, 0.90f));
    for (int i = 0; i < 4; ++i)
        add_window(kit, Slot::Plaster, end, windows[i],
                   {.lit = i == 1, .lintel = false, .shutters = true});
    add_roof(kit, end, {.width = 10.0f, .depth = 5.0f, .eave_v = 5.0f, .rise = 3.0f});
    for (const float side : {-1.0f, 1.0f}) {
        kit[Slot::Cobble].box({.centre = vec3(4.2f * side, 0.9f, 0.5f * (kGate - 1.8f + kFar)),
                               .half = vec3(0.25f, 0.95f, 0.5f * (kGate - 1.8f - kFar)),
                               .bevel_m = 0.02f});
        kit[Slot::Granite].box({.centre = vec3(4.2f * side, 1.90f, 0.5f * (kGate - 1.8f + kFar)),
                                .half = vec3(0.32f, 0.06f, 0.5f * (kGate - 1.8f - kFar)),
                                .bevel_m = 0.02f});
    }
}

}  // namespace petrichor::demo
