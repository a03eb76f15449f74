#include "formulas/light/skyline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace petrichor::shared {
namespace {

glm::vec2 towards(double angle)
{
    return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

constexpr double kAround = 6.283185307179586;

TEST(Skyline, TurnsAreThoseOfTheArcTangent)
{
    for (int i = 0; i < 10000; ++i) {
        const glm::vec2 ahead = towards(kAround * i / 10000.0);
        EXPECT_NEAR(skyline_angle(ahead), std::atan2(ahead.y, ahead.x), 2e-5f) << i;
    }
}

TEST(Skyline, ClosesAroundTheHorizon)
{
    for (int k = 0; k < kSkylineRows; ++k) {
        const SkylineRow row = skyline_row(k);
        const double step = 0.02 / static_cast<double>(row.away_m);
        for (const double seam : {0.0, 0.5 * kAround})
            for (const double at : {-1.0, 0.0, 1.0}) {
                const float here = skyline_tops(row, towards(seam + (at - 0.5) * step), 0.02f, 390u).y;
                const float next = skyline_tops(row, towards(seam + (at + 0.5) * step), 0.02f, 390u).y;
                EXPECT_NEAR(here, next, 0.3f) << k << " at " << seam;
            }
    }
}

TEST(Skyline, StaysBelowWhereItEndsAndAboveItsLand)
{
    for (int k = 0; k < kSkylineRows; ++k) {
        const SkylineRow row = skyline_row(k);
        for (int i = 0; i < 4000; ++i) {
            const glm::vec2 tops = skyline_tops(row, towards(kAround * i / 4000.0), 0.5f, 390u);
            EXPECT_GE(tops.x, 0.0f);
            EXPECT_GE(tops.y, tops.x);
            EXPECT_LE(tops.y, row.hills_m + row.tall_m);
            const float over_m = skyline_over_m(row, kSkylineEnds, 0.0f);
            EXPECT_EQ(skyline_cover(tops, over_m, 0.002f * row.away_m), 0.0f) << k;
        }
    }
}

TEST(Skyline, GrowsOnTheShareThatItsRowSays)
{
    for (int k = 0; k < kSkylineRows; ++k) {
        const SkylineRow row = skyline_row(k);
        int grown = 0;
        constexpr int kPlaces = 20000;
        for (int i = 0; i < kPlaces; ++i) {
            const glm::vec2 tops = skyline_tops(row, towards(kAround * i / kPlaces), 3.0f * row.crown_m, 390u);
            if (tops.y - tops.x > 0.35f * row.tall_m) ++grown;
        }
        EXPECT_NEAR(static_cast<double>(grown) / kPlaces, static_cast<double>(row.grown), 0.13) << k;
    }
}

// A pixel has the mean of what narrower ones in it have, so that a skyline stands still when the camera turns.
TEST(Skyline, AWidePixelCoversWhatNarrowOnesDo)
{
    for (int k = 0; k < kSkylineRows; ++k) {
        const SkylineRow row = skyline_row(k);
        const float width_m = 0.3f * row.crown_m;
        double wide = 0.0, narrow = 0.0;
        for (int i = 0; i < 2000; ++i) {
            const double middle = kAround * i / 2000.0;
            for (float over_m = -width_m; over_m < row.hills_m + row.tall_m + width_m; over_m += 0.2f * width_m) {
                wide += static_cast<double>(skyline_cover(skyline_tops(row, towards(middle), width_m, 390u), over_m, width_m));
                for (int j = 0; j < 5; ++j) {
                    const double angle = middle + (j - 2) * 0.2 * static_cast<double>(width_m / row.away_m);
                    narrow += 0.2 * static_cast<double>(skyline_cover(skyline_tops(row, towards(angle), 0.2f * width_m, 390u), over_m, 0.2f * width_m));
                }
            }
        }
        EXPECT_NEAR(wide / narrow, 1.0, 0.05) << k;
    }
}

// From higher up the same tree stands lower against the sky; far ground falls away as the earth is round.
TEST(Skyline, SinksBelowAnEyeThatRises)
{
    const SkylineRow row = skyline_row(2);
    EXPECT_GT(skyline_over_m(row, 0.0f, 100.0f), row.hills_m + row.tall_m);
    EXPECT_NEAR(skyline_over_m(row, 0.0f, 1.7f), 1.7f + 1900.0f * 1900.0f / (2.0f * 6371.0e3f / (1.0f - 0.13f)), 0.01f);
    EXPECT_NEAR(skyline_over_m(row, -1.7f / 1900.0f, 1.7f), 0.25f, 0.01f);
}

// Lambert's sphere sends two thirds of a disc's light back to the sun, and none away from it.
TEST(Skyline, TreesAreLitFromTheSideOfTheSun)
{
    EXPECT_NEAR(skyline_sunlit(-1.0f), 2.0f / (3.0f * kPi), 1e-6f);
    EXPECT_NEAR(skyline_sunlit(1.0f), 0.0f, 1e-6f);
    float before = 1.0f;
    for (int i = 0; i <= 20; ++i) {
        const float lit = skyline_sunlit(-1.0f + 0.1f * static_cast<float>(i));
        EXPECT_LE(lit, before);
        before = lit;
    }
}

}  // namespace
}  // namespace petrichor::shared
