#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formulas/light/fog.h"
#include "formulas/light/rain_clouds.h"

namespace petrichor::shared {
namespace {

constexpr float kTurn = 6.2831853f;

struct Spread {
    double mean = 0.0, deviation = 0.0;
};

// Of the relief around the sky at a height over the horizon, for many winds.
Spread relief_at(float up, float rain)
{
    double sum = 0.0, squares = 0.0;
    constexpr int kCount = 6000;
    const float level = std::sqrt(1.0f - up * up);
    for (int i = 0; i < kCount; ++i) {
        const float angle = 0.7548777f * static_cast<float>(i) * kTurn;
        const glm::vec2 drift_m(913.0f * static_cast<float>(i % 61), 571.0f * static_cast<float>(i % 83));
        const auto v = static_cast<double>(
            layer_relief_wide({level * std::cos(angle), up, level * std::sin(angle)}, drift_m, 0.004f, rain));
        EXPECT_GT(v, 0.15);
        EXPECT_LT(v, 2.5);
        sum += v;
        squares += v * v;
    }
    return {sum / kCount, std::sqrt(std::max(squares / kCount - sum * sum / kCount / kCount, 0.0))};
}

TEST(RainClouds, HaveMoreReliefTheHarderItRains)
{
    for (const float up : {0.2f, 0.5f, 0.9f}) {
        double before = 0.0;
        for (const float rain : {0.0f, 0.3f, 0.6f, 1.0f}) {
            const Spread now = relief_at(up, rain);
            EXPECT_GT(now.deviation, before) << up << " " << rain;
            before = now.deviation;
        }
        EXPECT_GT(before, 2.0 * relief_at(up, 0.0f).deviation) << up;
    }
}

// The CIE's overcast sky is three times as bright above as at the horizon; in the mean of places it stays that.
TEST(RainClouds, AreInTheMeanAsBrightLowAsHigh)
{
    for (const float rain : {0.0f, 0.5f, 1.0f}) {
        const double high = relief_at(0.95f, rain).mean;
        for (const float up : {0.1f, 0.3f, 0.6f}) EXPECT_NEAR(relief_at(up, rain).mean / high, 1.0, 0.12) << rain << " " << up;
    }
}

TEST(RainClouds, HaveNoRagsWithoutRain)
{
    double before = -1.0;
    for (const float rain : {0.001f, 0.25f, 0.5f, 1.0f}) {
        double hidden = 0.0;
        for (int i = 0; i < 2000; ++i) {
            const float angle = 0.7548777f * static_cast<float>(i) * kTurn;
            hidden += static_cast<double>(
                rags_hide({0.8f * std::cos(angle), 0.6f, 0.8f * std::sin(angle)}, {77.0f * static_cast<float>(i), 0.0f}, 0.004f, rain)) / 2000.0;
        }
        EXPECT_GT(hidden, before) << rain;
        before = hidden;
        if (rain < 0.01f) { EXPECT_LT(hidden, 0.01); }
    }
    EXPECT_GT(before, 0.1);
    EXPECT_LT(before, 0.5);
}

TEST(RainClouds, ReachIsThatOfARoundEarth)
{
    EXPECT_NEAR(layer_reach(1.0f, 4000.0f), 1.0f, 1e-5f);
    EXPECT_NEAR(layer_reach(0.5f, 4000.0f), 2.0f, 2e-3f);
    EXPECT_NEAR(layer_reach(0.0f, 4000.0f), std::sqrt(8001.0f), 1e-2f);
}

// Whatever the land, as much of it reaches the ground; over dark land fog is darker along the ground than above.
TEST(RainClouds, LeaveFogItsLight)
{
    for (const float land : {0.0f, 0.2f, 0.75f}) {
        double lux = 0.0;
        constexpr int kCount = 1000;
        for (int i = 0; i < kCount; ++i) {
            const float up = (static_cast<float>(i) + 0.5f) / kCount;
            lux += 2.0 * static_cast<double>(up * fog_from_above(up, land)) / kCount;
        }
        EXPECT_NEAR(lux, 0.75, 1e-3) << land;
        EXPECT_EQ(fog_from_above(-0.5f, land), fog_from_above(0.0f, land));
    }
    EXPECT_LT(fog_from_above(0.0f, 0.2f), 0.7f * fog_from_above(1.0f, 0.2f));
    EXPECT_GT(fog_from_above(0.0f, 0.75f), fog_from_above(0.0f, 0.2f));
}

}  // namespace
}  // namespace petrichor::shared
