#include "formulas/weather/snow_body.h"

#include <gtest/gtest.h>

#include "formulas/noise/noise.h"

namespace petrichor::shared {
namespace {

vec2 somewhere(std::uint32_t i) { return {300.0f * hash_f(2 * i) - 150.0f, 300.0f * hash_f(2 * i + 1) - 150.0f}; }

// Of many places.
double mean_share(float deep_m, float melt_exp)
{
    double sum = 0.0;
    constexpr std::uint32_t kPlaces = 4000;
    for (std::uint32_t i = 0; i < kPlaces; ++i)
        sum += static_cast<double>(snow_body_share(deep_m, 0.0f, somewhere(i), melt_exp));
    return sum / kPlaces;
}

TEST(SnowBodyShare, RisesWithTheDepthAndFallsWithTheThawAtEveryPlace)
{
    for (std::uint32_t i = 0; i < 500; ++i) {
        const vec2 at = somewhere(i);
        for (const float over : {-0.02f, -0.005f, 0.0f, 0.005f, 0.02f}) {
            for (const float melt : {0.0f, 0.2f, 1.0f}) {
                EXPECT_EQ(snow_body_share(0.0f, over, at, melt), 0.0f);
                EXPECT_EQ(snow_body_share(SNOW_BODIED_M, over, at, melt), 1.0f);
                float before = 0.0f;
                for (int k = 1; k <= 60; ++k) {
                    const float share = snow_body_share(0.001f * static_cast<float>(k), over, at, melt);
                    EXPECT_GE(share, before);
                    before = share;
                }
            }
            for (const float deep : {0.01f, 0.02f, 0.04f})
                EXPECT_GE(snow_body_share(deep, over, at, 0.0f), snow_body_share(deep, over, at, 0.25f));
        }
    }
}

// At every place there is no less of it the lower the ground: joints keep thin snow longer than the stones beside them.
TEST(SnowBodyShare, LiesLongestBetweenStones)
{
    double joints = 0.0, stones = 0.0;
    constexpr std::uint32_t kPlaces = 2000;
    for (std::uint32_t i = 0; i < kPlaces; ++i) {
        const vec2 at = somewhere(i);
        for (const float deep : {0.005f, 0.015f, 0.03f, 0.05f}) {
            const float joint = snow_body_share(deep, -0.012f, at, 1.0f), stone = snow_body_share(deep, 0.004f, at, 1.0f);
            ASSERT_GE(joint, stone);
            ASSERT_GE(settled_snow_m(deep, -0.012f), settled_snow_m(deep, 0.004f));
        }
        joints += static_cast<double>(snow_body_share(0.015f, -0.012f, at, 1.0f));
        stones += static_cast<double>(snow_body_share(0.015f, 0.004f, at, 1.0f));
    }
    EXPECT_GT(joints, 1.5 * stones) << "of a finger of melting snow";
}

TEST(SnowBodyShare, FreshSnowLiesEvenlyAndMeltingSnowInPatches)
{
    EXPECT_EQ(mean_share(0.021f, 0.0f), 1.0) << "three fingers of fresh snow have no hole";
    const double patches = mean_share(0.021f, 1.0f);
    EXPECT_GT(patches, 0.15);
    EXPECT_LT(patches, 0.6);
    // Patches, no dots: a hand's width on, it is mostly the same.
    int same = 0;
    constexpr std::uint32_t kPlaces = 1000;
    for (std::uint32_t i = 0; i < kPlaces; ++i) {
        const vec2 at = somewhere(i);
        const bool here = snow_body_share(0.021f, 0.0f, at, 1.0f) > 0.5f;
        same += here == (snow_body_share(0.021f, 0.0f, at + vec2(0.03f, 0.0f), 1.0f) > 0.5f) ? 1 : 0;
    }
    EXPECT_GT(same, 850);
}

TEST(SnowBodyShare, ThawingSnowIsSlushWhereItIsThinOrLiesInWater)
{
    double thin = 0.0, deep = 0.0, slopes = 0.0;
    constexpr std::uint32_t kPlaces = 2000;
    for (std::uint32_t i = 0; i < kPlaces; ++i) {
        const vec2 at = somewhere(i);
        const SnowBody body = snow_body_at(0.03f, 0.0f, at, 1.0f);
        const auto slush = [&](float deep_m, float soaked, float melt) { return slush_share(deep_m, soaked, body.ragged, at, melt); };
        EXPECT_EQ(slush(0.02f, 1.0f, 0.0f), 0.0f) << "in frost";
        EXPECT_EQ(glm::length(thaw_slope(body.slope, 0.0f, 0.0f)), 0.0f);
        float before = 0.0f;
        for (const float soaked : {0.0f, 0.3f, 0.7f, 1.0f}) {
            const float share = slush(0.02f, soaked, 0.3f);
            EXPECT_GE(share, before);
            EXPECT_LE(share, 0.8f);
            EXPECT_GE(share, slush(0.05f, soaked, 0.3f));
            before = share;
        }
        EXPECT_GT(slush(0.06f, 1.0f, 0.4f), 0.3f) << "what lies in a gutter that runs";
        thin += static_cast<double>(slush(0.015f, 0.0f, 1.0f)) / kPlaces;
        deep += static_cast<double>(slush(0.06f, 0.0f, 1.0f)) / kPlaces;
        slopes += static_cast<double>(thaw_slope(body.slope, 0.0f, 1.0f).x) / kPlaces;
        EXPECT_LT(glm::length(thaw_slope(body.slope, 0.5f, 1.0f)), glm::length(thaw_slope(body.slope, 0.0f, 1.0f)) + 1e-6f);
    }
    EXPECT_GT(thin, 2.0 * deep);
    EXPECT_NEAR(slopes, 0.0, 0.02) << "it leans no way in the mean";
}

TEST(SnowBodyShare, ItsSlopeIsThatOfItsNoise)
{
    for (std::uint32_t i = 0; i < 200; ++i) {
        const vec2 p = somewhere(i) / 20.0f;
        const vec3 here = endless_noise_sloped(p, 72u);
        EXPECT_EQ(here.x, endless_noise(p, 72u));
        const float step = 1.0f / 512.0f;
        EXPECT_NEAR((endless_noise(p + vec2(step, 0.0f), 72u) - endless_noise(p - vec2(step, 0.0f), 72u)) / (2.0f * step), here.y, 0.01f);
        EXPECT_NEAR((endless_noise(p + vec2(0.0f, step), 72u) - endless_noise(p - vec2(0.0f, step), 72u)) / (2.0f * step), here.z, 0.01f);
    }
}

// Beside what is left of it the ground is wet, and nowhere in frost.
TEST(SnowBodyShare, MeltSoaksTheGroundBesideIt)
{
    int beside = 0;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const vec2 at = somewhere(i);
        EXPECT_EQ(snow_body_at(0.02f, 0.0f, at, 0.0f).wets, 0.0f);
        const SnowBody body = snow_body_at(0.02f, 0.0f, at, 1.0f);
        beside += body.share == 0.0f && body.wets > 0.3f ? 1 : 0;
        if (body.share > 0.1f) {
            EXPECT_GT(body.wets, 0.9f);
        }
    }
    EXPECT_GT(beside, 100);
}

TEST(SnowBodyShare, ACodeTellsTheDepth)
{
    for (const float deep : {0.0f, 0.01f, 0.03f, 0.06f})
        EXPECT_NEAR((1.0f - snow_body_code(deep)) * SNOW_BODIED_M, deep, 1e-7f);
    EXPECT_EQ(snow_body_code(2.0f), 0.0f);
    EXPECT_EQ(snow_body_code(-1.0f), 1.0f);
}

}  // namespace
}  // namespace petrichor::shared
