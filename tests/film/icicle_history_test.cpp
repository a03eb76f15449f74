// Icicles over time: water that freezes, no more than there is and than the air can.
#include "film/weather/icicle_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace petrichor::film {
namespace {

using shared::WeatherMoment;

WeatherMoment air(double celsius, double rain_mm_h = 0.0)
{
    WeatherMoment w;
    w.air_temperature_k = static_cast<float>(celsius + 273.15);
    w.rain_kg_m2_s = static_cast<float>(rain_mm_h / 3600.0);
    w.film_mm = rain_mm_h > 0.0 ? 1.0f : 0.0f;
    w.wind_m_s = {3.0f, 0.0f};
    return w;
}

double longest(const scene::IcicleLengths& l) { return static_cast<double>(*std::max_element(l.length_m.begin(), l.length_m.end())); }

// Rain for some hours at a temperature, then dry at another.
IcicleHistory rain_then(double rain_mm_h, double celsius, double hours, double then_celsius, double all_hours = 48.0)
{
    return IcicleHistory([=](double s) { return s < hours ? air(celsius, rain_mm_h) : air(then_celsius); }, {0.0, all_hours, 3600.0});
}

TEST(IcicleGrowth, HeatGoesAsThatOfAWetCylinder)
{
    WeatherMoment moist = air(0.0);
    moist.relative_humidity = 1.0f;
    EXPECT_NEAR(icicle_cooling_w_m2(moist, 0.01), 0.0, 1e-3);
    EXPECT_GT(icicle_cooling_w_m2(air(0.0), 0.01), 5.0) << "dry air alone cools there";
    double before = icicle_cooling_w_m2(air(3.0), 0.01);
    EXPECT_LT(before, 0.0);
    for (const double celsius : {0.0, -2.0, -5.0, -10.0, -20.0}) {
        const double now = icicle_cooling_w_m2(air(celsius), 0.01);
        EXPECT_GT(now, before);
        before = now;
    }
    // Makkonen 1988: some hundred W/m2 at -10 C in a light wind.
    EXPECT_GT(icicle_cooling_w_m2(air(-10.0), 0.01), 200.0);
    EXPECT_LT(icicle_cooling_w_m2(air(-10.0), 0.01), 800.0);
    WeatherMoment gale = air(-5.0);
    gale.wind_m_s = {15.0f, 0.0f};
    EXPECT_GT(icicle_cooling_w_m2(gale, 0.01), 1.5 * icicle_cooling_w_m2(air(-5.0), 0.01));
    EXPECT_GT(icicle_cooling_w_m2(air(-5.0), 0.004), icicle_cooling_w_m2(air(-5.0), 0.02)) << "thin ones freeze faster";
}

TEST(IcicleGrowth, TakesNoMoreWaterThanThereIsAndMeltsAboveZero)
{
    for (const double celsius : {-20.0, -5.0, -1.0, 0.5, 5.0}) {
        double ice = 0.02;
        for (int i = 0; i < 20; ++i) {
            const double after = icicle_after(ice, 1e-4, air(celsius), 600.0);
            EXPECT_GE(after, 0.0);
            EXPECT_LE(after, ice + 1e-4 + 1e-15);
            if (celsius > 0.0) {
                EXPECT_LE(after, ice);
            } else {
                EXPECT_GE(after, ice);
            }
            ice = after;
        }
    }
    EXPECT_EQ(icicle_after(0.03, 0.0, air(-5.0), 3600.0), 0.03);
    // Some millimetres of radius an hour in a warm wind.
    EXPECT_LT(icicle_after(0.03, 0.0, air(8.0), 3600.0), 0.024);
}

TEST(IcicleHistory, ThingsOnATableHaveNone)
{
    EXPECT_FALSE(carries_icicles(0.7f));
    EXPECT_TRUE(carries_icicles(2.0f));
}

TEST(IcicleHistory, LengthGrowsWithTheWaterThatFroze)
{
    double before = 0.0;
    for (const double hours : {1.0, 3.0, 6.0, 12.0}) {
        const double length = longest(rain_then(3.0, -3.0, hours, -3.0).at(48.0));
        EXPECT_GT(length, before) << hours;
        before = length;
    }
    // Some centimetres an hour at -3 C: half a metre in half a day.
    EXPECT_GT(before, 0.25);
    EXPECT_LT(before, 1.0);
    const scene::IcicleLengths all = rain_then(3.0, -3.0, 6.0, -3.0).at(48.0);
    for (std::size_t c = 1; c < scene::kIcicleClasses; ++c) EXPECT_GE(all.length_m[c], all.length_m[c - 1]);
    EXPECT_LT(all.length_m.front(), 0.5f * all.length_m.back()) << "little water, little ice";
}

TEST(IcicleHistory, HoldsNoMoreIceThanHasDripped)
{
    for (const double rain : {0.3, 2.0, 20.0}) {
        for (const double celsius : {-1.0, -6.0, -15.0}) {
            const scene::IcicleLengths l = rain_then(rain, celsius, 8.0, celsius).at(48.0);
            for (std::size_t c = 0; c < scene::kIcicleClasses; ++c) {
                const double ice_kg = scene::kIcicleDensity_kg_m3 * scene::icicle_volume_m3(static_cast<double>(l.length_m[c]));
                // Between two moments of the grid rain ends by half a step; half a millimetre is what was on the roof.
                EXPECT_LE(ice_kg, (rain * (8.0 + 0.2) + 0.61) * scene::icicle_class_m2(c) * 1.0001 + 1e-12) << rain << " " << celsius << " " << c;
            }
        }
    }
}

TEST(IcicleHistory, NoneAboveZeroAndNoneInDryCold)
{
    EXPECT_EQ(longest(rain_then(5.0, 2.0, 24.0, 4.0).at(24.0)), 0.0);
    EXPECT_EQ(longest(rain_then(0.0, -10.0, 24.0, -10.0).at(40.0)), 0.0);
    EXPECT_FALSE(rain_then(5.0, 2.0, 24.0, 4.0).any(0.0, 48.0));
    EXPECT_FALSE(IcicleHistory().any(0.0, 10.0));
}

TEST(IcicleHistory, AThawTakesThem)
{
    const IcicleHistory thaw = rain_then(3.0, -3.0, 8.0, 6.0);
    const double there = longest(thaw.at(8.0));
    EXPECT_GT(there, 0.1);
    double before = there;
    for (const double hour : {9.0, 11.0, 14.0, 20.0}) {
        const double now = longest(thaw.at(hour));
        EXPECT_LE(now, before);
        before = now;
    }
    EXPECT_EQ(longest(thaw.at(48.0)), 0.0);
    EXPECT_TRUE(thaw.any(0.0, 48.0));
    EXPECT_FALSE(thaw.any(40.0, 48.0));
}

// The usual way: snow melts by day, and what is still on its way freezes in the evening.
TEST(IcicleHistory, AThawThatFreezesMakesThem)
{
    const auto weather = [](double melts_until) {
        return IcicleHistory(
            [=](double s) {
                WeatherMoment w = air(s < melts_until ? 4.0 : -6.0);
                w.swe_kg_m2 = static_cast<float>(60.0 - 2.0 * std::clamp(s, 0.0, melts_until));
                w.snow_liquid_fraction = s < melts_until ? 0.05f : 0.0f;
                return w;
            },
            {0.0, 24.0, 3600.0});
    };
    const IcicleHistory evening = weather(6.0);
    EXPECT_EQ(longest(evening.at(5.7)), 0.0);
    EXPECT_GT(longest(evening.at(12.0)), 0.03);
    EXPECT_LT(longest(evening.at(12.0)), 0.5);
    EXPECT_EQ(longest(weather(0.0).at(12.0)), 0.0) << "snow that does not melt makes none";
}

TEST(IcicleHistory, AnAnswerDependsOnTheTimeAlone)
{
    const IcicleHistory one = rain_then(2.0, -4.0, 10.0, -4.0), other = rain_then(2.0, -4.0, 10.0, -4.0);
    const scene::IcicleLengths alone = other.at(7.3);
    for (const double s : {40.0, 1.0, 9.9, 0.0}) one.at(s);
    EXPECT_EQ(one.at(7.3), alone);
    EXPECT_EQ(one.at(-5.0), scene::IcicleLengths{});
    EXPECT_EQ(one.at(1e9), one.at(48.0));
    // A year of hours is walked in a few thousand steps; and odd clocks are defined.
    const IcicleHistory year([](double s) { return air(-5.0, std::fmod(s, 100.0) < 2.0 ? 1.0 : 0.0); }, {0.0, 8760.0, 3600.0});
    EXPECT_LE(longest(year.at(8760.0)), static_cast<double>(scene::kLongestIcicle_m) + 1e-6);
    const IcicleHistory none([](double) { return air(-5.0, 1.0); }, {3.0, 3.0, 3600.0});
    EXPECT_EQ(longest(none.at(3.0)), 0.0);
}

}  // namespace
}  // namespace petrichor::film
