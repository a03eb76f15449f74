// Light maps as they are baked: furnace, white sky, shadows, lamps, gaps, and the same bits each time.
#include "scene/patches/light_map.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "base/error.h"
#include "formulas/noise/noise.h"
#include "scene/patches/mask_channels.h"
#include "tests/scene/patch_scenes.h"

namespace petrichor::scene {
namespace {

using namespace patch_scenes;

struct Baking {
    explicit Baking(const Scene& made) : scene(made), triangles(scene, {}), tracer(triangles)
    {
        PatchOptions cut;
        cut.cell_m = 0.5f;
        cut.rays = 32;
        patches = build_patches(tracer, cut);
        radiosity.assign(patches.count, glm::vec3(0.0f));
        sky.assign(shared::kSkyBins, glm::vec3(0.0f));
        options.size = 64;
        options.rays = 64;
        options.spread = 0;
    }
    LightMaps operator()() const
    {
        return bake_light_maps(tracer, patches, {radiosity, sky, lamps}, options);
    }
    Scene scene;
    Triangles triangles;
    Tracer tracer;
    Patches patches;
    std::vector<glm::vec3> radiosity, sky;
    std::vector<Light> lamps;
    BakeOptions options;
};

// A floor of 8 m about the origin that fills its map: u along z, v along x.
Scene floor_scene()
{
    Scene scene = empty_scene();
    add_face(scene, {-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
    return scene;
}

glm::vec3 at(const LightMap& map, float x, float z)
{
    const auto texel = [&](float m) {
        return static_cast<std::size_t>((m + 4.0f) / 8.0f * static_cast<float>(map.size));
    };
    return map.lux[texel(x) * static_cast<std::size_t>(map.size) + texel(z)];
}

TEST(LightMapBake, AFurnaceLightsEveryTexelAlike)
{
    Scene scene = room();
    unwrap(scene);
    Baking bake(scene);
    bake.radiosity.assign(bake.patches.count, glm::vec3(5.0f, 2.0f, 1.0f));
    const LightMaps baked = bake();
    ASSERT_EQ(baked.maps.size(), 1u);
    const LightMap& map = baked.maps[0];
    EXPECT_EQ(map.texcoord, 1);
    EXPECT_NEAR(map.covered, 6.0 / 9.0 * 0.75 * 0.75, 0.03);
    EXPECT_EQ(map.shared, 0.0);
    int lit = 0;
    for (const glm::vec3& lux : map.lux) {
        if (lux.x == 0.0f) continue;
        ++lit;
        ASSERT_NEAR(lux.x, 5.0f, 1e-4f);
        ASSERT_NEAR(lux.y, 2.0f, 1e-4f);
        ASSERT_NEAR(lux.z, 1.0f, 1e-4f);
    }
    EXPECT_NEAR(lit / 4096.0, map.covered, 1e-6);
}

TEST(LightMapBake, OpenGroundGetsTheWholeSky)
{
    Baking bake(floor_scene());
    bake.sky.assign(shared::kSkyBins, glm::vec3(7000.0f));
    const LightMap map = bake().maps.at(0);
    EXPECT_EQ(map.texcoord, 0) << "a mesh without second coordinates is baked over its first";
    EXPECT_EQ(map.covered, 1.0);
    for (const glm::vec3& lux : map.lux) ASSERT_NEAR(lux.x, 7000.0f, 0.01f);
}

// The darkest and the brightest part of a floor below a slab, closed form: the slab's form factor.
TEST(LightMapBake, ASlabTakesItsShareOfTheSky)
{
    Scene scene = floor_scene();
    Material slab;
    add_face(scene, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, add_material(scene, slab));
    Baking bake(scene);
    bake.options.rays = 1024;
    bake.sky.assign(shared::kSkyBins, glm::vec3(1.0f));
    const LightMap map = bake().maps.at(0);
    // A square of 2 x 2 m, 1 m above its middle (Howell's catalogue, B-4, four corners of 1 x 1).
    const double corner = 1.0 / std::numbers::sqrt2;
    const double factor =
        4.0 / (2.0 * std::numbers::pi) * 2.0 * corner * std::atan(corner);
    EXPECT_NEAR(static_cast<double>(at(map, 0.0f, 0.0f).x), 1.0 - factor, 0.03);
    EXPECT_GT(at(map, 3.5f, 3.5f).x, 0.97f);
}

TEST(LightMapBake, TheSunThrowsTheShadowOfThePlate)
{
    Scene scene = floor_scene();
    add_face(scene, {-1, 2, -1}, {0, 0, 2}, {2, 0, 0}, add_material(scene, Material{}));
    Baking bake(scene);
    Light sun;
    sun.kind = LightKind::Directional;
    sun.intensity = 80000.0f;
    sun.direction = glm::normalize(glm::vec3(0.5f, -1.0f, 0.0f));  // a metre along +x from 2 m up
    bake.lamps = {sun};
    const LightMap map = bake().maps.at(0);
    const float open = 80000.0f * -sun.direction.y;
    EXPECT_EQ(at(map, 1.0f, 0.0f).x, 0.0f);
    EXPECT_EQ(at(map, 0.3f, 0.8f).x, 0.0f);
    EXPECT_NEAR(at(map, -0.3f, 0.0f).x, open, 1.0f);
    EXPECT_NEAR(at(map, 2.3f, 0.0f).x, open, 1.0f);
    double dark = 0.0;
    for (const glm::vec3& lux : map.lux) dark += 1.0 - static_cast<double>(lux.x / open);
    EXPECT_NEAR(dark / 4096.0 * 64.0, 4.0, 0.15) << "m2 of shadow";
}

TEST(LightMapBake, ALampFallsOffBySquareAndCosine)
{
    Baking bake(floor_scene());
    Light lamp;
    lamp.intensity = 900.0f;
    lamp.position_m = {1.0f, 3.0f, 0.0f};
    bake.lamps = {lamp};
    const LightMap map = bake().maps.at(0);
    for (const float x : {-3.0f, 0.0f, 1.0f, 2.0f}) {
        const float d = x + 0.0625f - 1.0f;  // the texel's middle
        const float r2 = d * d + 9.0f + 0.0625f * 0.0625f;
        EXPECT_NEAR(at(map, x, 0.0f).x, 900.0f * 3.0f / (r2 * std::sqrt(r2)), 0.2f) << x;
    }
}

// Under a box that stands on the floor lies no light, and its darkness must not leak out from there.
TEST(LightMapBake, WhatLiesInsideABodyIsAGap)
{
    Scene scene = floor_scene();
    add_box(scene, {-1, 0, -1}, {1, 2, 1}, false, add_material(scene, Material{}));
    Baking bake(scene);
    bake.sky.assign(shared::kSkyBins, glm::vec3(100.0f));
    bake.radiosity.assign(bake.patches.count, glm::vec3(30.0f));
    EXPECT_EQ(at(bake().maps.at(0), 0.0f, 0.0f).x, 0.0f);
    bake.options.spread = 16;
    const LightMap map = bake().maps.at(0);
    for (const glm::vec3& lux : map.lux) {
        ASSERT_GT(lux.x, 30.0f);
        ASSERT_LE(lux.x, 100.01f);
    }
}

TEST(LightMapBake, SurfacesThatShareTexelsAreCounted)
{
    Scene twice = floor_scene();
    add_face(twice, {-4, 3, -4}, {0, 0, 8}, {8, 0, 0});
    EXPECT_EQ(Baking(twice)().maps.at(0).shared, 1.0);
    Scene tiled = floor_scene();
    for (glm::vec2& uv : tiled.meshes[0].primitives[0].uv0) uv *= 3.0f;
    const LightMaps none = Baking(tiled)();
    EXPECT_TRUE(none.maps.empty());
    EXPECT_EQ(none.left_out, std::vector<std::uint32_t>{0});
}

TEST(LightMapBake, IsTheSameForAnyNumberOfThreads)
{
    Scene scene = floor_scene();
    add_box(scene, {-1, 0, -1}, {1, 2, 1}, false, add_material(scene, Material{}));
    Baking bake(scene);
    bake.sky.assign(shared::kSkyBins, glm::vec3(100.0f));
    bake.options.spread = 4;
    bake.options.threads = 1;
    const LightMaps one = bake();
    bake.options.threads = 3;
    const LightMaps three = bake();
    ASSERT_EQ(one.maps.size(), three.maps.size());
    for (std::size_t i = 0; i < one.maps.size(); ++i) {
        EXPECT_EQ(std::memcmp(one.maps[i].lux.data(), three.maps[i].lux.data(),
                              one.maps[i].lux.size() * sizeof(glm::vec3)),
                  0);
    }
}

TEST(LightMapBake, RefusesOptionsOutOfRange)
{
    Baking bake(floor_scene());
    bake.options.size = 4;
    EXPECT_THROW(bake(), Error);
    bake.options.size = 64;
    bake.options.rays = 100000;
    EXPECT_THROW(bake(), Error);
}

// Of lamps thrown at random: who shares a channel does not meet, and who has none meets one of each.
TEST(MaskChannels, LampsThatShareOneDoNotMeet)
{
    std::vector<Light> lamps(60);
    for (std::uint32_t i = 0; i < 60; ++i) {
        const auto random = [&](std::uint32_t k) { return shared::hash_f(shared::hash_u3(i, k, 7u)); };
        lamps[i].name = "lamp " + std::to_string(i);
        lamps[i].kind = i % 3 == 0 ? LightKind::Spot : LightKind::Point;
        lamps[i].position_m = 100.0f * glm::vec3(random(0), 0.1f * random(1), random(2));
        lamps[i].direction = glm::normalize(glm::vec3(random(3), random(4), random(5)) - 0.5f);
        lamps[i].outer_cone_rad = 0.2f + 1.2f * random(6);
        lamps[i].intensity = 1.0f + 40.0f * random(8);
        if (i % 2 == 0) lamps[i].range_m = 20.0f * random(9);
    }
    const std::vector<int> channels = mask_channels(lamps);
    const auto meet = [&](std::size_t i, std::size_t k) {
        const LampReach a = lamp_reach(lamps[i]), b = lamp_reach(lamps[k]);
        return glm::length(a.centre_m - b.centre_m) < a.radius_m + b.radius_m;
    };
    int without = 0, shared_ones = 0;
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        std::array<bool, kMaskChannels + 1> met{};
        for (std::size_t k = 0; k < lamps.size(); ++k) {
            if (k == i || !meet(i, k)) continue;
            met[static_cast<std::size_t>(channels[k])] = true;
            EXPECT_FALSE(channels[i] > 0 && channels[i] == channels[k]) << i << " " << k;
        }
        if (channels[i] == 0) {
            ++without;
            EXPECT_TRUE(met[1] && met[2] && met[3]) << i;
        }
        for (std::size_t k = 0; k < i; ++k) shared_ones += channels[i] > 0 && channels[i] == channels[k];
    }
    EXPECT_GT(without, 0);
    EXPECT_GT(shared_ones, 20);
    // What a ball holds: no place in the cone, as far as the lamp reaches, is outside.
    for (std::size_t i = 0; i < lamps.size(); i += 3) {
        const LampReach ball = lamp_reach(lamps[i]);
        const float far_m = lamps[i].range_m > 0.0f ? lamps[i].range_m : std::sqrt(lamps[i].intensity / kMaskLeast_lux);
        const glm::vec3 d = lamps[i].direction;
        const glm::vec3 side = glm::normalize(glm::cross(d, std::abs(d.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
        for (const float angle : {0.0f, 0.5f, 1.0f}) {
            const float turn = angle * lamps[i].outer_cone_rad;
            const glm::vec3 way = d * std::cos(turn) + side * std::sin(turn);
            for (const float share : {0.0f, 0.5f, 1.0f})
                EXPECT_LE(glm::length(lamps[i].position_m + way * (share * far_m) - ball.centre_m), ball.radius_m * 1.0001f);
        }
    }
    // Of one name: together or not at all.
    std::vector<Light> twins(2);
    twins[0].name = twins[1].name = "twin";
    twins[1].position_m = {0.5f, 0, 0};
    EXPECT_EQ(mask_channels(twins), (std::vector<int>{0, 0}));
    twins[1].position_m = {50.0f, 0, 0};
    EXPECT_EQ(mask_channels(twins), (std::vector<int>{1, 1}));
    EXPECT_EQ(mask_channels(twins, {true, false}), (std::vector<int>{1, 0}));
}

}  // namespace
}  // namespace petrichor::scene
