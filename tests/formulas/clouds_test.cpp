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

}  // namespace
}  // namespace petrichor::shared
