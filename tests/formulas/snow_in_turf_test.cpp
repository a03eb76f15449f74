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

}  // namespace
}  // namespace petrichor::shared
