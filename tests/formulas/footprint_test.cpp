#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formulas/geometry/footprint.h"

namespace petrichor::shared {
namespace {

TEST(Footprint, OneSampleReadsAsBefore)
{
    EXPECT_EQ(footprint_scale({0.3f, 0.1f}, {-0.02f, 0.4f}, 1.0f, 1.0f), 1.0f);
    EXPECT_EQ(footprint_scale({0.0f, 0.0f}, {0.0f, 0.0f}, 8.0f, 1.0f), 1.0f);
}

TEST(Footprint, SamplesShareTheArea)
{
    EXPECT_NEAR(footprint_scale({0.1f, 0}, {0, 0.1f}, 16.0f, 1.0f), 0.25f, 1e-6f) << "two levels finer";
    // Four times as long as wide: of 4 samples each covers the width.
    EXPECT_NEAR(footprint_scale({0.4f, 0}, {0, 0.1f}, 4.0f, 1.0f), 0.25f, 1e-6f);
    // So thin that the samples lie a quarter of its length apart.
    EXPECT_NEAR(footprint_scale({0.4f, 0}, {0, 0.001f}, 4.0f, 1.0f), 0.25f, 1e-6f);
}

TEST(Footprint, NeverLeavesGapsAndOnlyGetsFinerWithSamples)
{
    for (float ratio = 1.0f; ratio < 200.0f; ratio *= 1.3f) {
        float before = 2.0f;
        for (const float n : {1.0f, 2.0f, 4.0f, 8.0f, 64.0f}) {
            const glm::vec2 dx(0.6f * ratio, 0.8f * ratio), dy(-0.8f, 0.6f);
            const float scale = footprint_scale(dx, dy, n, 1.0f);
            const float side = scale * ratio;  // of the square that is read
            EXPECT_GE(side * side * n, ratio * 0.9999f) << "the whole area";
            EXPECT_GE(side * n, ratio * 0.9999f) << "the whole length";
            EXPECT_LE(scale, before);
            before = scale;
        }
    }
}

// Of a sampler that follows the footprint samples shorten what is round in it alone.
TEST(Footprint, ASamplerThatIsDrawnOutNeedsNoFinerLevel)
{
    EXPECT_NEAR(footprint_scale({0.4f, 0}, {0, 0.1f}, 4.0f, 8.0f), 0.5f, 1e-6f) << "half as long, half as wide";
    EXPECT_NEAR(footprint_scale({0.4f, 0}, {0, 0.1f}, 4.0f, 2.0f), std::sqrt(0.125f), 1e-6f) << "twice as long as wide, the area between four";
    EXPECT_EQ(footprint_scale({0.4f, 0}, {0, 0.1f}, 1.0f, 8.0f), 1.0f);
    EXPECT_NEAR(footprint_scale({0.1f, 0}, {0, 0.1f}, 16.0f, 8.0f), 0.25f, 1e-6f) << "what is round is as before";
    // One sample of it is as fine across as without it many are.
    for (float ratio = 1.0f; ratio < 200.0f; ratio *= 1.3f) {
        for (const float n : {2.0f, 8.0f, 64.0f}) {
            const glm::vec2 dx(0.6f * ratio, 0.8f * ratio), dy(-0.8f, 0.6f);
            const float longer = footprint_scale(dx, dy, n, 8.0f) * ratio, drawn = std::min(ratio, 8.0f);
            EXPECT_GE(longer * longer / drawn * n, ratio * 0.9999f) << "the whole area";
            EXPECT_GE(footprint_scale(dx, dy, n, 8.0f), footprint_scale(dx, dy, n, 1.0f));
        }
    }
}

}  // namespace
}  // namespace petrichor::shared
