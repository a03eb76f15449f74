// Light in standing water: laws, and a street's puddle as one knows it. tests/gpu/parity_test.cpp shows that the device
// computes the same.
#include "formulas/weather/deep_water.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formulas/weather/apply_weather.h"

namespace petrichor::shared {
namespace {

WeatheredMaterial wet_stone(float albedo)
{
    return {glm::vec3(albedo), glm::vec3(0.02f), 0.9f, 0.7f, 1.0f, 1.0f, 0.0f};
}

glm::vec3 seen(float albedo, float deeper_m, float mud = 1.0f)
{
    return apply_deep_water(wet_stone(albedo), glm::vec4(0.0f), 1.0f, deeper_m, kMeanWaterWay, mud).albedo;
}

TEST(DeepWater, PassesTheProductOfItsLayers)
{
    for (const float a : {0.0f, 0.003f, 0.05f, 0.4f}) {
        for (const float b : {0.001f, 0.02f, 0.3f}) {
            const glm::vec3 both = water_passes(a + b, 1.0f), apart = water_passes(a, 1.0f) * water_passes(b, 1.0f);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(both[c], apart[c], 1e-6f);
            const float murk = 1.0f - murk_hides(0.3f, a + b, 2.0f);
            EXPECT_NEAR(murk, (1.0f - murk_hides(0.3f, a, 2.0f)) * (1.0f - murk_hides(0.3f, b, 2.0f)), 1e-6f);
        }
    }
    EXPECT_EQ(water_passes(0.0f, 1.0f), glm::vec3(1.0f));
    EXPECT_EQ(murk_hides(0.7f, 0.0f, 2.0f), 0.0f);
    EXPECT_EQ(murk_hides(0.0f, 1.0f, 2.0f), 0.0f);
}

// Snell at the surface: straight down the eye sees by the depth, along the water by 1.52 of it, for what lies there is bent up.
TEST(DeepWater, WaysAreBent)
{
    EXPECT_NEAR(water_way(1.0f), 1.2f + 1.0f, 1e-5f);
    EXPECT_NEAR(water_way(0.0f), 1.2f + 1.0f / std::sqrt(1.0f - 1.0f / (1.33f * 1.33f)), 1e-3f);
    EXPECT_NEAR(water_way(std::sin(glm::radians(40.0f))), kMeanWaterWay, 0.1f);
    float before = 3.0f;
    for (float cosine = 0.0f; cosine <= 1.0f; cosine += 0.05f) {
        EXPECT_LT(water_way(cosine), before);
        before = water_way(cosine);
    }
}

// Never more light than a bottomless puddle or the ground sends back, whichever is more, and ever nearer to the former.
TEST(DeepWater, LiesBetweenTheGroundAndABottomlessPuddle)
{
    for (const float albedo : {0.0f, 0.05f, 0.3f, 1.0f}) {
        glm::vec3 from = seen(albedo, 0.0f);
        EXPECT_EQ(from, glm::vec3(albedo));
        for (float deep_m = 0.002f; deep_m < 2.0f; deep_m *= 2.0f) {
            const glm::vec3 now = seen(albedo, deep_m);
            for (int c = 0; c < 3; ++c) {
                EXPECT_LE(now[c], std::max(albedo, bottomless_water(1.0f)[c]) + 1e-6f);
                EXPECT_LE(std::abs(now[c] - bottomless_water(1.0f)[c]), std::abs(from[c] - bottomless_water(1.0f)[c]) + 1e-6f);
            }
            from = now;
        }
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(from[c], bottomless_water(1.0f)[c], 1e-3f);
    }
}

// Clear over light stones at half a centimetre, brown-grey over a ground that is hardly seen at ten.
TEST(DeepWater, IsClearInAPuddleAndBrownInAPond)
{
    const glm::vec3 shallow = seen(0.4f, 0.005f), deep = seen(0.4f, 0.1f);
    EXPECT_GT(shallow.g, 0.9f * 0.4f);
    EXPECT_GT(shallow.r, shallow.b);
    EXPECT_LT(deep.g, 0.4f * 0.4f);
    EXPECT_GT(deep.r / deep.b, 1.4f);
    EXPECT_GT(deep.g, 0.05f) << "and not black";
}

TEST(DeepWater, HidesWhatGlowsBelowIt)
{
    const auto deep = apply_deep_water(wet_stone(0.3f), glm::vec4(0.1f, 0.1f, 0.1f, 0.4f), 1.0f, 0.02f, kMeanWaterWay, 1.0f);
    EXPECT_LT(deep.emission_scale, 0.3f);
    EXPECT_GT(deep.occlusion, 0.9f);
}

// Of murk what it hides where it closes, and of twice as much water twice that, by Beer.
TEST(DeepWater, MurkGrowsFromWhatItIsWhereItCloses)
{
    EXPECT_NEAR(murk_hides(0.4f, kClosedWater_m, kMeanWaterWay), 0.4f, 1e-5f);
    EXPECT_GT(murk_hides(1.0f, 0.01f, kMeanWaterWay), 0.999f);
}

// Mud hides the ground the more the more of it there is, in what has just closed too; without it deep water is dark and bluish.
TEST(DeepWater, MudHidesTheGround)
{
    // What is left of the ground, over what the water alone sends back.
    const auto left = [](float deep_m, float mud) { return seen(0.4f, deep_m, mud).g - bottomless_water(mud).g; };
    for (const float deep_m : {0.0f, 0.01f, 0.1f}) {
        float before = 0.4f;
        for (const float mud : {1.0f, 3.0f, 8.0f, 20.0f, 50.0f}) {
            EXPECT_GT(left(deep_m, mud), -1e-6f) << deep_m << " " << mud;
            EXPECT_LT(left(deep_m, mud), std::max(before, 1e-5f)) << deep_m << " " << mud;
            before = left(deep_m, mud);
        }
    }
    EXPECT_EQ(seen(0.4f, 0.0f), glm::vec3(0.4f));
    const glm::vec3 flood = seen(0.4f, 0.01f, 20.0f);
    EXPECT_LT(flood.g, 0.13f);
    EXPECT_GT(flood.r / flood.b, 1.3f);
    const glm::vec3 clear = seen(0.4f, 1.0f, 0.0f);
    EXPECT_GT(clear.b, clear.r);
    EXPECT_EQ(bottomless_water(0.0f), glm::vec3(0.0f));
    EXPECT_GT(seen(0.4f, 0.1f, 0.2f).g, seen(0.4f, 0.1f).g);
    // Half a cover is half as much water.
    const glm::vec3 half = standing_water_passes(0.5f, 0.0f, 2.0f, 9.0f), whole = standing_water_passes(1.0f, 0.0f, 2.0f, 9.0f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(half[c] * half[c], whole[c], 1e-6f);
}

TEST(DeepWater, IsKeptInEightBits)
{
    const auto kept = [](float deep_m) { return water_depth_of(std::round(255.0f * water_depth_code(deep_m)) / 255.0f); };
    for (const float deep_m : {0.0f, 0.001f, 0.004f, 0.02f, 0.1f, 0.5f, 1.0f})
        EXPECT_NEAR(kept(deep_m), deep_m, 0.004f * std::sqrt(deep_m) + 4e-6f) << deep_m;
    EXPECT_EQ(kept(7.0f), kDeepestWater_m);
    EXPECT_EQ(kept(-1.0f), 0.0f);
}

}  // namespace
}  // namespace petrichor::shared
