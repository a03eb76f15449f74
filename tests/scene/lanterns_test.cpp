// What stands around a lamp hides as much of it as of a ball that shines.
#include "scene/patches/lanterns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "formulas/codec/octahedral.h"

namespace petrichor::scene {
namespace {

constexpr glm::vec3 kLamp{3.0f, 2.0f, -5.0f};

Scene with_lamp(float radius_m = 0.1f)
{
    Scene scene;
    scene.materials.emplace_back();
    Light light;
    light.name = "lamp";
    light.position_m = kLamp;
    light.radius_m = radius_m;
    scene.lights.push_back(light);
    return scene;
}

// Corner, and two edges of a parallelogram, from the lamp.
void add(Scene& scene, const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v)
{
    const glm::vec3 at = kLamp + corner;
    Primitive part;
    part.positions = {at, at + u, at + u + v, at + v};
    part.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes.push_back({"part", {part}});
    scene.instances.emplace_back();
    scene.instances.back().mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

// As the device reads it, without the blend between texels.
glm::vec3 texel(const Scene& scene, const glm::vec3& away)
{
    const glm::vec2 at = (shared::octahedral_encode(glm::normalize(away)) * 0.5f + 0.5f) * static_cast<float>(kLightProfileSide);
    const glm::ivec2 i = glm::clamp(glm::ivec2(at), glm::ivec2(0), glm::ivec2(kLightProfileSide - 1));
    return scene.light_profiles[0].texels[static_cast<std::size_t>(i.y * kLightProfileSide + i.x)];
}

TEST(Lanterns, ALampAloneHasNone)
{
    Scene scene = with_lamp();
    add(scene, {-1, -2, -1}, {0, 0, 2}, {2, 0, 0});  // the floor
    EXPECT_THAT(shade_by_lanterns(scene), testing::IsEmpty());
    EXPECT_EQ(scene.lights[0].profile, -1);
    EXPECT_FALSE(scene.lights[0].in_lantern);
}

TEST(Lanterns, ARoofHidesTheLampFromAboveWithAPenumbra)
{
    Scene scene = with_lamp();
    add(scene, {-0.2f, 0.2f, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f});
    EXPECT_THAT(shade_by_lanterns(scene), testing::ElementsAre("lamp"));
    ASSERT_EQ(scene.lights[0].profile, 0);
    EXPECT_TRUE(scene.lights[0].in_lantern);
    EXPECT_EQ(texel(scene, {0, 1, 0}).x, 0.0f);
    EXPECT_NEAR(texel(scene, {0, 1, 0}).y, 0.2f, 1e-4f);
    EXPECT_EQ(texel(scene, {1, -0.2f, 0}).x, 1.0f);
    EXPECT_EQ(texel(scene, {0, -1, 0}).x, 1.0f);
    // Its edge lies 45 degrees up: half of the ball is seen past it there.
    EXPECT_NEAR(texel(scene, {1, 1, 0}).x, 0.5f, 0.08f);
    float before = 1.0f;
    for (float up = 0.0f; up < 3.0f; up += 0.1f) {
        const float seen = texel(scene, {1, up, 0}).x;
        EXPECT_LE(seen, before + 0.05f) << up;
        before = seen;
    }
}

// A bar of 2 cm before a ball of 20 cm: of its disc (4 / pi) x half the bar over the radius is hidden.
TEST(Lanterns, ABarHidesItsShareOfTheBall)
{
    Scene scene = with_lamp();
    add(scene, {0.2f, -0.5f, -0.01f}, {0, 1, 0}, {0, 0, 0.02f});
    ASSERT_EQ(shade_by_lanterns(scene).size(), 1u);
    EXPECT_NEAR(texel(scene, {1, 0, 0}).x, 1.0f - 4.0f / 3.14159265f * 0.1f, 0.06f);
    EXPECT_EQ(texel(scene, {0, 0, 1}).x, 1.0f);
    // What is hidden of all directions does not hang on the size of the ball.
    const auto hidden = [](const Scene& of) {
        double sum = 0.0, all = 0.0;
        for (int y = 0; y < kLightProfileSide; ++y) {
            for (int x = 0; x < kLightProfileSide; ++x) {
                const glm::vec2 p = (glm::vec2(x, y) + 0.5f) * (2.0f / kLightProfileSide) - 1.0f;
                const glm::vec3 flat(p.x, 1.0f - std::abs(p.x) - std::abs(p.y), p.y);  // its solid angle: by distance cubed
                const double area = std::pow(static_cast<double>(std::abs(p.x) + std::abs(p.y) > 1.0f
                                                                     ? glm::length(glm::vec3(1.0f - std::abs(p.y), std::abs(flat.y), 1.0f - std::abs(p.x)))
                                                                     : glm::length(flat)), -3.0);
                sum += area * (1.0 - static_cast<double>(of.light_profiles[0].texels[static_cast<std::size_t>(y * kLightProfileSide + x)].x));
                all += area;
            }
        }
        return sum / all;
    };
    Scene other = with_lamp(0.05f);
    add(other, {0.2f, -0.5f, -0.01f}, {0, 1, 0}, {0, 0, 0.02f});
    ASSERT_EQ(shade_by_lanterns(other).size(), 1u);
    EXPECT_NEAR(hidden(scene), hidden(other), 0.15 * hidden(other));
}

TEST(Lanterns, WithoutARadiusTheLampFillsSixTenths)
{
    Scene told = with_lamp(0.06f), guessed = with_lamp(0.0f);
    for (Scene* scene : {&told, &guessed}) {
        add(*scene, {-0.2f, 0.1f, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f});
        ASSERT_EQ(shade_by_lanterns(*scene).size(), 1u);
    }
    EXPECT_EQ(told.light_profiles[0].texels, guessed.light_profiles[0].texels);
}

TEST(Lanterns, WhatGlowsOrLetsLightThroughHidesNothing)
{
    for (int k = 0; k < 4; ++k) {
        Scene scene = with_lamp();
        add(scene, {-0.2f, 0.2f, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f});
        Material& m = scene.materials[0];
        if (k == 0) m.emissive = glm::vec3(1.0f);
        if (k == 1) m.alpha_mode = AlphaMode::Blend;
        if (k == 2) m.transmission = 1.0f;
        if (k == 3) m.casts_shadows = false;
        EXPECT_THAT(shade_by_lanterns(scene), testing::IsEmpty()) << k;
    }
}

TEST(Lanterns, LampsThatSayMoreAreLeftAsTheyAre)
{
    for (int k = 0; k < 5; ++k) {
        Scene scene = with_lamp(k == 0 ? 0.01f : 0.1f);
        add(scene, {-0.2f, 0.2f, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f});
        Light& light = scene.lights[0];
        if (k == 1) light.kind = LightKind::Spot;
        if (k == 2) light.length_m = 1.0f;
        if (k == 3) light.node = 0;
        if (k == 4) scene.instances[0].moves = true;
        EXPECT_THAT(shade_by_lanterns(scene), testing::IsEmpty()) << k;
        EXPECT_FALSE(light.in_lantern) << k;
    }
}

TEST(Lanterns, MoreThanAreLookedAtAreNamed)
{
    Scene scene = with_lamp();
    add(scene, {-0.2f, 0.2f, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f});
    Light nowhere = scene.lights[0];
    nowhere.position_m.x = std::nanf("");
    scene.lights.push_back(nowhere);
    scene.lights.resize(70, scene.lights[0]);
    EXPECT_EQ(shade_by_lanterns(scene).size(), 64u);
    EXPECT_THAT(scene.warnings, testing::ElementsAre(testing::HasSubstr("around 5 lamps behind the first 64")));
}

// A wall at the back: what lies behind it is dark, and the wall is told where it stands.
TEST(Lanterns, AWallHidesItsSide)
{
    Scene scene = with_lamp(0.0f);
    add(scene, {-4.0f, -2.0f, -0.15f}, {8, 0, 0}, {0, 6, 0});
    ASSERT_EQ(shade_by_lanterns(scene).size(), 1u);
    EXPECT_EQ(texel(scene, {0, 0, -1}).x, 0.0f);
    EXPECT_NEAR(texel(scene, {0, 0, -1}).y, 0.15f, 1e-3f);
    EXPECT_EQ(texel(scene, {0, 0, 1}).x, 1.0f);
}

}  // namespace
}  // namespace petrichor::scene
