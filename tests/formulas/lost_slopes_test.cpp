// What normals lose when several are seen as one. tests/gpu/parity_test.cpp shows that the device computes the same.
#include "formulas/weather/lost_slopes.h"

#include <gtest/gtest.h>

namespace petrichor::shared {
namespace {

glm::vec3 sloped(glm::vec2 slope) { return glm::normalize(glm::vec3(slope, 1.0f)); }

TEST(LostSlopes, AreTheVarianceAroundWhatIsSeen)
{
    const glm::vec2 slopes[] = {{0.2f, 0.1f}, {-0.3f, 0.4f}, {0.0f, -0.25f}, {0.5f, 0.0f}};
    glm::vec2 mean(0.0f);
    float square = 0.0f, around = 0.0f;
    for (const glm::vec2& s : slopes) {
        mean += 0.25f * s;
        square += 0.25f * slope_2(sloped(s));
    }
    for (const glm::vec2& s : slopes) around += 0.25f * glm::dot(s - mean, s - mean);
    EXPECT_NEAR(lost_slopes(square, sloped(mean)), around, 1e-5f);
    EXPECT_EQ(lost_slopes(slope_2(sloped(mean)), sloped(mean)), 0.0f) << "nothing of one normal";
    EXPECT_EQ(lost_slopes(0.0f, sloped(mean)), 0.0f) << "and never less";
    EXPECT_EQ(slope_2({1.0f, 0.0f, 0.0f}), kSteepestSlope_2);
}

TEST(LostSlopes, WidenALobe)
{
    for (const float roughness : {0.05f, 0.3f, 0.8f}) {
        EXPECT_NEAR(with_lost_slopes(roughness, 0.0f), roughness, 1e-6f);
        float before = 0.0f;
        for (const float lost : {0.01f, 0.1f, 0.4f, 3.0f}) {
            EXPECT_GT(with_lost_slopes(roughness, lost), std::max(before, roughness) - 1e-6f);
            before = with_lost_slopes(roughness, lost);
            EXPECT_LE(before, 1.0f);
        }
    }
    // Two steps one after the other are both at once.
    EXPECT_NEAR(with_lost_slopes(with_lost_slopes(0.3f, 0.1f), 0.2f), with_lost_slopes(0.3f, 0.3f), 1e-6f);
}

}  // namespace
}  // namespace petrichor::shared
