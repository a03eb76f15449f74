// What a patch sees of sun, sky, wind and rain: closed forms and values of the literature.
#include <gtest/gtest.h>

#include <cmath>

#include "weather/patches/driving_rain.h"
#include "weather/patches/place_factors.h"
#include "weather/patches/sky_light.h"
#include "weather/patches/visibility.h"
#include "weather/physics/constants.h"
#include "weather/physics/detail/portable_math.h"
#include "weather/physics/solar.h"

namespace petrichor::weather {
namespace {

constexpr double kDegree = kPi / 180.0;

Direction tilted(double degrees)
{
    return {std::sin(degrees * kDegree), std::cos(degrees * kDegree), 0.0};
}

TEST(PatchShares, TheBitsCoverTheHemisphere)
{
    double sum = 0.0;
    for (int i = 0; i < kVisibleBits; ++i) {
        const Direction d = visible_direction(i);
        EXPECT_NEAR(dot(d, d), 1.0, 1e-12);
        EXPECT_GT(d.y, 0.0);
        sum += visible_solid_angle_sr(i);
        const VisibleLookup at = visible_lookup(d);
        float own = 0.0f, all = 0.0f;
        for (std::size_t k = 0; k < 4; ++k) {
            all += at.weight[k];
            if (at.texel[k] == i) own += at.weight[k];
        }
        EXPECT_NEAR(own, 1.0f, 1e-5f) << i;
        EXPECT_NEAR(all, 1.0f, 1e-6f);
    }
    EXPECT_NEAR(sum, 2.0 * kPi, 0.02);
}

TEST(PatchShares, ArcCosineIsTheInverseOfTheCosine)
{
    for (double angle = 0.0; angle <= kPi; angle += 0.01)
        EXPECT_NEAR(detail::arc_cosine(std::cos(angle)), angle, 1e-7) << angle;
    EXPECT_EQ(detail::arc_cosine(1.0), 0.0);
    EXPECT_NEAR(detail::arc_cosine(0.5), kPi / 3.0, 1e-12);
}

TEST(PatchShares, OpenPlanesSeeTheirShareOfTheSky)
{
    for (const double tilt : {0.0, 20.0, 45.0, 70.0, 90.0}) {
        const Direction normal = tilted(tilt);
        const SkyShares s = sky_shares(open_sky(normal), normal);
        EXPECT_NEAR(s.sky, 0.5 * (1.0 + std::cos(tilt * kDegree)), 0.003) << tilt;
        EXPECT_NEAR(s.horizon, 1.0, 1e-12);
    }
    // Mean of ln sec z: the reference's values.
    EXPECT_NEAR(sky_shares(open_sky({}), {}).log_secant, 0.5, 0.005);
    EXPECT_NEAR(sky_shares(open_sky(tilted(45)), tilted(45)).log_secant, 0.74350, 0.005);
    EXPECT_NEAR(sky_shares(open_sky(tilted(90)), tilted(90)).log_secant, 1.19199, 0.01);
    VisibleBits cap{};
    for (int i = 0; i < kVisibleBits; ++i)
        if (visible_direction(i).y > std::cos(45 * kDegree))
            cap[static_cast<std::size_t>(i >> 5)] |= 1u << (i & 31);
    EXPECT_NEAR(sky_shares(cap, {}).log_secant, 0.15343, 0.02);
}

TEST(PatchShares, WindIsBlockedFromWhereTheWallStands)
{
    // A wall to the scene's west hides everything with x < 0 below 40 degrees.
    VisibleBits bits{};
    for (int i = 0; i < kVisibleBits; ++i) {
        const Direction d = visible_direction(i);
        if (!(d.x < 0.0 && d.y < std::sin(40 * kDegree)))
            bits[static_cast<std::size_t>(i >> 5)] |= 1u << (i & 31);
    }
    const auto blocked = wind_blocking(bits);
    EXPECT_GT(blocking_from(blocked, 270 * kDegree), 0.95);
    EXPECT_LT(blocking_from(blocked, 90 * kDegree), 0.02);
    EXPECT_NEAR(blocking_from(blocked, 0.0), 0.5, 0.12);
    EXPECT_NEAR(blocking_from(blocked, 0.3), blocking_from(blocked, 0.3 + 2.0 * kPi * 3.0), 1e-9);
    for (const float b : wind_blocking(open_sky({}))) EXPECT_EQ(b, 0.0f);
}

TEST(PatchShares, DiffuseShareOfErbs)
{
    const double expected[] = {.991000, .904253, .659150, .333612, .165270};
    const double index[] = {.1, .35, .5, .65, .8};
    for (int i = 0; i < 5; ++i) EXPECT_NEAR(erbs_diffuse_fraction(index[i]), expected[i], 1e-6);
}

// The reference's table, made with I0 = 1400 and no mask.
TEST(PatchShares, AnisotropicSkyOfPerez)
{
    struct Row {
        double zenith_deg, diffuse, direct, tilt, facing, expected;
    };
    for (const Row& r :
         {Row{60, 201.234, 397.532, 0, 1, 201.234}, Row{60, 201.234, 397.532, 90, 1, 188.356},
          Row{60, 201.234, 397.532, 90, -1, 79.372}, Row{75, 122.793, 105.119, 90, 1, 142.138}}) {
        const double z = r.zenith_deg * kDegree;
        const SkyGlow glow = perez_glow(r.diffuse, r.direct, 1400.0, z);
        const double tilt = r.tilt * kDegree;
        const double facing =
            std::max(0.0, std::cos(z) * std::cos(tilt) + r.facing * std::sin(z) * std::sin(tilt));
        const SkySeen seen{0.5 * (1.0 + std::cos(tilt)), 1.0, facing / std::cos(z), std::sin(tilt)};
        EXPECT_NEAR(sky_light_w_m2(r.diffuse, glow, seen), r.expected, 2e-3);
    }
    const SkyGlow four = perez_glow(201.234, 397.532, 1400.0, 60 * kDegree);
    EXPECT_NEAR(four.sun, .31268, 2e-5);
    EXPECT_NEAR(four.horizon, .05077, 2e-5);
    EXPECT_NEAR(relative_air_mass(60 * kDegree), 1.9942, 1e-3);
}

// By hand from the depths of Kasten 1996: 1 / 8.267 at an air mass of 1, 1 / 9.694 at 1.994.
TEST(PatchShares, TheBeamOfTheClearestAir)
{
    EXPECT_NEAR(clear_beam_w_m2(1000.0, 0.0, 0.0), 811.0, 0.5);
    EXPECT_NEAR(clear_beam_w_m2(1000.0, 60 * kDegree, 0.0), 700.2, 0.5);
    EXPECT_GT(clear_beam_w_m2(1000.0, 60 * kDegree, 2000.0), 730.0);
    double last = 1000.0;
    for (int z = 0; z <= 90; ++z) {
        const double beam = clear_beam_w_m2(1000.0, z * kDegree, std::nan(""));
        EXPECT_LT(beam, last);
        last = beam;
    }
    EXPECT_LT(last, 200.0);
}

TEST(PatchShares, AWallGainsFromTheWarmHorizon)
{
    EXPECT_NEAR(warm_horizon_w_m2(1.19199, 0.0, 275.15) * 0.5, 10.0, 0.2);
    EXPECT_EQ(warm_horizon_w_m2(1.19199, 1.0, 275.15), 0.0);
    EXPECT_EQ(warm_horizon_w_m2(0.5, 0.0, 275.15), 0.0);
}

TEST(PatchShares, DropsAndTheirAngles)
{
    EXPECT_NEAR(rain_fall_speed_m_s(2.0), 6.55, 0.01);
    const double gunn[] = {2.06, 4.03, 6.49, 8.06, 8.83, 9.09};
    const double size[] = {.5, 1, 2, 3, 4, 5};
    for (int i = 1; i < 6; ++i) EXPECT_NEAR(rain_fall_speed_m_s(size[i]), gunn[i], 0.17);
    const double angle[] = {68.0, 51.4, 37.4, 32.2, 28.7};
    const double drop[] = {.5, 1, 2, 3, 5};
    for (int i = 0; i < 5; ++i)
        EXPECT_NEAR(std::atan(5.0 / rain_fall_speed_m_s(drop[i])) / kDegree, angle[i], 0.06);
    for (double d = 0.1; d < 6.0; d += 0.01)
        EXPECT_GE(rain_fall_speed_m_s(d + 0.01), rain_fall_speed_m_s(d) - 0.01);  // the laws meet
}

TEST(PatchShares, RainOnPlanes)
{
    const double lacy[] = {.2220, .1830, .1684, .1388};
    const double rate[] = {1, 5, 10, 50};
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(lacy_s_m(rate[i]), lacy[i], 5e-5);
    // R = U = 5, the wind goes to +x; a surface that faces -x stands to windward.
    const auto on = [](double tilt, double side) {
        const Direction n = tilted(tilt);
        return rain_on_plane({side * n.x, n.y, 0.0}, 5.0, 0.0, 5.0);
    };
    EXPECT_NEAR(on(30, -1), 1.3236, 1e-4);
    EXPECT_NEAR(on(30, 1), .4085, 1e-4);
    EXPECT_NEAR(on(45, 1), .0601, 1e-4);
    EXPECT_NEAR(on(90, -1), .91505, 1e-5);
    EXPECT_EQ(on(90, 1), 0.0);
    const double half = std::sqrt(0.5);
    EXPECT_NEAR(rain_on_plane({-half, 0.0, half}, 5.0, 0.0, 5.0), .6470, 1e-4);
    EXPECT_NEAR(rain_on_plane(tilted(30), 0.0, 0.0, 5.0), .866025, 1e-6);
    EXPECT_TRUE(std::isfinite(rain_on_plane(tilted(90), 60.0, 0.0, 0.0)));
    // What a box takes in all is what its ground would take: 10 m on 100 x 100 m.
    const double k = lacy_s_m(5.0) * 5.0;
    const double roof = 100 * on(0, 1), wall = 100 * on(90, -1);
    EXPECT_NEAR(roof + wall + (10000 - 100 - k * 100), 10000, 1e-9);
}

TEST(PatchShares, NoRainUnderARoofAndMoreBelowItsEdgeInWind)
{
    VisibleBits roofed{};  // only what lies below 30 degrees to the east is open
    for (int i = 0; i < kVisibleBits; ++i) {
        const Direction d = visible_direction(i);
        if (d.x > 0.0 && d.y < 0.5) roofed[static_cast<std::size_t>(i >> 5)] |= 1u << (i & 31);
    }
    EXPECT_EQ(rain_share(roofed, rain_fan(0.0, 0.0, 5.0)), 0.0);
    EXPECT_EQ(rain_share(roofed, rain_fan(20.0, 0.0, 5.0)), 0.0);
    EXPECT_GT(rain_share(roofed, rain_fan(-20.0, 0.0, 5.0)), 0.7);  // comes from the east
    EXPECT_NEAR(rain_share(open_sky({}), rain_fan(-60.0, 3.0, 50.0)), 1.0, 1e-6);
    EXPECT_NEAR(rain_share(open_sky({}), rain_fan(0.0, 0.0, 1e-9)), 1.0, 1e-6);
}

TEST(PatchShares, DripsAndSplashes)
{
    EXPECT_NEAR(drip_speed_m_s(3.0), 6.50, 0.01);
    EXPECT_NEAR(drip_speed_m_s(6.0), 7.95, 0.01);
    EXPECT_NEAR(splash_share(0.0, 1.0), 0.15, 1e-12);
    EXPECT_NEAR(splash_share(0.1, 0.3), 0.15 * 0.3 * std::exp(-1.0), 1e-12);
    EXPECT_EQ(splash_share(0.5, 1.0), 0.0);
    EXPECT_EQ(splash_share(0.1, 0.0), 0.0);
    EXPECT_NEAR(snow_holds(30 * kDegree), 1.0, 1e-12);
    EXPECT_NEAR(snow_holds(45 * kDegree), 0.5, 1e-12);
    EXPECT_NEAR(snow_holds(60 * kDegree), 0.0, 1e-12);
    EXPECT_NEAR(wall_rain_factor(1.0, true), 0.95, 1e-12);
    EXPECT_NEAR(wall_rain_factor(0.0, false), 0.25, 1e-12);
}

TEST(PatchShares, FactorsOfPlaces)
{
    PatchKind kind;
    PlaceClimate climate;
    climate.wind_m_s = 5.0;
    climate.wind_from_deg = 270.0;
    WeatherPatch open;
    open.visible = open_sky({});
    const PlaceFactors one = place_factors(open, kind, climate);
    EXPECT_NEAR(one.rain, 1.0, 1e-12);
    EXPECT_NEAR(one.drying, 1.0, 1e-12);
    EXPECT_NEAR(one.freezing, 1.0, 1e-5);
    EXPECT_NEAR(one.snow, 1.0, 1e-12);
    WeatherPatch roofed;
    const PlaceFactors none = place_factors(roofed, kind, climate);
    EXPECT_EQ(none.rain, 0.0);
    EXPECT_EQ(none.snow, 0.0);
    EXPECT_LT(none.drying, 0.2);
    EXPECT_LT(none.freezing, 0.3);
    // A wall to the south takes the sun: it dries more slowly, and as much rain falls.
    WeatherPatch shaded = open;
    for (int i = 0; i < kVisibleBits; ++i) {
        const Direction d = visible_direction(i);
        if (d.z > 0.0 && d.y < 0.8)
            shaded.visible[static_cast<std::size_t>(i >> 5)] &= ~(1u << (i & 31));
    }
    climate.wind_m_s = 0.0;
    const PlaceFactors dim = place_factors(shaded, kind, climate);
    EXPECT_LT(dim.drying, 0.85);
    EXPECT_NEAR(dim.rain, 1.0, 1e-12);
    // A house to the west, whose eaves stand 60 degrees high: in its lee a gale's drops fall steeply, and
    // rain comes over it; without the lee next to none would.
    WeatherPatch lee = open;
    for (int i = 0; i < kVisibleBits; ++i) {
        const Direction d = visible_direction(i);
        if (d.x < 0.0 && d.y < 0.7)
            lee.visible[static_cast<std::size_t>(i >> 5)] &= ~(1u << (i & 31));
    }
    climate.wind_m_s = 20.0;
    const double straight = rain_share(lee.visible, rain_fan(20.0, 0.0, climate.rain_mm_h));
    EXPECT_LT(straight, 0.1);
    EXPECT_GT(place_factors(lee, kind, climate).rain, straight + 0.3);
    // Two winds of a script: the mean of both.
    const WeightedClimate winds[] = {{climate, 0.25}, {PlaceClimate{.wind_m_s = 0.0}, 0.75}};
    const PlaceFactors mean = place_factors(lee, kind, winds, sun_path(climate));
    EXPECT_NEAR(mean.rain, 0.25 * place_factors(lee, kind, climate).rain +
                               0.75 * place_factors(lee, kind, {.wind_m_s = 0.0}).rain, 1e-12);
    // West wind: the wall that faces west is wet, the other dry; neither holds snow.
    climate.wind_m_s = 5.0;
    WeatherPatch wall;
    wall.normal = {-1.0, 0.0, 0.0};
    wall.visible = open_sky(wall.normal);
    EXPECT_NEAR(place_factors(wall, kind, climate).rain, .91505, 1e-4);
    EXPECT_EQ(place_factors(wall, kind, climate).snow, 0.0);
    climate.wind_from_deg = 90.0;
    EXPECT_EQ(place_factors(wall, kind, climate).rain, 0.0);
}

}  // namespace
}  // namespace petrichor::weather
