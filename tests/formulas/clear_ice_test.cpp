// What is seen through icicles: Snell's law through a round section.
#include "formulas/light/clear_ice.h"

#include <gtest/gtest.h>

#include <cmath>

namespace petrichor::shared {
namespace {

// Of a level ray that meets a plumb round body so far beside its axis, in radii, from the eye's left.
vec3 normal_at(float beside)
{
    return {beside, 0.0f, std::sqrt(1.0f - beside * beside)};
}

TEST(ClearIce, BendsLevelRaysAsARoundSectionDoes)
{
    const vec3 view(0.0f, 0.0f, -1.0f);
    for (const float beside : {-0.9f, -0.5f, -0.1f, 0.0f, 0.2f, 0.6f, 0.95f}) {
        const SeenThroughIce seen = seen_through_ice(view, normal_at(beside));
        // Both sides turn it towards the axis by the same angle.
        const float turned = 2.0f * (std::asin(beside) - std::asin(beside / kIceIndex));
        EXPECT_NEAR(seen.way.x, -std::sin(turned), 2e-5f) << beside;
        EXPECT_NEAR(seen.way.z, -std::cos(turned), 2e-5f) << beside;
        EXPECT_NEAR(seen.way.y, 0.0f, 1e-6f);
        EXPECT_NEAR(seen.chord, 2.0f * std::sqrt(1.0f - beside * beside / (kIceIndex * kIceIndex)), 2e-5f);
    }
}

TEST(ClearIce, KeepsTheSlopeOfARayAlongIt)
{
    for (const float up : {-0.8f, -0.3f, 0.4f, 0.7f}) {
        const vec3 view = glm::normalize(vec3(0.0f, up, -1.0f));
        for (const float beside : {-0.7f, 0.0f, 0.4f})
            EXPECT_NEAR(seen_through_ice(view, normal_at(beside)).way.y, view.y, 2e-5f) << up << " " << beside;
    }
}

TEST(ClearIce, LetsThroughWhatItNeitherMirrorsNorClouds)
{
    const vec3 view(0.0f, 0.0f, -1.0f);
    const float both = (1.0f - 0.01801f) * (1.0f - 0.01801f);
    EXPECT_NEAR(seen_through_ice(view, normal_at(0.0f)).through, both * (1.0f - kIceCloud), 1e-4f);
    // The core is cloudier than what is beside it, and the rim mirrors all.
    EXPECT_GT(seen_through_ice(view, normal_at(0.8f)).through, seen_through_ice(view, normal_at(0.0f)).through);
    EXPECT_LT(seen_through_ice(view, normal_at(0.9999f)).through, 0.05f);
    for (int i = 0; i < 4000; ++i) {
        const float a = 0.37f * static_cast<float>(i), b = std::sin(1.7f * static_cast<float>(i));
        const float flat = std::sqrt(1.0f - b * b);
        const SeenThroughIce seen = seen_through_ice(view, vec3(flat * std::cos(a), b, flat * std::abs(std::sin(a))));
        EXPECT_NEAR(glm::length(seen.way), 1.0f, 1e-5f);
        EXPECT_GE(seen.through, 0.0f);
        EXPECT_LE(seen.through, both);
    }
}

}  // namespace
}  // namespace petrichor::shared
