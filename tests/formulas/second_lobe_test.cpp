#include "formulas/light/second_lobe.h"

#include <gtest/gtest.h>

namespace petrichor::shared {
namespace {

TEST(SecondLobe, IsReadAsItIsWritten)
{
    const vec3 n = normalize(vec3(0.3f, -0.4f, 1.0f));
    const SecondLobe lobe = second_lobe_of(vec4(0.5f + 0.5f * n.x, 0.5f + 0.5f * n.y, 0.35f, 0.2f));
    EXPECT_NEAR(length(lobe.normal - n), 0.0f, 1e-5f);
    EXPECT_EQ(lobe.roughness, 0.35f);
    EXPECT_EQ(lobe.share, 0.2f);
}

// x and y of codes may lie a little past the unit circle.
TEST(SecondLobe, NormalsHaveUnitLengthAndPointUp)
{
    for (const float x : {0.0f, 0.2f, 0.5f, 1.0f}) {
        const SecondLobe lobe = second_lobe_of(vec4(x, 0.02f, 0.5f, 0.5f));
        EXPECT_NEAR(length(lobe.normal), 1.0f, 1e-5f);
        EXPECT_GE(lobe.normal.z, 0.0f);
    }
}

// Level 0: both are the same, and so is what is seen, whatever the share.
TEST(SecondLobe, TwoThatAreTheSameAreOne)
{
    const vec3 n = normalize(vec3(0.1f, 0.2f, 1.0f)), light(0.3f, 0.5f, 0.7f);
    for (const float share : {0.0f, 0.3f, 0.5f, 1.0f}) {
        const SecondLobe lobe{n, 0.4f, share};
        EXPECT_NEAR(length(diffuse_normal(n, lobe) - n), 0.0f, 1e-6f);
        EXPECT_NEAR(length(shine_of_both(light, light, lobe) - light), 0.0f, 1e-6f);
    }
}

TEST(SecondLobe, ItsShareTakesFromTheFirst)
{
    const vec3 a = normalize(vec3(0.5f, 0.0f, 1.0f)), b = normalize(vec3(-0.5f, 0.0f, 1.0f));
    EXPECT_NEAR(length(diffuse_normal(a, {b, 0.5f, 0.0f}) - a), 0.0f, 1e-6f);
    EXPECT_NEAR(length(diffuse_normal(a, {b, 0.5f, 1.0f}) - b), 0.0f, 1e-6f);
    EXPECT_NEAR(diffuse_normal(a, {b, 0.5f, 0.5f}).x, 0.0f, 1e-6f);
    EXPECT_NEAR(shine_of_both(splat3(1.0f), splat3(3.0f), {b, 0.5f, 0.25f}).x, 1.5f, 1e-6f);
}

}  // namespace
}  // namespace petrichor::shared
