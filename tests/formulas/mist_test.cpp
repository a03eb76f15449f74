// Mist over warm wet ground.
#include "formulas/light/mist.h"

#include <gtest/gtest.h>

namespace petrichor::shared {
namespace {

// Tables of saturation over water: 611 Pa at 0 C, 1228 at 10, 2339 at 20, 4246 at 30.
TEST(Mist, SaturationIsThatOfTables)
{
    EXPECT_NEAR(mist_saturation_pa(273.15f), 611.2f, 1.0f);
    EXPECT_NEAR(mist_saturation_pa(283.15f), 1228.0f, 6.0f);
    EXPECT_NEAR(mist_saturation_pa(293.15f), 2339.0f, 12.0f);
    EXPECT_NEAR(mist_saturation_pa(303.15f), 4246.0f, 25.0f);
}

TEST(Mist, RisesOnlyWhereGroundIsWarmerAndAirMoist)
{
    EXPECT_EQ(mist_extinction_per_m(288.0f, 288.0f, 1.0f, 0.0f), 0.0f);
    EXPECT_EQ(mist_extinction_per_m(280.0f, 288.0f, 1.0f, 0.0f), 0.0f);
    EXPECT_EQ(mist_extinction_per_m(293.0f, 288.0f, 0.5f, 0.0f), 0.0f);
    float before = 0.0f;
    for (float warmer = 8.0f; warmer <= 30.0f; warmer += 2.0f) {
        const float now = mist_extinction_per_m(288.0f + warmer, 288.0f, 0.97f, 0.0f);
        EXPECT_GT(now, before);
        EXPECT_GT(now, mist_extinction_per_m(288.0f + warmer, 288.0f, 0.8f, 0.0f));
        EXPECT_NEAR(mist_extinction_per_m(288.0f + warmer, 288.0f, 0.97f, 3.0f), 0.1f * now, 1e-6f * now);
        before = now;
    }
    // 10 g/m3 over ground that is 30 K warmer, in still air; sea smoke has 0.1 to 1 g/m3 at 10 to 20 K.
    EXPECT_LT(before, 10.0f * 0.3f);
    EXPECT_NEAR(mist_extinction_per_m(303.0f, 288.0f, 0.8f, 0.0f), 0.3f, 0.27f);
}

TEST(Mist, WispsAreAsDenseInTheMeanAsTheLayer)
{
    double sum = 0.0;
    float least = 9.0f, most = 0.0f;
    for (int i = 0; i < 160000; ++i) {
        const float here = mist_wisps({0.61f * static_cast<float>(i % 400), 0.57f * static_cast<float>(i / 400)}, {3.0f, 5.0f},
                                      1.37f * static_cast<float>(i % 41));
        sum += static_cast<double>(here);
        least = std::min(least, here);
        most = std::max(most, here);
    }
    EXPECT_NEAR(sum / 160000.0, 1.0, 0.03);
    EXPECT_EQ(least, 0.0f);
    EXPECT_GT(most, 3.0f);
    EXPECT_LE(most, 3.8f);
    // They go with the air.
    EXPECT_EQ(mist_wisps({2.0f, 1.0f}, {0.5f, 0.25f}, 1.0f), mist_wisps({1.5f, 0.75f}, {0.0f, 0.0f}, 1.0f));
}

// Straight down the layer is as deep as its height; along the ground it is deeper by the cosine.
TEST(Mist, DepthIsThatOfALayer)
{
    EXPECT_NEAR(mist_depth(2.0f, {0, 50, 0}, {0, 0, 0}, 0.0f), 2.0f * kMistHeight_m, 1e-4f);
    EXPECT_NEAR(mist_depth(2.0f, {0, 50, 0}, {50, 0, 0}, 0.0f), 2.0f * kMistHeight_m * std::sqrt(2.0f), 1e-4f);
    EXPECT_NEAR(mist_depth(2.0f, {0, 1.7f, 0}, {0, 1.7f, 9}, 0.0f), 18.0f * std::exp(-1.7f / kMistHeight_m), 1e-4f);
}

}  // namespace
}  // namespace petrichor::shared
