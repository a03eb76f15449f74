#include "film/jobs/night_sky.h"

#include <gtest/gtest.h>

#include <cmath>

#include "film/jobs/sequence.h"

namespace petrichor::film {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

std::int64_t utc(double days_since_1970)
{
    return static_cast<std::int64_t>(days_since_1970 * 86400e6);
}

double apart_degrees(const weather::SunAngles& a, const weather::SunAngles& b)
{
    const double c = std::sin(a.elevation_rad) * std::sin(b.elevation_rad) +
                     std::cos(a.elevation_rad) * std::cos(b.elevation_rad) *
                         std::cos(a.azimuth_rad - b.azimuth_rad);
    return std::acos(std::min(c, 1.0)) / kDegree;
}

TEST(Moon, StandsBeforeTheSunInATotalEclipse)
{
    // 2017-08-21 17:18 over Salem, Oregon; 2024-04-08 18:42 over Dallas, Texas.
    const struct {
        std::int64_t time;
        double latitude, longitude;
    } places[] = {{utc(17399 + (17.0 + 18.0 / 60.0) / 24.0), 44.94, -123.03},
                  {utc(19821 + (18.0 + 42.0 / 60.0) / 24.0), 32.78, -96.80}};
    for (const auto& p : places) {
        const MoonAt moon = moon_by_place(p.time, p.latitude, p.longitude);
        const auto sun = weather::sun_angles(p.time, p.latitude, p.longitude);
        EXPECT_LT(apart_degrees(moon.angles, sun), 0.5);
        EXPECT_LT(moon.illuminated, 0.001);
        // A fortnight later it is full and on the other side of the sky.
        const MoonAt full = moon_by_place(p.time + utc(14.765), p.latitude, p.longitude);
        EXPECT_GT(full.illuminated, 0.97);
        EXPECT_GT(full.lux, 0.1);
    }
}

TEST(Moon, GivesAQuarterOfALuxWhenFullAndATenthOfThatAtHalf)
{
    EXPECT_NEAR(moon_lux(1.0), 0.263, 0.01);
    EXPECT_NEAR(moon_lux(0.5) / moon_lux(1.0), 0.09, 0.02);
    double before = 0.0;
    for (double lit = 0.05; lit <= 1.0; lit += 0.05) {
        EXPECT_GT(moon_lux(lit), before);
        before = moon_lux(lit);
    }
}

TEST(Stars, TurnOnceInASiderealDay)
{
    // 2000-01-01 12:00 at Greenwich: 18.697 h.
    EXPECT_NEAR(sidereal_rad(utc(10957.5), 0.0) / kDegree, 280.46, 0.01);
    const double day = 86164.0905 / 86400.0;
    const double later = sidereal_rad(utc(10957.5 + day), 0.0) - sidereal_rad(utc(10957.5), 0.0);
    EXPECT_NEAR(std::remainder(later, 360.0 * kDegree), 0.0, 1e-4);
    EXPECT_NEAR(sidereal_rad(utc(10957.5), 30.0) - sidereal_rad(utc(10957.5), 0.0), 30.0 * kDegree,
                1e-9);
}

TEST(NightSky, FollowsTheKeysThenTheClockThenTheSun)
{
    weather::Moment moment;
    ScenarioSun sun;
    const weather::SunAngles south{-10.0 * kDegree, 0.0};  // midnight: the sun is in the north
    const NightSky plain = night_sky_at({}, sun, moment, south, 0.0);
    EXPECT_FALSE(plain.moon) << "nobody knows the date";
    // At the equinox the vernal point is where the sun is: twelve hours away.
    EXPECT_NEAR(std::abs(std::remainder(plain.sidereal_rad, 360.0 * kDegree)), 180.0 * kDegree,
                1e-6);
    ScenarioMoon keys;
    keys.elevation_degrees.keys = {{0.0, 40.0}};
    keys.illuminated.keys = {{0.0, 0.5}};
    const NightSky by_keys = night_sky_at(keys, sun, moment, south, 0.0);
    ASSERT_TRUE(by_keys.moon);
    EXPECT_NEAR(by_keys.moon->angles.elevation_rad, 40.0 * kDegree, 1e-9);
    EXPECT_NEAR(by_keys.moon->lux, moon_lux(0.5), 1e-9);
    moment.utc_us = utc(19821.0);
    moment.latitude_deg = 32.78;
    moment.longitude_deg = -96.80;
    const NightSky by_clock = night_sky_at({}, sun, moment, south, 0.0);
    ASSERT_TRUE(by_clock.moon);
    EXPECT_NEAR(by_clock.latitude_rad, 32.78 * kDegree, 1e-9);
    EXPECT_NEAR(by_clock.moon->angles.azimuth_rad,
                moon_by_place(*moment.utc_us, 32.78, -96.80).angles.azimuth_rad, 1e-12);
}

TEST(NightSky, ReachesTheFrame)
{
    Sequence sequence = make_sequence(parse_scenario(
        "[scene]\nnorth_degrees = 90\n[moon]\nelevation_degrees = 20\nazimuth_degrees = 100\n",
        "s.toml"));
    sequence.framing.bounds = {glm::vec3(-1.0f), glm::vec3(1.0f)};
    const gpu::Sky sky = frame_at(sequence, {0}).frame.sky;
    EXPECT_NEAR(sky.moon_elevation_rad, 20.0f * 0.0174533f, 1e-5f);
    EXPECT_NEAR(sky.moon_azimuth_rad, 190.0f * 0.0174533f, 1e-5f);
    EXPECT_GT(sky.moon_lux, 0.2f);
}

}  // namespace
}  // namespace petrichor::film
