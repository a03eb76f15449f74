// The relief of steep wide ground that no mesh has.
#include "formulas/weather/land_relief.h"

#include <gtest/gtest.h>

#include <cmath>

namespace petrichor::shared {
namespace {

struct Spread {
    double mean = 0.0, deviation = 0.0;
};

// Over places of a slope that rises by 1.5 along z.
template <typename Value>
Spread over_a_slope(Value value)
{
    constexpr int kPlaces = 20000;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < kPlaces; ++i) {
        const float x = 4000.0f * hash_f(static_cast<uint>(i)) - 2000.0f;
        const float z = 4000.0f * hash_f(static_cast<uint>(i) + 99991u) - 2000.0f;
        const auto v = static_cast<double>(value(vec3(x, 1.5f * z, z)));
        sum += v / kPlaces;
        squares += v * v / kPlaces;
    }
    return {sum, std::sqrt(squares - sum * sum)};
}

const vec3 kNormal = normalize(vec3(0.0f, 1.0f, -1.5f));

vec3 normal_at(vec3 p, float width_m, float strength)
{
    return land_normal(kNormal, slope_relief(p, width_m).flatter, land_ribs(p, width_m), strength);
}

TEST(LandRelief, TurnsTheNormalOfSteepGroundByAboutThirteenDegreesEitherWay)
{
    EXPECT_EQ(land_relief_share(1.0f), 0.0f);
    EXPECT_EQ(land_relief_share(kLandReliefUp), 0.0f);
    EXPECT_EQ(land_relief_share(0.5f), 1.0f);
    const Spread up = over_a_slope([](vec3 p) { return normal_at(p, 0.0f, 1.0f).y; });
    const Spread aside = over_a_slope([](vec3 p) { return normal_at(p, 0.0f, 1.0f).x; });
    EXPECT_NEAR(up.mean, static_cast<double>(kNormal.y), 0.04);
    EXPECT_NEAR(aside.mean, 0.0, 0.01);
    const double turned = std::hypot(aside.deviation, up.deviation / static_cast<double>(std::abs(kNormal.z)));
    EXPECT_NEAR(turned, std::sqrt(2.0) * std::sin(13.0 * 0.01745), 0.06);
    EXPECT_NEAR(static_cast<double>(length(normal_at(vec3(3, 4, 5), 0.0f, 1.0f))), 1.0, 1e-5);
}

TEST(LandRelief, IsGoneInAWidePixelAndAtNoStrength)
{
    const double near = over_a_slope([](vec3 p) { return normal_at(p, 0.0f, 1.0f).x; }).deviation;
    EXPECT_LT(over_a_slope([](vec3 p) { return normal_at(p, 60.0f, 1.0f).x; }).deviation, 0.1 * near);
    EXPECT_LT(over_a_slope([](vec3 p) { return normal_at(p, 0.0f, 0.0f).x; }).deviation, 1e-6);
    EXPECT_EQ(land_normal(vec3(0, 1, 0), 2.0f, 2.0f, 1.0f), vec3(0, 1, 0));
}

TEST(LandRelief, WhatIsFlatterHereIsTurnedUp)
{
    EXPECT_GT(land_normal(kNormal, 1.0f, 0.0f, 1.0f).y, kNormal.y + 0.1f);
    EXPECT_LT(land_normal(kNormal, -1.0f, 0.0f, 1.0f).y, kNormal.y - 0.1f);
}

// Ribs and gullies run down the slope: along it other ground is met sooner than down it.
TEST(LandRelief, RibsAndGulliesRunDownTheSlope)
{
    const vec3 down = vec3(0.0f, 1.5f, 1.0f) / std::sqrt(3.25f);
    const auto changes = [&](const auto& value, float step_m, vec3 way) {
        return over_a_slope([&](vec3 p) { return value(p + way * step_m) - value(p); }).deviation;
    };
    const auto ribs = [](vec3 p) { return land_ribs(p, 0.0f); };
    const auto gullies = [](vec3 p) { return with_gullies(SlopeRelief{0.0f, 0.0f}, p, 0.0f, 1.0f).flatter; };
    EXPECT_GT(changes(ribs, 3.0f, vec3(1, 0, 0)), 1.1 * changes(ribs, 3.0f, down));
    EXPECT_GT(changes(gullies, 8.0f, vec3(1, 0, 0)), 1.1 * changes(gullies, 8.0f, down));
}

// Gullies hold what ribs have lost; a wide pixel says how much of them it does not see.
TEST(LandRelief, GulliesAddToTheReliefAndToWhatIsLostOfIt)
{
    const auto gullies = [](vec3 p, float width_m) { return with_gullies(SlopeRelief{0.0f, 0.0f}, p, width_m, 1.0f).flatter; };
    const Spread s = over_a_slope([&](vec3 p) { return gullies(p, 0.0f); });
    EXPECT_NEAR(s.mean, 0.0, 0.05);
    EXPECT_NEAR(s.deviation, 0.8, 0.1);
    for (const float width_m : {0.0f, 6.0f, 25.0f}) {
        const SlopeRelief all = with_gullies(SlopeRelief{0.0f, 0.0f}, vec3(1, 2, 3), width_m, 1.0f);
        const double seen = over_a_slope([&](vec3 p) { return gullies(p, width_m); }).deviation;
        EXPECT_NEAR(seen * seen + static_cast<double>(all.lost), 0.64, 0.16) << width_m;
    }
    const SlopeRelief none = with_gullies(SlopeRelief{0.7f, 0.2f}, vec3(1, 2, 3), 5.0f, 0.0f);
    EXPECT_EQ(none.flatter, 0.7f);
    EXPECT_EQ(none.lost, 0.2f);
}

}  // namespace
}  // namespace petrichor::shared
