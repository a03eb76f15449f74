// Ice that is looked at.
#include "formulas/weather/ice_pattern.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formulas/weather/apply_weather.h"

namespace petrichor::shared {
namespace {

// Evenly white as it was, it is what it was; and it is as white in the mean, from near and afar.
TEST(IcePattern, IsAsWhiteAsEvenIceInTheMean)
{
    WeatheredMaterial under{};
    under.albedo = vec3(0.1f, 0.2f, 0.3f);
    for (const float ice : {0.3f, 1.0f}) {
        const vec3 even = apply_ice(under, ice).albedo;
        const vec3 same = with_ice_pattern(even, ice, kIceMean);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(same[c], even[c], 1e-6f);
        const vec3 clear = with_ice_pattern(even, ice, 0.0f);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(clear[c], under.albedo[c], 1e-6f);
    }
    for (const float wider_m : {0.0f, 0.01f, 0.05f, 1.0f}) {
        double sum = 0.0;
        constexpr int kSide = 300;
        for (int i = 0; i < kSide * kSide; ++i) {
            const float white = ice_white(vec2(0.0731f * static_cast<float>(i % kSide), 0.0717f * static_cast<float>(i / kSide)), wider_m);
            ASSERT_GE(white, 0.0f);
            ASSERT_LE(white, 1.0f);
            sum += static_cast<double>(white);
        }
        EXPECT_NEAR(sum / (kSide * kSide), 0.4, 0.03) << wider_m;
    }
}

// Lines around plates of a foot's width, here and there; clear places and milky ones a step apart.
TEST(IcePattern, HasCracksAndClearPlaces)
{
    int cracks = 0, clear = 0, milky = 0, all = 0;
    for (float z = 0.0f; z < 6.0f; z += 0.013f) {
        for (float x = 0.0f; x < 6.0f; x += 0.0037f) {
            const float white = ice_white(vec2(x, z), 0.0f);
            const float beside = ice_white(vec2(x + 0.02f, z), 0.0f);
            cracks += white - beside > 0.45f ? 1 : 0;
            clear += white < 0.15f ? 1 : 0;
            milky += white > 0.45f ? 1 : 0;
            ++all;
        }
    }
    EXPECT_GT(cracks, all / 500);
    EXPECT_LT(cracks, all / 20);
    EXPECT_GT(clear, all / 10);
    EXPECT_GT(milky, all / 10);
}

}  // namespace
}  // namespace petrichor::shared
