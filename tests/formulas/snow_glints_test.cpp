#include "formulas/weather/snow_glints.h"

#include <gtest/gtest.h>

#include <cmath>

namespace petrichor::shared {
namespace {

struct Spread {
    double mean = 0.0, variance = 0.0, lit = 0.0;
};

// Over places and half vectors.
Spread spread_of(float seen_m, float lobe)
{
    const std::uint32_t n = 400000;
    Spread s;
    double squares = 0.0;
    for (std::uint32_t i = 0; i < n; ++i) {
        const vec2 at(40.0f * hash_f(4 * i), 40.0f * hash_f(4 * i + 1));
        const vec2 lean(2.0f * hash_f(4 * i + 2) - 1.0f, 2.0f * hash_f(4 * i + 3) - 1.0f);
        const double x = static_cast<double>(snow_glints(at, seen_m, lean, lobe));
        s.mean += x / n;
        squares += x * x / n;
        s.lit += x > 0.01 ? 1.0 / n : 0.0;
    }
    s.variance = squares - s.mean * s.mean;
    return s;
}

TEST(SnowGlints, LeaveTheMeanOfTheLobe)
{
    EXPECT_NEAR(spread_of(0.004f, 2.0f).mean, 1.0, 0.15);
    EXPECT_NEAR(spread_of(0.02f, 2.0f).mean, 1.0, 0.05);
    EXPECT_NEAR(spread_of(0.2f, 1.0f).mean, 1.0, 0.02);
    EXPECT_NEAR(spread_of(5.0f, 1.0f).mean, 1.0, 0.01);
}

TEST(SnowGlints, AreFewNearByAndAnEvenSheetFromAfar)
{
    const Spread near = spread_of(0.004f, 2.0f), middle = spread_of(0.03f, 2.0f), far = spread_of(3.0f, 2.0f);
    // Crystals that stand right: in a cell of 4 mm and in one of 8 mm.
    const double expected = static_cast<double>(kCrystals_m2 * 2.0f * kFacet_rad * kFacet_rad) * (16e-6 + 64e-6);
    EXPECT_LT(near.lit, expected);
    EXPECT_GT(near.lit, 0.0005) << "but there are some";
    EXPECT_GT(near.variance, 20.0 * middle.variance);
    EXPECT_GT(middle.variance, 20.0 * far.variance);
    EXPECT_LT(far.variance, 0.01);
}

TEST(SnowGlints, ComeAndGoAsTheViewTurns)
{
    // A step of a tenth of what a crystal serves never makes one of nothing.
    int lit = 0;
    for (std::uint32_t i = 0; i < 200000; ++i) {
        const vec2 at(9.0f * hash_f(2 * i), 9.0f * hash_f(2 * i + 1));
        const float a = snow_glints(at, 0.004f, vec2(0.2f, 0.1f), 2.0f);
        const float b = snow_glints(at, 0.004f, vec2(0.2f + 1e-4f * kFacet_rad, 0.1f), 2.0f);
        EXPECT_NEAR(a, b, 0.01f * (a + b) + 2.0f);
        lit += a > 1.0f ? 1 : 0;
    }
    EXPECT_GT(lit, 100);
}

}  // namespace
}  // namespace petrichor::shared
