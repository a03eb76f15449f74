#include <gtest/gtest.h>

#include <cmath>

#include "formulas/light/clouds.h"

namespace petrichor::shared {
namespace {

// As much of the layer is cloud as was asked.
TEST(Clouds, CoverTheShareThatIsAsked)
{
    constexpr int kSide = 320;
    for (const float cover : {0.05f, 0.1f, 0.25f, 0.5f, 0.75f, 0.9f, 0.95f}) {
        int above = 0;
        for (int i = 0; i < kSide; ++i) {
            for (int j = 0; j < kSide; ++j) {
                const glm::vec2 p(0.37f * static_cast<float>(i) + 40.0f, 0.41f * static_cast<float>(j) - 20.0f);
                above += cloud_field(p + cloud_bend(p), 0.0f, kCloudOctaves) > cloud_threshold(cover);
            }
        }
        EXPECT_NEAR(static_cast<float>(above) / (kSide * kSide), cover, 0.04f) << cover;
    }
}

// Seen from ever farther off a field loses its contrast and keeps its mean.
TEST(Clouds, FadeIntoTheirMeanFarOff)
{
    double before = 1.0, mean_near = 0.0;
    for (const float footprint : {0.0f, 0.1f, 0.3f, 0.6f, 2.0f}) {
        double sum = 0.0, squares = 0.0;
        constexpr int kCount = 4000;
        for (int i = 0; i < kCount; ++i) {
            const auto v = static_cast<double>(
                cloud_field({0.731f * static_cast<float>(i), 3.0f + 0.117f * static_cast<float>(i)}, footprint,
                            kCloudOctaves));
            sum += v;
            squares += v * v;
        }
        const double mean = sum / kCount, spread = std::sqrt(std::max(squares / kCount - mean * mean, 0.0));
        if (footprint == 0.0f) mean_near = mean;
        EXPECT_LT(spread, before) << footprint;
        EXPECT_NEAR(mean, mean_near, 0.02) << footprint;
        before = spread + 1e-9;
    }
    EXPECT_LT(before, 1e-6);
}

// Heaps stand on their base: what is cloud there is met at once, and ways that lean meet more of it, at its flanks.
TEST(Clouds, HeapsAreMetAtTheirBaseOrAtAFlank)
{
    const float edge = cloud_threshold(0.3f);
    int at_base = 0, at_flank = 0, upright = 0, tallest_seen = 0;
    constexpr int kPlaces = 4000;
    for (int i = 0; i < kPlaces; ++i) {
        const glm::vec2 p(0.371f * static_cast<float>(i), 0.593f * static_cast<float>(i % 97));
        const float field = cloud_field(p, 0.0f, kHeapOctaves) - edge;
        const CloudMet straight = cloud_met(p, {0.0f, 0.0f}, 0.0f, edge, kCloudSteps);
        const CloudMet leaning = cloud_met(p, {1.1f, 0.4f}, 0.0f, edge, kCloudSteps);
        EXPECT_FLOAT_EQ(straight.above, field);
        EXPECT_EQ(straight.up, 0.0f);
        EXPECT_GE(leaning.above, field);
        EXPECT_GE(leaning.up, 0.0f);
        EXPECT_LE(leaning.up, 1.0f);
        EXPECT_TRUE(field <= 0.0f || leaning.up == 0.0f);
        // Where a flank is met the field has just risen over its threshold there.
        if (field <= 0.0f && leaning.above > 0.0f) {
            const glm::vec2 there = p + leaning.up * glm::vec2(1.1f, 0.4f);
            EXPECT_NEAR(cloud_field(there, 0.0f, kHeapOctaves) - edge - cloud_rise(leaning.up), 0.0f, 0.12f);
            ++at_flank;
            tallest_seen += leaning.up > 0.5f;
        }
        at_base += field > 0.0f;
        upright += straight.above > 0.0f;
    }
    EXPECT_EQ(at_base, upright);
    EXPECT_GT(at_flank, at_base / 4);
    EXPECT_GT(tallest_seen, 0);
}

// Lumps are as much above their mean as below, also far off; on a flank they differ up it as much as along it.
TEST(Clouds, LumpsHaveNoMeanAndNoStripes)
{
    double sum = 0.0, along = 0.0, up = 0.0;
    constexpr int kPlaces = 20000;
    for (int i = 0; i < kPlaces; ++i) {
        const glm::vec2 p(0.371f * static_cast<float>(i), 0.593f * static_cast<float>(i % 97));
        const float height = 0.013f * static_cast<float>(i % 71);
        const auto here = static_cast<double>(cloud_lumps(p, height, 0.0f));
        sum += here;
        along += std::abs(static_cast<double>(cloud_lumps(p + glm::vec2(0.04f, 0.0f), height, 0.0f)) - here);
        up += std::abs(static_cast<double>(cloud_lumps(p, height + 0.04f, 0.0f)) - here);
    }
    EXPECT_NEAR(sum / kPlaces, 0.0, 0.003);
    EXPECT_NEAR(up / along, 1.0, 0.15);
    EXPECT_EQ(cloud_lumps({3.0f, 4.0f}, 0.2f, 1.0f), 0.0f);
}

// A closed layer is flat, and tops come down evenly to it.
TEST(Clouds, ClosedLayersAreFlat)
{
    EXPECT_EQ(cloud_tall(1.0f), 0.0f);
    EXPECT_FLOAT_EQ(cloud_tall(0.3f), 0.45f);
    float before = cloud_tall(0.0f);
    for (int i = 1; i <= 100; ++i) {
        const float tall = cloud_tall(0.01f * static_cast<float>(i));
        EXPECT_LE(tall, before);
        EXPECT_GT(tall, before - 0.03f);
        before = tall;
    }
    EXPECT_EQ(cloud_rise(0.0f), 0.0f);
    for (int i = 0; i < 20; ++i) EXPECT_GT(cloud_rise(0.05f * static_cast<float>(i + 1)), cloud_rise(0.05f * static_cast<float>(i)));
}

}  // namespace
}  // namespace petrichor::shared
