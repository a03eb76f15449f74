// Quads of a cube map: where they lie, and that they know no edges.
#include <gtest/gtest.h>

#include <random>

#include "formulas/light/cube_quads.h"
#include "gpu/frame/sky_quads_io.h"

namespace petrichor::shared {
namespace {

glm::vec3 middle_of(int face, glm::ivec2 texel, int side)
{
    const glm::vec2 st = (glm::vec2(texel) + 0.5f) * (2.0f / static_cast<float>(side)) - 1.0f;
    return glm::normalize(cube_direction(face, st));
}

glm::ivec2 texel_of(const CubePlace& place, int side)
{
    return glm::ivec2(glm::floor((place.st * 0.5f + 0.5f) * static_cast<float>(side)));
}

TEST(CubeQuads, PlacesAreDirectionsBackwards)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> any(-0.999f, 0.999f);
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < 200; ++i) {
            const glm::vec2 st(any(random), any(random));
            const CubePlace place = cube_place(3.0f * cube_direction(face, st));
            ASSERT_EQ(place.face, face);
            ASSERT_NEAR(place.st.x, st.x, 1e-6f);
            ASSERT_NEAR(place.st.y, st.y, 1e-6f);
        }
    }
}

// The texel beside one is the nearest of the other face, and that one has the first beside it.
TEST(CubeQuads, NeighboursAcrossEdgesAreEachOthers)
{
    for (const int side : {2, 4, 12, 64}) {
        for (int face = 0; face < 6; ++face) {
            for (int i = 0; i < 4 * side; ++i) {
                const int along = i % side;
                const glm::ivec2 ways[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
                const glm::ivec2 way = ways[i / side];
                const int end = way.x + way.y > 0 ? side - 1 : 0;
                const glm::ivec2 own = way.x != 0 ? glm::ivec2(end, along) : glm::ivec2(along, end);
                const CubePlace beside = cube_beside(face, own + way, side);
                ASSERT_NE(beside.face, face);
                const glm::ivec2 there = texel_of(beside, side);
                ASSERT_TRUE(there.x >= 0 && there.y >= 0 && there.x < side && there.y < side);
                // It lies as far away as its middle is, by the edge between both.
                const glm::vec3 a = middle_of(face, own, side), b = middle_of(beside.face, there, side);
                const glm::vec2 st = glm::clamp((glm::vec2(own) + 0.5f) * (2.0f / static_cast<float>(side)) - 1.0f +
                                                    glm::vec2(way) * 0.5f * (2.0f / static_cast<float>(side)),
                                                glm::vec2(-1.0f), glm::vec2(1.0f));
                const glm::vec3 edge = glm::normalize(cube_direction(face, st));
                ASSERT_NEAR(glm::dot(a, edge), glm::dot(b, edge), 1e-5f);
                bool back = false;
                for (const glm::ivec2& other : ways) {
                    const glm::ivec2 outside = there + other;
                    if (outside.x >= 0 && outside.y >= 0 && outside.x < side && outside.y < side) continue;
                    const CubePlace again = cube_beside(beside.face, outside, side);
                    back = back || (again.face == face && texel_of(again, side) == own);
                }
                ASSERT_TRUE(back) << "side " << side << " face " << face << " texel " << own.x << " " << own.y;
            }
        }
    }
}

TEST(CubeQuads, LevelsFollowOneAnother)
{
    int at = 0;
    for (int log2 = 1; log2 <= SKY_SPECULAR_LOG2; ++log2) {
        const int side = 1 << log2;
        EXPECT_EQ(cube_quads_begin(log2), at);
        EXPECT_EQ(cube_quad(at, side, 5, {side, side}), at + 6 * (side + 1) * (side + 1) - 1);
        at += 6 * (side + 1) * (side + 1);
    }
    EXPECT_EQ(SKY_AIR_QUADS, at);
}

TEST(CubeQuads, AWordHoldsLightToAFiveHundredthOfItsBrightest)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<float> any(0.0f, 1.0f);
    for (int i = 0; i < 20000; ++i) {
        const float scale = std::exp2(28.0f * any(random) - 13.0f);
        const glm::vec3 light = scale * glm::vec3(any(random), any(random), any(random));
        const float most = std::max(light.x, std::max(light.y, light.z));
        const glm::vec3 held = light_of_word(light_word(light), 1.0f);
        // 256 to 511 steps to the brightest, and half of one.
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(held[c], light[c], most / 511.0f) << scale;
    }
    for (const float one : {1.0f, 0.5f, 2.0f, 511.0f, 1024.0f, 65408.0f})
        EXPECT_EQ(light_of_word(light_word(glm::vec3(one)), 1.0f), glm::vec3(one));
    EXPECT_EQ(light_of_word(light_word(glm::vec3(0.0f)), 1.0f), glm::vec3(0.0f));
    EXPECT_EQ(light_of_word(light_word(glm::vec3(1e9f, -1.0f, 0.0f)), 1.0f), glm::vec3(65408.0f, 0.0f, 0.0f));
}

}  // namespace
}  // namespace petrichor::shared
