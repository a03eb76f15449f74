// Water of the artist model that freezes where it stands: it stays as ice, and comes back.
#include <gtest/gtest.h>

#include <utility>

#include "film/weather/artist_ice.h"

namespace petrichor::film {
namespace {

using weather::ArtistState;
using weather::ArtistTimeline;

// A wet day, a frost from 4 s on, a thaw from 20 s on; nothing falls.
ArtistTimeline frost_and_thaw(double rainfall = 0.0)
{
    weather::Timeline script;
    for (const auto& [time_s, celsius] : {std::pair{0.0, 3.0}, {4.0, -1.0}, {8.0, -12.0},
                                          {20.0, -12.0}, {21.0, 8.0}, {40.0, 8.0}}) {
        script.temperature_c.times.push_back(weather::to_time_us(time_s));
        script.temperature_c.values.push_back(celsius);
    }
    script.temperature_c.interpolation = weather::Interpolation::Linear;
    script.rainfall = weather::constant_channel(rainfall);
    ArtistState wet;
    wet.water_to_snow = 0.0;
    wet.wetness = 0.8;
    wet.cracks = 0.7;
    wet.puddles = 0.5;
    weather::ArtistParams params;
    params.evaporation_rate_puddles = 0.0;
    params.evaporation_rate_cracks = 0.0;
    return {script, params, wet};
}

TEST(ArtistIce, PuddlesFreezeWhereTheyStandAndTheThawGivesThemBack)
{
    const ArtistTimeline weather = frost_and_thaw();
    const ArtistIceTimeline ice(weather);
    EXPECT_EQ(ice.at(0.0).puddles, 0.0);
    for (double t = 0.0; t <= 40.0; t += 0.37) {
        const ArtistState s = weather.state_at(weather::to_time_us(t));
        EXPECT_NEAR(s.puddles + ice.at(t).puddles, 0.5, 0.01) << t;
        EXPECT_NEAR(s.cracks + ice.at(t).cracks, 0.7, 0.01) << t;
    }
    EXPECT_LT(weather.state_at(weather::to_time_us(15.0)).puddles, 0.01) << "the model's are gone";
}

TEST(ArtistIce, FrozenWaterIsNoSnow)
{
    const ArtistTimeline weather = frost_and_thaw();
    const ArtistIceTimeline ice(weather);
    for (double t = 0.0; t <= 40.0; t += 0.37) {
        const double snow = weather.state_at(weather::to_time_us(t)).snow;
        EXPECT_NEAR(snow - ice.at(t).not_snow, 0.0, 0.02) << t;
    }
    EXPECT_GT(weather.state_at(weather::to_time_us(15.0)).snow, 0.1) << "the model's own";
}

TEST(ArtistIce, WhatIsWetAndWhatRainsInTheColdIsGlazed)
{
    const ArtistIceTimeline wet(frost_and_thaw());
    EXPECT_EQ(wet.glaze_mm(2.5), 0.0) << "water is no ice";
    EXPECT_GT(wet.glaze_mm(15.0), 0.1);
    EXPECT_LT(wet.glaze_mm(40.0), 0.02) << "a thaw takes it";
    // Rain that falls on what is cold already makes it thicker.
    const ArtistIceTimeline rained(frost_and_thaw(0.3));
    EXPECT_GT(rained.glaze_mm(15.0), 1.2 * wet.glaze_mm(15.0));
}

// Where no patch says more, the frame's film is that ice.
TEST(ArtistIce, GlazeIsTheFilmOfItsMoment)
{
    const ArtistIceTimeline ice(frost_and_thaw());
    shared::WeatherMoment frozen;
    frozen.water_to_snow = 1.0f;
    const shared::WeatherMoment glazed = with_ice(frozen, ice.at(15.0));
    EXPECT_NEAR(glazed.film_albedo, 0.85 * ice.at(15.0).film, 1e-6);
    EXPECT_NEAR(glazed.film_smoothness, 0.5 * ice.at(15.0).film, 1e-6);
    EXPECT_GT(glazed.film_smoothness, 0.1f);
    EXPECT_EQ(with_ice(frozen, ice.at(2.5)).film_smoothness, 0.0f) << "nothing has frozen yet";
    // Water over ice is as thick as it is.
    frozen.film_smoothness = 0.49f;
    EXPECT_EQ(with_ice(frozen, ice.at(15.0)).film_smoothness, 0.49f);
}

TEST(ArtistIce, SnowThatFallsStays)
{
    const ArtistTimeline weather = frost_and_thaw(0.2);
    const ArtistIceTimeline ice(weather);
    const double snow = weather.state_at(weather::to_time_us(19.0)).snow;
    // 0.2 of 0.1 a second for some ten seconds.
    EXPECT_NEAR(snow - ice.at(19.0).not_snow, 0.24, 0.08);
}

}  // namespace
}  // namespace petrichor::film
