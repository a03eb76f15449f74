// Light maps under a weather and a sun: what snow, sun and the choice of what is baked change.
#include "film/scenes/light_bake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "tests/scene/patch_scenes.h"

namespace petrichor::film {
namespace {

using namespace scene::patch_scenes;

// A pillar on dark ground of 60 m.
scene::Scene pillar()
{
    scene::Scene scene = empty_scene();
    scene.materials[0].name = "ground";
    scene.materials[0].base_color = {0.1f, 0.1f, 0.1f, 1.0f};
    scene.materials[0].metallic = 0.0f;
    add_face(scene, {-30, 0, -30}, {0, 0, 60}, {60, 0, 0});
    scene::Material stone;
    stone.name = "stone";
    stone.metallic = 0.0f;
    add_box(scene, {-0.4f, 0, -0.4f}, {0.4f, 2, 0.4f}, false, add_material(scene, stone));
    unwrap(scene);
    return scene;
}

scene::LightMaps bake(const scene::Scene& scene, const BakeConditions& conditions,
                      std::vector<std::string>* said = nullptr)
{
    scene::BakeOptions options;
    options.size = 48;
    options.rays = 256;
    std::vector<std::string> notes;
    TransportOptions transport;
    transport.patches.cell_m = 1.0f;
    transport.patches.rays = 64;
    scene::LightMaps maps = bake_light(scene, conditions, transport, options, notes);
    if (said) *said = notes;
    return maps;
}

// The middle of the square of a face, of 7 in all: 3 across.
float face(const scene::LightMap& map, int number)
{
    const int x = map.size * (2 * (number % 3) + 1) / 6, y = map.size * (2 * (number / 3) + 1) / 6;
    return map.lux[static_cast<std::size_t>(y * map.size + x)].y;
}
float walls(const scene::LightMap& map)
{
    return 0.25f * (face(map, 3) + face(map, 4) + face(map, 5) + face(map, 6));
}

// A wall gets .396 of what an overcast sky brings to open ground (CIE overcast), and half of what the
// ground sends back. The ground's colour: what it scatters and what it mirrors, 0.1 * 0.96 + 0.04.
TEST(LightBake, SnowOnTheGroundLightsTheWall)
{
    const scene::Scene scene = pillar();
    std::vector<std::string> notes;
    const auto dry = bake(scene, {.sky_lux = 10000.0}, &notes);
    const auto white = bake(scene, {.sky_lux = 10000.0, .snow = 1.0});
    ASSERT_EQ(dry.maps.size(), 2u);
    EXPECT_NEAR(face(dry.maps[0], 0), 10000.0f, 200.0f) << "open ground";
    EXPECT_NEAR(walls(dry.maps[1]), 10000.0f * (0.396f + 0.5f * 0.136f), 400.0f);
    EXPECT_NEAR(walls(white.maps[1]), 10000.0f * (0.396f + 0.5f * 0.93f), 500.0f);
}

TEST(LightBake, IndirectLeavesTheSunOutAndKeepsItsBounces)
{
    const scene::Scene scene = pillar();
    BakeConditions sun{.sky_lux = 0.0, .sun_lux = 50000.0, .sun_elevation_degrees = 90.0};
    const auto all = bake(scene, sun);
    sun.indirect = true;
    const auto indirect = bake(scene, sun);
    EXPECT_NEAR(face(all.maps[0], 0) - face(indirect.maps[0], 0), 50000.0f, 1.0f);
    EXPECT_NEAR(face(indirect.maps[0], 0), 0.0f, 200.0f) << "nothing above it sends light down";
    // Walls see no sun from straight above; what they have comes from the ground.
    EXPECT_NEAR(walls(all.maps[1]), walls(indirect.maps[1]), 1.0f);
    EXPECT_NEAR(walls(indirect.maps[1]), 50000.0f * 0.5f * 0.136f, 500.0f);
}

// The sun stands in the east, 45 degrees high: a pillar of 2 m shadows 2 m of ground west of it.
TEST(LightBake, AShadowMaskIsWhereTheSunIsSeen)
{
    scene::Scene scene = empty_scene();
    add_face(scene, {-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
    unwrap(scene);
    scene::Material stone;
    stone.metallic = 0.0f;
    add_box(scene, {0, 0, -2}, {0.5f, 2, 2}, false, add_material(scene, stone));
    BakeConditions sun{.sky_lux = 0.0, .sun_lux = 50000.0, .sun_azimuth_degrees = 90.0,
                       .indirect = true, .shadow_mask = true};
    const auto baked = bake(scene, sun);
    const scene::LightMap& map = baked.maps[0];
    ASSERT_EQ(map.seen.size(), map.lux.size());
    // The ground has the 36 texels a side in the middle: 2 m x 4 m of its 64 m2, and the foot of the wall.
    ASSERT_EQ(map.size, 48);
    double dark = 0.0;
    for (int y = 6; y < 42; ++y) {
        for (int x = 6; x < 42; ++x)
            dark += 1.0 - static_cast<double>(map.seen[static_cast<std::size_t>(y * map.size + x)].x);
    }
    EXPECT_NEAR(dark / 1296.0, 10.0 / 64.0, 0.03);
    for (const glm::vec4& seen : map.seen) {
        EXPECT_GE(seen.x, 0.0f);
        EXPECT_LE(seen.x, 1.0f);
        if (seen.x + seen.y > 0.0f) {
            EXPECT_EQ(glm::vec3(seen.y, seen.z, seen.w), glm::vec3(1.0f)) << "there is no lamp";
        }
    }
    sun.sun_elevation_degrees = -1.0;
    EXPECT_THROW(bake(scene, sun), Error);
}

scene::Light bulb(const std::string& name, glm::vec3 at, float candela)
{
    scene::Light lamp;
    lamp.name = name;
    lamp.position_m = at;
    lamp.intensity = candela;
    return lamp;
}

// A pillar between two lamps, and a third one far away: each texel of the ground against the ray to the lamp
// of its channel, cut with the pillar's sides.
TEST(LightBake, AShadowMaskHoldsLampsByTheirChannels)
{
    scene::Scene scene = empty_scene();
    add_face(scene, {-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
    unwrap(scene);
    const glm::vec3 low{-0.5f, 0, -0.5f}, high{0.5f, 2, 0.5f};
    add_box(scene, low, high, false, add_material(scene, {}));
    scene.lights = {bulb("left", {-3, 3, 1}, 100.0f), bulb("right", {3, 4, 0}, 300.0f),
                    bulb("far away", {0, 3, 500}, 200.0f), bulb("faint", {0, 3, 3}, 1.0f)};
    std::vector<std::string> notes;
    const auto baked = bake(scene, {.sky_lux = 0.0, .shadow_mask = true}, &notes);
    EXPECT_EQ(baked.channels, (std::vector<int>{2, 1, 1, 3})) << "the strongest first; what is far away shares";
    const auto hidden = [&](glm::vec3 from, glm::vec3 to) {
        float enter = 0.0f, leave = 1.0f;
        for (int i = 0; i < 3; ++i) {
            const float a = (low[i] - from[i]) / (to[i] - from[i]), b = (high[i] - from[i]) / (to[i] - from[i]);
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        return enter < leave;
    };
    const scene::LightMap& map = baked.maps[0];
    for (const std::size_t lamp : {0u, 1u, 3u}) {
        double wrong = 0.0, dark = 0.0;
        int asked = 0;
        for (int y = 6; y < 42; ++y) {
            for (int x = 6; x < 42; ++x) {
                // As add_face lays it: u along z, v along x.
                const glm::vec3 at{(static_cast<float>(y) - 5.5f) / 36.0f * 8.0f - 4.0f, 0.0f,
                                   (static_cast<float>(x) - 5.5f) / 36.0f * 8.0f - 4.0f};
                if (std::abs(at.x) < 0.6f && std::abs(at.z) < 0.6f) continue;  // below the pillar
                const bool shade = hidden(at, scene.lights[lamp].position_m);
                const float seen = map.seen[static_cast<std::size_t>(y * map.size + x)][baked.channels[lamp]];
                wrong += std::abs(static_cast<double>(seen) - (shade ? 0.0 : 1.0));
                dark += shade ? 1.0 : 0.0;
                ++asked;
            }
        }
        EXPECT_GT(dark / asked, 0.02) << scene.lights[lamp].name;
        EXPECT_LT(wrong / asked, 0.02) << scene.lights[lamp].name << ": texels that an edge crosses";
    }
    // One too many where all meet: the faintest has none, and is named. By choice others have them.
    scene.lights.push_back(bulb("dim", {1, 3, 3}, 0.5f));
    EXPECT_EQ(bake(scene, {.sky_lux = 0.0, .shadow_mask = true}, &notes).channels.back(), 0);
    EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& n) {
        return n.find("\"dim\" has no channel") != std::string::npos;
    }));
    EXPECT_EQ(bake(scene, {.sky_lux = 0.0, .shadow_mask = true, .mask_lamps = "dim"}).channels,
              (std::vector<int>{0, 0, 0, 0, 1}));
    EXPECT_THROW(bake(scene, {.sky_lux = 0.0, .shadow_mask = true, .mask_lamps = "dimm"}), Error);
}

}  // namespace
}  // namespace petrichor::film
