#include "formulas/weather/gusts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formulas/noise/noise.h"

namespace petrichor::shared {
namespace {

vec3 somewhere(std::uint32_t i)
{
    return {400.0f * hash_f(3 * i), 8.0f * hash_f(3 * i + 1), 400.0f * hash_f(3 * i + 2)};
}

TEST(Gusts, LeaveTheMeanOfTheVeil)
{
    const int n = 20000;
    for (const float far : {0.1f, 5.0f, 30.0f}) {
        double sum = 0.0, squares = 0.0;
        for (std::uint32_t i = 0; i < n; ++i) {
            const vec3 from = somewhere(i);
            const float turn = 6.2831853f * hash_f(i + 900001u);
            const float veil = gust_veil(from, from + far * vec3(std::cos(turn), 0.0f, std::sin(turn)),
                                         vec2(17.0f, 5.0f), 1.0f);
            ASSERT_GT(veil, 0.0f);
            sum += static_cast<double>(veil);
            squares += static_cast<double>(veil) * static_cast<double>(veil);
        }
        const double mean = sum / n;
        // There is never less than nothing, which adds a little at a point.
        EXPECT_NEAR(mean, 1.0, far < 1.0f ? 0.05 : 0.02) << far;
        const double spread = std::sqrt(squares / n - mean * mean);
        if (far < 1.0f) {
            EXPECT_NEAR(spread, 0.66, 0.05);
        } else {
            EXPECT_LT(spread, 0.6) << "a way through several clouds sees more of their mean";
        }
    }
}

TEST(Gusts, AreGoneFromAfarAndWithoutWind)
{
    double squares = 0.0;
    const int n = 2000;
    for (std::uint32_t i = 0; i < n; ++i) {
        const vec3 from = somewhere(i);
        const float turn = 6.2831853f * hash_f(i + 7001u);
        const vec3 to = from + 3000.0f * vec3(std::cos(turn), 0.0f, std::sin(turn));
        const double over = static_cast<double>(gust_veil(from, to, vec2(0.0f), 1.0f)) - 1.0;
        squares += over * over / n;
        EXPECT_EQ(gust_veil(from, somewhere(i + 50), vec2(3.0f), 0.0f), 1.0f);
    }
    EXPECT_LT(std::sqrt(squares), 0.002);
    EXPECT_EQ(gust_strength(0.0f, 1.0f), 0.0f);
    EXPECT_EQ(gust_strength(12.0f, 0.0f), 0.0f) << "fog is no snow";
    EXPECT_EQ(gust_strength(12.0f, 3.0f), 1.0f);
    EXPECT_EQ(gust_strength(12.0f, 9.0f), 0.0f) << "clear air, whatever falls";
}

TEST(Gusts, GoWithTheWind)
{
    for (std::uint32_t i = 0; i < 200; ++i) {
        const vec3 from = somewhere(i), to = somewhere(i + 300);
        const vec2 way(12.0f * hash_f(i), -7.0f);
        const vec3 moved(way.x, 0.0f, way.y);
        const float there = gust_veil(from + moved, to + moved, way, 1.0f);
        EXPECT_NEAR(there, gust_veil(from, to, vec2(0.0f), 1.0f), 3e-3f);
        // The way of the wind is cut to the period.
        EXPECT_NEAR(there, gust_veil(from + moved, to + moved, way + vec2(kGustPeriod_m, -kGustPeriod_m), 1.0f), 2e-3f);
    }
}

// Whatever the direction: along the crest of a wave, too.
TEST(Gusts, ShowNoStripesFromAfar)
{
    float most = 0.0f;
    for (std::uint32_t i = 0; i < 3600; ++i) {
        const float turn = 0.0017453f * static_cast<float>(i);
        const vec3 from = somewhere(i % 7);
        const vec3 to = from + 600.0f * vec3(std::cos(turn), -0.3f, std::sin(turn));
        most = std::max(most, std::abs(gust_veil(from, to, vec2(0.0f), 1.0f) - 1.0f));
    }
    EXPECT_LT(most, 0.05f);
}

}  // namespace
}  // namespace petrichor::shared
