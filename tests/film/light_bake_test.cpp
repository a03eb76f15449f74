// Light maps under a weather and a sun: what snow, sun and the choice of what is baked change.
#include "film/scenes/light_bake.h"

#include <gtest/gtest.h>

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
    ASSERT_EQ(map.sun_seen.size(), map.lux.size());
    // The ground has the 36 texels a side in the middle: 2 m x 4 m of its 64 m2, and the foot of the wall.
    ASSERT_EQ(map.size, 48);
    double dark = 0.0;
    for (int y = 6; y < 42; ++y) {
        for (int x = 6; x < 42; ++x)
            dark += 1.0 - static_cast<double>(map.sun_seen[static_cast<std::size_t>(y * map.size + x)]);
    }
    EXPECT_NEAR(dark / 1296.0, 10.0 / 64.0, 0.03);
    for (const float seen : map.sun_seen) {
        EXPECT_GE(seen, 0.0f);
        EXPECT_LE(seen, 1.0f);
    }
    sun.sun_elevation_degrees = -1.0;
    EXPECT_THROW(bake(scene, sun), Error);
}

}  // namespace
}  // namespace petrichor::film
