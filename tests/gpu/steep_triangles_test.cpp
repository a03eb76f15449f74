// What is shaded without puddles has none.
#include "gpu/upload/steep_triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "formulas/weather/surface_weather.h"
#include "gpu/upload/draw.h"

namespace petrichor::gpu {
namespace {

glm::vec3 direction(std::mt19937& random)
{
    std::normal_distribution<float> normal;
    return glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
}

GpuMaterial wet(bool mapped)
{
    GpuMaterial material;
    material.water = WATER_STANDS;
    if (mapped) material.slots = 1u << TEXTURE_HEIGHT;
    return material;
}

// A square of two triangles that faces `normal`.
std::vector<Vertex> square(const glm::vec3& normal, float side_m)
{
    const glm::vec3 right = glm::normalize(std::abs(normal.y) < 0.9f ? glm::cross(glm::vec3(0, 1, 0), normal)
                                                                     : glm::cross(glm::vec3(1, 0, 0), normal));
    const glm::vec3 up = glm::cross(normal, right);
    std::vector<Vertex> corners(4);
    for (int k = 0; k < 4; ++k) {
        corners[static_cast<std::size_t>(k)].position = side_m * (static_cast<float>(k & 1) * right + static_cast<float>(k >> 1) * up);
        corners[static_cast<std::size_t>(k)].normal = normal;
    }
    return corners;
}

struct Built {
    std::vector<Draw> draws;
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;

    Draw& add(const glm::vec3& normal, float side_m)
    {
        Draw draw;
        draw.vertex_offset = static_cast<std::int32_t>(vertices.size());
        draw.vertex_count = 4;
        draw.first_index = static_cast<std::uint32_t>(indices.size());
        draw.index_count = draw.most_indices = 6;
        for (const Vertex& v : square(normal, side_m)) vertices.push_back(v);
        for (const std::uint32_t i : {0u, 1u, 2u, 2u, 1u, 3u}) indices.push_back(i);
        draws.push_back(draw);
        return draws.back();
    }
    SteepTriangles steep(const GpuMaterial& material) const
    {
        return steep_triangles(draws, std::span(&material, 1), vertices, indices);
    }
};

TEST(SteepTriangles, NowhereBetweenTheirCornersIsLevelEnoughForWater)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> share(0.0f, 1.0f);
    int dry = 0, upright = 0;
    for (int i = 0; i < 20000; ++i) {
        const bool mapped = i % 2 != 0;
        const float from = water_stands_from(wet(mapped));
        const float spread = 2.0f * share(random);
        const glm::vec3 middle = direction(random);
        glm::vec3 n[3];
        for (glm::vec3& corner : n) corner = glm::normalize(middle + spread * direction(random));
        const std::uint8_t bits = steep_bits(n[0], n[1], n[2], from);
        if (bits == 0) continue;
        dry += bits & SteepTriangles::kDry;
        upright += (bits & SteepTriangles::kUpright) / SteepTriangles::kUpright;
        for (int k = 0; k < 30; ++k) {
            float b = share(random), c = share(random);
            if (b + c > 1.0f) b = 1.0f - b, c = 1.0f - c;
            // Corners may be of any length: of what is drawn larger along one axis they are.
            const glm::vec3 at = glm::normalize((1.0f - b - c) * n[0] * (0.1f + share(random)) + b * n[1] + c * n[2]);
            for (const float up : {at.y, -at.y}) {
                const float level = mapped ? shared::smooth_edge(0.55f, 0.9f, up) : shared::level_ground(up);
                ASSERT_EQ(level, 0.0f) << up;
                if ((bits & SteepTriangles::kUpright) != 0) {
                    ASSERT_LE(up, 0.3f);
                }
            }
        }
    }
    EXPECT_GT(dry, 5000);
    EXPECT_GT(upright, 1000);
}

TEST(SteepTriangles, WallsAreAndFloorsAreNot)
{
    Built scene;
    scene.add({0.0f, 0.0f, 1.0f}, 1.0f);
    scene.add({0.0f, 1.0f, 0.0f}, 1.0f);
    scene.add({0.6f, 0.8f, 0.0f}, 1.0f);
    const SteepTriangles plain = scene.steep(wet(false));
    EXPECT_EQ(plain.whole, (std::vector<std::uint8_t>{3, 0, 1}));
    EXPECT_EQ(plain.some[0], 3);
    EXPECT_EQ(plain.all[0], 0);
    // A height map holds water on slopes, too.
    EXPECT_EQ(scene.steep(wet(true)).whole, (std::vector<std::uint8_t>{3, 0, 0}));
    GpuMaterial dry;
    EXPECT_EQ(scene.steep(dry).whole, (std::vector<std::uint8_t>{0, 0, 0}));
}

TEST(SteepTriangles, AreThoseOfTheSceneAsItStands)
{
    Built scene;
    Draw& tilted = scene.add({0.0f, 1.0f, 0.0f}, 1.0f);
    tilted.to_world = glm::mat4(glm::vec4(0, 1, 0, 0), glm::vec4(-1, 0, 0, 0), glm::vec4(0, 0, 1, 0), glm::vec4(0, 0, 0, 1));
    scene.add({0.0f, 0.0f, 1.0f}, 1.0f).moving = 0;
    const SteepTriangles steep = scene.steep(wet(false));
    EXPECT_EQ(steep.whole, (std::vector<std::uint8_t>{3, 0}));
    EXPECT_EQ(steep.all[0], 0) << "what moves may lie down";
}

TEST(SteepTriangles, TooLittleOfAMaterialHasNoListOfItsOwn)
{
    Built scene;
    scene.add({0.0f, 1.0f, 0.0f}, 10.0f);
    scene.add({1.0f, 0.0f, 0.0f}, 1.0f);
    const SteepTriangles steep = scene.steep(wet(false));
    EXPECT_EQ(steep.whole, (std::vector<std::uint8_t>{0, 0}));
    EXPECT_EQ(steep.some[0], 0);
}

TEST(SteepTriangles, WhatIsNoNumberIsNotSteep)
{
    const glm::vec3 wall(1.0f, 0.0f, 0.0f), none(std::nanf(""));
    EXPECT_EQ(steep_bits(wall, none, wall, 0.55f), 0);
    EXPECT_EQ(steep_bits(wall, -wall, wall, 0.55f), 0) << "between opposite ones lies any direction";
    EXPECT_EQ(steep_bits(wall, wall, wall, 0.55f), 3);
}

}  // namespace
}  // namespace petrichor::gpu
