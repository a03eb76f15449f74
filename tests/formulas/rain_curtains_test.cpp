#include "formulas/light/rain_curtains.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace petrichor::shared {
namespace {

// Around the sky at a height over the horizon, for many winds.
std::vector<float> around(float up, float rain)
{
    std::vector<float> seen;
    const float level = std::sqrt(1.0f - up * up);
    for (int i = 0; i < 3000; ++i) {
        const float angle = 0.7548777f * 6.2831853f * static_cast<float>(i);
        const glm::vec2 drift_m(913.0f * static_cast<float>(i % 61), 571.0f * static_cast<float>(i % 83));
        const glm::vec2 seen_here = rain_curtains({level * std::cos(angle), up, level * std::sin(angle)}, drift_m, {0.4f, 0.1f}, rain);
        EXPECT_GE(seen_here.y, 0.0f);
        EXPECT_LE(seen_here.y, 1.0f);
        EXPECT_GE(seen_here.x, 0.5f);
        EXPECT_LE(seen_here.x, 2.17f);
        seen.push_back(seen_here.x);
    }
    std::sort(seen.begin(), seen.end());
    return seen;
}

double mean(const std::vector<float>& values)
{
    double sum = 0.0;
    for (const float v : values) sum += static_cast<double>(v);
    return sum / static_cast<double>(values.size());
}

TEST(RainCurtains, AreNoneWithoutRainAndNoneAbove)
{
    for (const float up : {0.0f, 0.1f, 0.4f}) EXPECT_EQ(around(up, 0.0f).front(), 1.0f);
    EXPECT_EQ(around(0.0f, 0.0f).back(), 1.0f);
    EXPECT_NEAR(around(kCurtainEnds, 1.0f).front(), 1.0f, 0.01f);
    EXPECT_NEAR(around(kCurtainEnds, 1.0f).back(), 1.0f, 0.01f);
}

TEST(RainCurtains, LeaveLightBetween)
{
    double before = 0.0;
    for (const float rain : {0.2f, 0.5f, 1.0f}) {
        const std::vector<float> low = around(0.03f, rain);
        const double contrast = static_cast<double>(low[2850] / low[150]);
        EXPECT_GT(contrast, before) << rain;
        before = contrast;
    }
    EXPECT_GT(before, 1.8);
}

// They move light about the sky: level ground has as much, within a hundredth.
TEST(RainCurtains, LightTheGroundAsNone)
{
    for (const float rain : {0.3f, 1.0f}) {
        double lux = 0.0, even = 0.0;
        constexpr int kRings = 40;
        for (int ring = 0; ring < kRings; ++ring) {
            const float up = (static_cast<float>(ring) + 0.5f) / kRings;
            const auto weight = static_cast<double>(up * (1.0f + 2.0f * up));  // CIE overcast
            lux += weight * mean(around(up, rain));
            even += weight;
        }
        EXPECT_NEAR(lux / even, 1.0, 0.01) << rain;
    }
}

// Their sides are soft and wander: a stripe with a hard edge from the land to the clouds is no rain. By half a degree aside, and by the
// same edge higher up.
TEST(RainCurtains, AreNoStripes)
{
    std::vector<float> steps;
    double same = 0.0, all = 0.0;
    for (int wind = 0; wind < 12; ++wind) {
        const glm::vec2 drift_m(913.0f * static_cast<float>(wind), 571.0f * static_cast<float>(wind % 5));
        const auto seen = [&](float angle, float rise) {
            return rain_curtains(glm::normalize(glm::vec3(std::cos(angle), rise, std::sin(angle))), drift_m, {0.0f, 0.0f}, 1.0f).x;
        };
        for (int i = 0; i < 720; ++i) {
            const float angle = glm::radians(0.5f * static_cast<float>(i)), next = glm::radians(0.5f * static_cast<float>(i + 1));
            const float low = seen(next, 0.05f) - seen(angle, 0.05f), high = seen(next, 0.11f) - seen(angle, 0.11f);
            steps.push_back(std::abs(low));
            same += static_cast<double>(low * high);
            all += static_cast<double>(0.5f * (low * low + high * high));
        }
    }
    std::sort(steps.begin(), steps.end());
    EXPECT_LT(steps[steps.size() * 99 / 100], 0.05f);
    EXPECT_LT(same / all, 0.5);
}

// They thin out all the way up to the clouds: what ends at one height is a box that stands in the sky. By half a degree upwards.
TEST(RainCurtains, AreNoBoxes)
{
    std::vector<float> steps;
    for (int wind = 0; wind < 12; ++wind) {
        const glm::vec2 drift_m(913.0f * static_cast<float>(wind), 571.0f * static_cast<float>(wind % 5));
        for (int i = 0; i < 180; ++i) {
            const float angle = glm::radians(2.0f * static_cast<float>(i));
            const auto grey = [&](float up_deg) {
                const glm::vec3 towards(std::cos(angle), std::tan(glm::radians(up_deg)), std::sin(angle));
                return rain_curtains(glm::normalize(towards), drift_m, {0.0f, 0.0f}, 1.0f).y;
            };
            for (float up_deg = 1.0f; up_deg < 24.0f; up_deg += 0.5f) steps.push_back(std::abs(grey(up_deg + 0.5f) - grey(up_deg)));
        }
    }
    std::sort(steps.begin(), steps.end());
    EXPECT_LT(steps[steps.size() * 99 / 100], 0.055f);
}

// Rain that is blown aside hangs at a slant, the way it is blown; across the wind that is seen, along it not.
TEST(RainCurtains, LeanWithTheWind)
{
    const glm::vec2 drift_m(2000.0f, 500.0f);
    double same = 0.0, upright = 0.0;
    for (int i = 0; i < 400; ++i) {
        const float x = -0.5f + 0.0025f * static_cast<float>(i);
        const auto seen = [&](float aside, float rise, glm::vec2 lean) {
            return rain_curtains(glm::normalize(glm::vec3(aside, rise, -1.0f)), drift_m, lean, 1.0f).y;
        };
        // Of all curtains the one at 5 km leans by lean / 3.1 of the picture's width a width up, the others by more and less.
        const float low = seen(x, 0.02f, {1.5f, 0.0f});
        same += static_cast<double>(std::abs(seen(x - 0.09f, 0.08f, {1.5f, 0.0f}) - low));
        upright += static_cast<double>(std::abs(seen(x + 0.09f, 0.08f, {1.5f, 0.0f}) - low));
    }
    EXPECT_LT(same, 0.85 * upright);
}

}  // namespace
}  // namespace petrichor::shared
