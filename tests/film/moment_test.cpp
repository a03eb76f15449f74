#include "weather/moment.h"

#include <gtest/gtest.h>

#include "film/scenario/weather_script.h"

namespace petrichor::film {
namespace {

using weather::cloud_cover_at;
using weather::frost_at;
using weather::Moment;
using weather::wind_vector_m_s;

Moment moment_of(const WeatherScript& script, const weather::ArtistTimeline& solved, double time_s)
{
    return weather::artist_moment(solved, script.timeline, script.sky, time_s);
}

WeatherScript script_of(const std::string& keys)
{
    return read_weather_script("[weather]\nkeys = [" + keys + "]\n", "w.toml");
}

TEST(WeatherMoment, PublishesTheStateOfTheModel)
{
    const WeatherScript script = script_of(
        "{ time_s = 0, temperature_c = 10, rainfall = 0.8 }, { time_s = 20, temperature_c = -10 }");
    const auto weather = script.solve();
    for (const double time_s : {0.0, 3.0, 12.0, 19.0}) {
        const auto time = weather::to_time_us(time_s);
        const auto state = weather.state_at(time);
        const auto published = weather.outputs_at(time);
        const Moment moment = moment_of(script, weather, time_s);
        EXPECT_FLOAT_EQ(moment.values.rain, static_cast<float>(state.rain));
        EXPECT_FLOAT_EQ(moment.values.flood_puddles, static_cast<float>(published.flood_puddles));
        EXPECT_FLOAT_EQ(moment.values.snow_amount,
                        static_cast<float>(state.snow * state.water_to_snow));
        EXPECT_FLOAT_EQ(moment.values.water_to_snow, static_cast<float>(state.water_to_snow));
        EXPECT_FLOAT_EQ(moment.values.air_temperature_k,
                        static_cast<float>(published.temperature_c + 273.15));
    }
    EXPECT_FLOAT_EQ(moment_of(script, weather, 1.0).values.snow_height_blend_m, 10.0f);
}

// Rain of 9 C is no snow because states are set by hand.
TEST(WeatherMoment, WhatFallsWhileStatesAreSetByHandFallsOnce)
{
    struct Case {
        const char* keys;
        float rain, snowfall;
    };
    for (const Case& c : {Case{"temperature_c = 9, rainfall = 0.8", 0.8f, 0.0f}, Case{"temperature_c = 9, rainfall = 0.8, water_to_snow = 1", 0.8f, 0.0f},
                          Case{"temperature_c = 2, rainfall = 0.8, water_to_snow = 1", 0.4f, 0.4f},
                          Case{"temperature_c = -2, rainfall = 0.8, water_to_snow = 1", 0.0f, 0.8f}, Case{"temperature_c = -2, rainfall = 0.8, water_to_snow = 0", 0.8f, 0.0f}}) {
        const WeatherScript script = script_of(std::string("{ time_s = 0, script_controlled = 0, ") + c.keys + " }");
        const auto m = moment_of(script, script.solve(), 1.0).values;
        EXPECT_FLOAT_EQ(m.rain, c.rain) << c.keys;
        EXPECT_FLOAT_EQ(m.snowfall, c.snowfall) << c.keys;
        EXPECT_NEAR(m.snow_fraction, c.snowfall / 0.8f, 1e-6f) << c.keys;
        EXPECT_NEAR(m.visibility_m, weather::visibility_in_m(static_cast<double>(c.rain), static_cast<double>(c.snowfall)), 1.0) << c.keys;
    }
}

TEST(Frost, GrowsInDryColdAndGoesInWarmth)
{
    const WeatherScript dry = script_of(
        "{ time_s = 0, temperature_c = 5, rainfall = 0 }, { time_s = 10, temperature_c = 5 },"
        "{ time_s = 11, temperature_c = -10 }, { time_s = 30, temperature_c = -10 }, { time_s = "
        "31, temperature_c = 8 }");
    EXPECT_EQ(frost_at(dry.timeline, 10.0, 1.0), 0.0);
    double before = 0.0;
    for (double t = 11.0; t <= 30.0; t += 0.5) {
        const double frost = frost_at(dry.timeline, t, 1.0);
        EXPECT_GE(frost, before);
        before = frost;
    }
    EXPECT_DOUBLE_EQ(before, 1.0);
    EXPECT_EQ(frost_at(dry.timeline, 45.0, 1.0), 0.0);
    const WeatherScript snowing = script_of(
        "{ time_s = 0, temperature_c = -10, rainfall = 0.5 }, { time_s = 30, temperature_c = -10 "
        "}");
    EXPECT_EQ(frost_at(snowing.timeline, 30.0, 1.0), 0.0);
}

TEST(CloudCover, ComesBeforeTheRainAndFollowsKeysWhenThereAreSome)
{
    const std::string keys =
        "{ time_s = 0, temperature_c = 10, rainfall = 0 }, { time_s = 20, rainfall = 0 },"
        "{ time_s = 21, rainfall = 1 }, { time_s = 40, rainfall = 1 }";
    const WeatherScript script = script_of(keys);
    EXPECT_NEAR(cloud_cover_at(script.timeline, 5.0), 0.12, 1e-9);
    EXPECT_GT(cloud_cover_at(script.timeline, 19.5), 0.2);
    EXPECT_NEAR(cloud_cover_at(script.timeline, 30.0), 0.95, 1e-9);
    const WeatherScript keyed =
        script_of(keys + ", { time_s = 41, cloud_cover = 0.5, visibility_m = 900 }");
    const auto weather = keyed.solve();
    EXPECT_FLOAT_EQ(moment_of(keyed, weather, 30.0).values.cloud_fraction, 0.5f);
    EXPECT_FLOAT_EQ(moment_of(keyed, weather, 30.0).values.visibility_m, 900.0f);
}

TEST(Visibility, ShrinksWithWhatFalls)
{
    EXPECT_DOUBLE_EQ(weather::visibility_in_m(0.0, 0.0), 20000.0);
    EXPECT_NEAR(weather::visibility_in_m(1.0, 0.0), 3000.0, 100.0);
    EXPECT_NEAR(weather::visibility_in_m(0.0, 1.0), 600.0, 20.0);
    EXPECT_LT(weather::visibility_in_m(0.5, 0.5), weather::visibility_in_m(0.0, 0.5));
}

TEST(WindVector, BlowsAwayFromWhereItComes)
{
    EXPECT_NEAR(wind_vector_m_s(3.0, 0.0).y, 3.0f, 1e-6f);    // from the north, towards +z
    EXPECT_NEAR(wind_vector_m_s(3.0, 90.0).x, -3.0f, 1e-6f);  // from the east, towards -x
}

}  // namespace
}  // namespace petrichor::film
