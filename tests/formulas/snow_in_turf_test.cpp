#include "formulas/weather/snow_in_turf.h"

#include <gtest/gtest.h>

#include <glm/glm.hpp>

namespace petrichor::shared {
namespace {

constexpr float kMask = 0.7067f;  // its mean

TEST(SnowInTurf, TurnsGroundPaleByAndBy)
{
    EXPECT_EQ(snow_in_turf(0.0f, 1.0f, 2.0f), 0.0f);
    float before = 0.0f;
    for (float lies = 0.05f; lies < 0.8f; lies += 0.05f) {
        const float white = snow_in_turf(lies, kMask, 0.0f);
        // Neither white nor bare: a step of the amount is a step of the white, no larger than half as much again.
        EXPECT_GE(white, before) << lies;
        EXPECT_LT(white - before, 0.075f) << lies;
        before = white;
    }
    EXPECT_GT(snow_in_turf(0.25f, kMask, 0.0f), 0.2f);
    EXPECT_LE(snow_in_turf(1.0f, 1.0f, 2.0f), 0.85f);
}

TEST(SnowInTurf, LiesWhereTheReliefIsFlatter)
{
    for (const float lies : {0.1f, 0.3f, 0.5f}) {
        EXPECT_GT(snow_in_turf(lies, kMask, 1.0f), 1.2f * snow_in_turf(lies, kMask, -1.0f));
        EXPECT_GT(snow_in_turf(lies, kMask + 0.15f, 0.0f), snow_in_turf(lies, kMask - 0.15f, 0.0f));
    }
    EXPECT_EQ(turf_holds(glm::cos(glm::radians(25.0f))), 1.0f);
    EXPECT_EQ(turf_holds(glm::cos(glm::radians(61.0f))), 0.0f);
    EXPECT_GT(turf_holds(glm::cos(glm::radians(45.0f))), 0.3f);
}

// It adds to the closed cover what that leaves bare, and nothing where there is none.
TEST(SnowInTurf, ShowsBesideTheClosedCover)
{
    SnowCover cover;
    cover.snow = 0.5f;
    cover.melt = 0.6f;
    EXPECT_EQ(with_snow_in_turf(cover, 0.0f).snow, 0.5f);
    EXPECT_FLOAT_EQ(with_snow_in_turf(cover, 0.4f).snow, 0.7f);
    cover.snow = 1.0f;
    EXPECT_EQ(with_snow_in_turf(cover, 0.8f).snow, 1.0f);
    cover.snow = 0.0f;
    EXPECT_EQ(with_snow_in_turf(cover, 0.3f).snow, 0.3f);
}

// A triangle of 55 degrees beside one of 35: at their edge the ground leans by 45, and holds one amount on both sides.
TEST(SnowInTurf, IsOneAcrossTheEdgesOfTriangles)
{
    const auto up = [](float deg) { return glm::cos(glm::radians(deg)); };
    const auto told = [&](float deg) { return up(deg) * (1.0f + up(deg)); };
    EXPECT_NEAR(told(55.0f) * snow_of_bend(up(45.0f), up(55.0f)), told(35.0f) * snow_of_bend(up(45.0f), up(35.0f)), 1e-5f);
    EXPECT_NEAR(snow_of_bend(up(50.0f), up(50.0f)), 1.0f, 1e-6f);
    for (const float smooth : {-1.0f, 0.0f, 0.3f, 1.0f})
        for (const float plane : {0.0f, 0.5f, 1.0f}) {
            EXPECT_GE(snow_of_bend(smooth, plane), 0.5f);
            EXPECT_LE(snow_of_bend(smooth, plane), 2.0f);
        }
}

// Sub-patch detail: the depth of a slope is that which its patch says, in the mean.
TEST(SnowInTurf, OfARuggedSlopeIsThatOfItsPatchInTheMean)
{
    for (const float amount : {0.1f, 0.5f, 0.9f}) {
        double sum = 0.0, square = 0.0;
        constexpr int kSide = 160;
        for (int i = 0; i < kSide * kSide; ++i) {
            const glm::vec3 at(0.37f * static_cast<float>(i % kSide), 0.3f * static_cast<float>(i / kSide), 0.21f * static_cast<float>(i / kSide));
            const auto share = static_cast<double>(snow_of_relief(slope_relief(at, 0.02f).flatter, amount));
            sum += share;
            square += share * share;
        }
        const double mean = sum / (kSide * kSide), deviation = glm::sqrt(square / (kSide * kSide) - mean * mean);
        EXPECT_NEAR(mean, 1.0, 0.04) << amount;
        EXPECT_GT(deviation, 0.25 * (1.0 - static_cast<double>(amount))) << amount;
        EXPECT_LT(deviation, 0.45 * (1.0 - static_cast<double>(amount))) << amount;
    }
}

TEST(SnowInTurf, GrassAroundItIsDullAndStoneIsNot)
{
    const glm::vec3 grass(0.12f, 0.30f, 0.05f), stone(0.30f, 0.29f, 0.27f);
    EXPECT_EQ(turf_in_winter(grass, 0.0f), grass);
    EXPECT_EQ(turf_in_winter(stone, 1.0f), stone);
    const glm::vec3 dull = turf_in_winter(grass, 1.0f);
    EXPECT_LT(dull.y, 0.75f * grass.y);
    EXPECT_LT(dull.y / dull.x, 0.6f * grass.y / grass.x);
    EXPECT_GT(dull.x, grass.x);
}

}  // namespace
}  // namespace petrichor::shared
