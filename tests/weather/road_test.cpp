// Roads: layers, bridges, the measured start, traffic, ploughs, friction, METRo's files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "weather/models/physical/observed_start.h"
#include "weather/physics/cloud_of_air.h"
#include "weather/physics/friction.h"
#include "weather/physics/humidity.h"
#include "weather/readers/metro_xml.h"
#include "weather/readers/read_weather.h"
#include "weather/readers/text.h"

namespace petrichor::weather {
namespace {

constexpr std::int64_t kHourUs = 3600000000LL;

ForcingTable steady(double air_k, double sw, double lw, double snow, int hours)
{
    ForcingTable t;
    for (int i = 0; i <= hours; ++i) {
        t.time_us.push_back(i * kHourUs);
        t[Field::AirTemp].push_back(air_k);
        t[Field::RelHumidity].push_back(70);
        t[Field::Wind].push_back(2);
        t[Field::Shortwave].push_back(sw);
        t[Field::Longwave].push_back(lw);
        t[Field::Precip].push_back(snow / 3600);
    }
    ReadReport report;
    fill_forcing(t, report);
    return t;
}

TEST(Road, UniformLayersAreTheGroundItself)
{
    const GroundLayer layer{0.37, 0.75, 1.94e6};
    const auto plain = make_ground_stack(0.75, 1.94e6, 600);
    const auto layered =
        make_ground_stack(make_ground_profile({{layer, layer}}, 0.75, 1.94e6, 0.0), 600);
    EXPECT_NEAR(layered.conductance_w_m2_k, plain.conductance_w_m2_k, 1e-9);
    for (std::size_t i = 0; i < kGroundLayers; ++i)
        EXPECT_NEAR(layered.weight_own[i], plain.weight_own[i], 1e-12) << i;
}

TEST(Road, ABridgeFollowsTheAir)
{
    PhysicalParams road, bridge;
    road.surface = surface_preset("road");
    bridge.surface = surface_preset("bridge");
    road.deep_temp_k = bridge.deep_temp_k = 283.15;
    const ForcingTable frost = steady(265.15, 0, 260, 0, 72);
    const double on_road = PhysicalTimeline(frost, road).state_at(72 * kHourUs).surface_temp_c;
    const double on_bridge = PhysicalTimeline(frost, bridge).state_at(72 * kHourUs).surface_temp_c;
    EXPECT_LT(on_bridge, on_road - 1.0);
    EXPECT_NEAR(on_bridge, -8.0, 3.0);
}

TEST(Road, TrafficWarmsItAndPloughsClearIt)
{
    PhysicalParams quiet, busy;
    quiet.surface = busy.surface = surface_preset("road");
    quiet.surface.traffic_heat_w_m2 = quiet.surface.snow_clearing_1_h = 0.0;
    const ForcingTable frost = steady(268.15, 0, 250, 0, 24);
    const double k = PhysicalTimeline(frost, busy).state_at(24 * kHourUs).surface_temp_c -
                     PhysicalTimeline(frost, quiet).state_at(24 * kHourUs).surface_temp_c;
    EXPECT_GT(k, 0.3);
    EXPECT_LT(k, 2.0);
    const ForcingTable storm = steady(266.15, 0, 280, 2.0, 12);
    const CellState deep = PhysicalTimeline(storm, quiet).state_at(12 * kHourUs);
    const CellState swept = PhysicalTimeline(storm, busy).state_at(12 * kHourUs);
    EXPECT_GT(diagnostics(deep).swe_kg_m2, 20);
    // Fall over clearing rate, 2 / 1.08, less what is cleared at the end of the hour it fell in.
    EXPECT_GT(diagnostics(swept).swe_kg_m2, 0.9);
    EXPECT_LT(diagnostics(swept).swe_kg_m2, 2.0 / 1.08);
    EXPECT_LE(std::abs(swept.mass_residual_most), 1e-9);
}

// Vehicles stir calm air as 1.5 m/s of wind by day do, and as 0.4 by night.
TEST(Road, TrafficStirsTheAir)
{
    PhysicalParams busy, still;
    busy.surface = still.surface = surface_preset("road");
    still.surface.traffic_wind_m_s = 0.0;
    for (const auto& [sun_w_m2, wind_m_s] : {std::pair{0.0, 0.4}, std::pair{300.0, 1.5}}) {
        ForcingTable calm = steady(278.15, sun_w_m2, 250, 0, 12), windy = calm;
        calm[Field::Wind].assign(calm.rows(), 0.1);
        windy[Field::Wind].assign(windy.rows(), wind_m_s);
        const auto end_c = [](const ForcingTable& t, const PhysicalParams& p) {
            return PhysicalTimeline(t, p).state_at(12 * kHourUs).surface_temp_c;
        };
        EXPECT_NEAR(end_c(calm, busy), end_c(windy, still), 1e-9) << sun_w_m2;
        EXPECT_GT(std::abs(end_c(calm, busy) - end_c(calm, still)), 0.05) << sun_w_m2;
    }
}

// Snow that melts as it falls takes its heat and nothing else: the road stays as coupled to the air
// as it is without it.
TEST(Road, ADustingThatMeltsLeavesAWarmRoad)
{
    PhysicalParams p;
    p.surface = surface_preset("road");
    p.deep_temp_k = 280.15;
    const ForcingTable dry = steady(274.15, 250, 280, 0, 6),
                       dusted = steady(274.15, 250, 280, 0.05, 6);
    const CellState a = PhysicalTimeline(dry, p).state_at(6 * kHourUs);
    const CellState b = PhysicalTimeline(dusted, p).state_at(6 * kHourUs);
    ASSERT_GT(a.surface_temp_c, 5.0);
    EXPECT_GT(a.flux_sensible, 25.0);
    EXPECT_NEAR(b.flux_sensible, a.flux_sensible, 0.25 * a.flux_sensible);
    EXPECT_LT(std::abs(b.surface_temp_c - a.surface_temp_c), 1.5);
}

// Water under snow freezes when the ground below is cold enough.
TEST(Road, WaterUnderSnowFreezesWithTheColdOfTheGround)
{
    PhysicalParams p;
    p.surface = surface_preset("road");
    p.surface.snow_clearing_1_h = p.surface.traffic_heat_w_m2 = 0;
    p.deep_temp_k = 265.15;
    ForcingTable t = steady(264.15, 0, 220, 1.0, 24);
    CellState c = PhysicalTimeline(t, p).state_at(3 * kHourUs);
    c.film = 0.5;
    const PhysicalTimeline run(t, p, c, 3 * kHourUs);
    const CellState later = run.state_at(24 * kHourUs);
    EXPECT_EQ(later.film, 0.0);
    EXPECT_NEAR(later.film_ice, c.film_ice + 0.5, 1e-9);
    EXPECT_LT(std::abs(later.mass_residual_most), 1e-9);
}

TEST(Road, TheMeasuredStartIsTakenAsItIs)
{
    PhysicalParams p;
    p.surface = surface_preset("road");
    const ForcingTable t = steady(268.15, 0, 250, 0, 24);
    const std::vector<std::int64_t> times{-2 * kHourUs, -kHourUs, 0};
    const std::vector<double> surface{5.0, 3.0, 31.5}, below{8.0, 8.0, 8.0};
    const CellState c = observed_start(t, p, {times, surface, below, 0.4});
    EXPECT_EQ(c.surface_temp_c, 31.5);
    EXPECT_GT(c.ground_temp_c[0], 5.0);
    EXPECT_NEAR(c.ground_temp_c[6], 8.0, 0.5);
    const std::vector<double> none{kMissing, kMissing, kMissing};
    EXPECT_THROW(observed_start(t, p, {times, none, below, 0.4}), Error);
}

// Of the wave of a day: it is conducted as the ground conducts, and the surface gives and takes
// what the sun drives it by.
TEST(Road, TheWaveOfADayIsThatOfTheSunOnAHalfSpace)
{
    const Surface road = surface_preset("road");
    const std::int64_t july = *us_from_iso("2006-07-12T00:00Z"),
                       december = *us_from_iso("2006-12-12T00:00Z");
    const DayWave w = day_wave(road, 40.0, july, 0.0);
    EXPECT_NEAR(w.damping_m, 0.102, 0.001);
    EXPECT_GT(w.warmest_s, 12.5 * 3600.0);
    EXPECT_LT(w.warmest_s, 14.0 * 3600.0);
    EXPECT_GT(w.amplitude_k, 10.0);
    EXPECT_LT(w.amplitude_k, 20.0);
    EXPECT_LT(day_wave(road, 40.0, december, 0.0).amplitude_k, 0.6 * w.amplitude_k);
    EXPECT_LT(day_wave(road, 40.0, july, 1.0).amplitude_k, 0.3 * w.amplitude_k);
    EXPECT_EQ(day_wave(road, 80.0, december, 0.0).amplitude_k, 0.0) << "night all day";
    const double k = road.layers[0].conductivity_w_m_k, c = road.layers[0].heat_capacity_j_m3_k;
    for (const double s : {3.0 * 3600.0, 12.0 * 3600.0, 19.0 * 3600.0}) {
        const double z = 0.05, dz = 1e-3, dt = 30.0;
        const double bend = (w.at(z + dz, s) - 2.0 * w.at(z, s) + w.at(z - dz, s)) / (dz * dz);
        const double rise = (w.at(z, s + dt) - w.at(z, s - dt)) / (2.0 * dt);
        EXPECT_NEAR(c * rise, k * bend, 0.01 * c * w.amplitude_k * 7.3e-5) << s;
    }
    // What goes down and back at noon is in phase with the sun: half a turn later the same goes the
    // other way.
    const auto driven = [&](double s) {
        return k * (w.at(0.0, s) - w.at(1e-4, s)) / 1e-4 + 20.0 * w.at(0.0, s);
    };
    EXPECT_NEAR(driven(0.5 * 86400.0), -driven(0.0), 0.5);
    EXPECT_NEAR(driven(0.25 * 86400.0), 0.0, 0.01 * driven(0.5 * 86400.0)) << "nothing at six";
}

// Where the sun has made the surface warm by noon, its warmth has not gone far down; a place
// without a longitude has METRo's line.
TEST(Road, TheFirstProfileHasTheWaveOfTheDay)
{
    PhysicalParams p;
    p.surface = surface_preset("road");
    ForcingTable t = steady(290.15, 0, 300, 0, 24);
    t.site.latitude_deg = 45.0;
    t.site.longitude_deg = 0.0;
    t[Field::Cloud].assign(t.rows(), 0.0);
    const std::int64_t noon = *us_from_iso("2006-07-12T13:00Z");
    const std::vector<std::int64_t> times{noon};
    const std::vector<double> surface{40.0}, below{25.0};
    const auto start = [&](FirstProfile first) {
        return observed_start(t, p, {times, surface, below, 0.4}, first);
    };
    const CellState line = start(FirstProfile::Line), wave = start(FirstProfile::DayAndLine);
    EXPECT_NEAR(line.ground_temp_c[3], 40.0 - 15.0 * 0.11 / 0.4, 0.01);  // 0.07 to 0.15 m
    EXPECT_LT(wave.ground_temp_c[3], line.ground_temp_c[3] - 3.0);
    EXPECT_EQ(wave.surface_temp_c, 40.0);
    t.site.longitude_deg = kMissing;
    EXPECT_EQ(start(FirstProfile::DayAndLine).ground_temp_c[3], line.ground_temp_c[3]);
}

// What METRo begins with (its subroutine MAKITP): surface and thermometer as measured, between them a
// line and a wave of 7.5 K with its crest at six; then both are held as measured.
TEST(Road, MetrosFirstProfileMeetsBothThermometers)
{
    PhysicalParams p;
    p.surface = surface_preset("road");
    p.surface.layers = {{1.0, 0.8, 2.1e6}};
    ForcingTable t = steady(290.15, 0, 300, 0, 24);
    t.site.latitude_deg = 45.0;
    t.site.longitude_deg = 0.0;
    const std::int64_t six = *us_from_iso("2006-07-12T06:00Z");
    const std::vector<double> surface{20.0, 20.0}, below{20.0, 26.0};
    const auto start = [&](std::int64_t us, std::size_t values) {
        const std::vector<std::int64_t> times{us, us + kHourUs};
        return observed_start(t, p,
                              {std::span(times).first(values), std::span(surface).first(values),
                               std::span(below).first(values), 0.47},
                              FirstProfile::Metro);
    };
    const CellState crest = start(six, 1), trough = start(six + 12 * kHourUs, 1);
    EXPECT_NEAR(crest.ground_temp_c[5], 20.0, 1e-9) << "0.47 m, the thermometer";
    const double turn_1_s = 2.0 * 3.14159265358979 / 86400.0, depth_m = 0.05,
                 damping_m = std::sqrt(0.8 / 2.1e6 / turn_1_s);
    const auto wave = [&](double z) { return 7.5 * std::exp(-z / damping_m) * std::cos(z / damping_m); };
    const double expected = wave(depth_m) - wave(0.47) - (wave(0.0) - wave(0.47)) * (1.0 - depth_m / 0.47);
    EXPECT_NEAR(crest.ground_temp_c[2], 20.0 + expected, 0.01) << "0.05 m";
    EXPECT_NEAR(trough.ground_temp_c[2], 20.0 - expected, 0.01);
    EXPECT_LT(expected, -3.0) << "colder below a crest";
    EXPECT_NEAR(start(six, 2).ground_temp_c[5], 26.0, 1e-9) << "held";
}

TEST(Friction, FallsWithWhatLiesThere)
{
    CellState c{};
    c.surface_temp_c = 5;
    EXPECT_NEAR(wheel_friction(c), 0.82, 1e-12);
    EXPECT_EQ(road_condition(c), RoadCondition::Dry);
    c.film = 1.0;
    EXPECT_NEAR(wheel_friction(c), 0.70, 0.01);
    EXPECT_EQ(road_condition(c), RoadCondition::Wet);
    c.film = 0.0;
    c.surface_temp_c = -5;
    double before = 1.0;
    for (const double ice : {0.0, 0.01, 0.05, 0.2, 1.0}) {
        c.film_ice = ice;
        EXPECT_LT(wheel_friction(c), before);
        before = wheel_friction(c);
    }
    EXPECT_NEAR(before, 0.20, 0.01);
    EXPECT_NEAR(glaze_mm(c), 1.0905, 1e-3);
    EXPECT_EQ(road_condition(c), RoadCondition::IceOrSnow);
    c.film = 0.5;
    EXPECT_LT(wheel_friction(c), 0.10);  // wet ice
    c.step_rain = 1.0;
    c.flux_melt = -20.0;
    EXPECT_EQ(road_condition(c), RoadCondition::IcingRain);
    c = {};
    c.snow_ice[0] = 5.0;
    EXPECT_NEAR(wheel_friction(c), 0.25, 0.01);
}

// Each pure state lies in its interval of Wallman & Astrom 2001.
TEST(Friction, PureStatesLieInTheirPublishedIntervals)
{
    const auto within = [](const CellState& c, double low, double high) {
        EXPECT_GE(wheel_friction(c), low - 1e-3);
        EXPECT_LE(wheel_friction(c), high);
    };
    CellState c{};
    within(c, 0.8, 1.0);
    c.film = 2;
    within(c, 0.7, 0.8);
    c = {};
    c.film_ice = 1;
    within(c, 0.15, 0.30);
    c.film = 2;
    within(c, 0.05, 0.10);
    c = {};
    c.snow_ice[0] = 10;
    within(c, 0.20, 0.30);
    c.snow_liquid[0] = 6;
    within(c, 0.20, 0.50);
}

TEST(Friction, BlackIceIsIceThatIsNotSeen)
{
    CellState c{};
    c.surface_temp_c = -1;
    EXPECT_FALSE(black_ice(c));
    c.film_ice = 0.05;
    EXPECT_TRUE(black_ice(c));
    EXPECT_EQ(road_condition(c), RoadCondition::Dry);  // of METRo, below 0.2 mm
    EXPECT_LT(wheel_friction(c), 0.45);
    c.snow_ice[0] = 1;
    EXPECT_FALSE(black_ice(c));
}

constexpr const char* kStation =
    "<?xml version=\"1.0\"?><station><header><road-station>x</road-station><coordinate>"
    "<latitude>46.2</latitude><longitude>-60.28</longitude></coordinate>"
    "<station-type>bridge</station-type></header><roadlayer-list><roadlayer><position>1</position>"
    "<type>Crushed Rock</type><thickness>0.2</thickness></roadlayer></roadlayer-list></station>";

TEST(Metro, StationForecastAndWhatIsWrong)
{
    const MetroStation s = read_metro_station(kStation);
    EXPECT_TRUE(s.bridge);
    ASSERT_EQ(s.layers.size(), 1u);
    EXPECT_EQ(s.layers[0].conductivity_w_m_k, 0.95);
    EXPECT_EQ(s.site.latitude_deg, 46.2);
    std::string lava = kStation;
    lava.replace(lava.find("Crushed Rock"), 12, "lava");
    try {
        read_metro_station(lava);
        FAIL();
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("lava"), std::string::npos);
    }
    const std::string forecast =
        "<forecast><prediction-list>"
        "<prediction><forecast-time>2004-01-30T12:00Z</forecast-time><at>-11</at><td>-14</td>"
        "<ws>36</ws><ap>984</ap><cc>4</cc><ra>0</ra><sn>0</sn></prediction>"
        "<prediction><forecast-time>2004-01-30T13:00Z</forecast-time><at>9999</at><td>-14</td>"
        "<ws>18</ws><ap>984</ap><cc>8</cc><ra>1.5</ra><sn>2</sn></prediction>"
        "</prediction-list></forecast>";
    const ForcingTable t = read_metro_forecast(forecast);
    ASSERT_EQ(t.rows(), 2u);
    EXPECT_NEAR(t[Field::Wind][0], 10.0, 1e-12);
    EXPECT_EQ(t[Field::Cloud][0], 0.5);
    EXPECT_TRUE(std::isnan(t[Field::AirTemp][1]));
    EXPECT_NEAR(t[Field::Rain][0] * 3600, 1.5, 1e-12);
    EXPECT_NEAR(t[Field::Snow][0] * 3600, 2.0, 1e-12);
    EXPECT_THROW(read_metro_forecast("<forecast></forecast>"), Error);
    EXPECT_THROW(read_metro_forecast(forecast.substr(0, 120)), Error);
    EXPECT_THROW(read_metro_station("<forecast>"), Error);
    EXPECT_THROW(read_metro_observation(kStation), Error);
}

// As some programs write them: attributes, empty elements, a byte order mark.
TEST(Metro, AttributesAndEmptyElementsAreXml)
{
    const ForcingTable t = read_metro_forecast(
        "\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<forecast>\n<prediction-list>\n"
        "<prediction id=\"1\"><forecast-time viewed=\"no\">2007-11-08T06:00Z</forecast-time>"
        "<at "
        ">4</at><atx>9</atx><td/><ws>36</ws><ap>910</ap><cc>6</cc><ra>0</ra><sn>0</sn></prediction>"
        "<prediction><forecast-time viewed=\"no\">2007-11-08T07:00Z</forecast-time>"
        "<at>3</at><td />\n<ws>18</ws><ap>910</ap><cc>4</cc><ra>1</ra><sn>0</sn></prediction>"
        "</prediction-list></forecast>");
    ASSERT_EQ(t.rows(), 2u);
    EXPECT_NEAR(t[Field::AirTemp][0], 277.15, 1e-9);
    EXPECT_NEAR(t[Field::AirTemp][1], 276.15, 1e-9);
    EXPECT_TRUE(std::isnan(t[Field::DewPoint][0]));
    EXPECT_NEAR(t[Field::Wind][0], 10.0, 1e-9);
    EXPECT_EQ(t[Field::Cloud][1], 0.5);
    EXPECT_THROW(read_metro_forecast("<forecast><prediction id=\"1\""), Error);
}

// What a station measured, as weather: its road is an observation to compare with.
TEST(Metro, TheMeasuredRoadOfAnObservationIsSeen)
{
    const auto r = read_weather(
        "<observation><measure-list>"
        "<measure><observation-time>2004-01-30T00:00Z</observation-time><at>-5</at><td>-6</td>"
        "<ws>18</ws><st>-3</st><sst>-1</sst></measure>"
        "<measure><observation-time>2004-01-30T01:00Z</observation-time><at>-5</at><td>-6</td>"
        "<ws>18</ws><st>9999</st><sst>-1</sst></measure></measure-list></observation>");
    ASSERT_TRUE(r.table.has(Field::SurfaceTemp));
    EXPECT_NEAR(r.table[Field::SurfaceTemp][0], 270.15, 1e-9);
    EXPECT_TRUE(std::isnan(r.table[Field::SurfaceTemp][1]));
}

// Clouds before a forecast are those of its beginning, fading; under what falls they are full.
// A sensor that says 0.00 for a while between values that agree has said nothing; a road that comes to 0, that
// is near it, or that stays there has.
TEST(Metro, ALoneZeroBetweenValuesThatAgreeIsMissing)
{
    const auto read = [](const std::vector<double>& st) {
        std::string text = "<observation><measure-list>";
        for (std::size_t i = 0; i < st.size(); ++i) {
            char row[200];
            std::snprintf(row, sizeof row,
                          "<measure><observation-time>2009-02-04T%02zu:%02zuZ</observation-time><at>2</at>"
                          "<td>0</td><ws>3</ws><st>%g</st><sst>0</sst></measure>",
                          i / 4, i % 4 * 15, st[i]);
            text += row;
        }
        return read_metro_observation(text + "</measure-list></observation>");
    };
    const MetroObservation lone = read({1.55, 0, 1.5, 1.4, 0, 0, 1.5});
    EXPECT_EQ(lone.fallen_to_zero, 3u);
    for (const std::size_t i : {1u, 4u, 5u}) EXPECT_TRUE(std::isnan(lone.surface_c[i])) << i;
    EXPECT_EQ(lone.surface_c[2], 1.5);
    for (const double c : lone.subsurface_c) EXPECT_EQ(c, 0.0) << "a column of zeros is another matter";
    const std::vector<std::vector<double>> believed{{0.5, 0, 0.5}, {1.5, 0, -0.8}, {1.5, 0}, {0, 1.5},
                                                    {2, 0, 0, 0, 0, 2}};
    for (const auto& st : believed) {
        const MetroObservation kept = read(st);
        EXPECT_EQ(kept.fallen_to_zero, 0u);
        EXPECT_EQ(kept.surface_c, st);
    }
}

TEST(Metro, WeatherOfTheMeasuredHours)
{
    const auto measure = [](int hour, const char* pi) {
        return "<measure><observation-time>2004-01-30T0" + std::to_string(hour) +
               ":00Z</observation-time><at>-5</at><td>-6</td><ws>18</ws><st>-3</st><sst>-1</"
               "sst><pi>" +
               pi + "</pi></measure>";
    };
    const MetroObservation o = read_metro_observation(
        "<observation><measure-list>" + measure(0, "0") + measure(1, "1") + measure(2, "0") +
        measure(3, "9999") + "</measure-list></observation>");
    ASSERT_EQ(o.falling.size(), 4u);
    EXPECT_EQ(o.falling[0], 0.0);
    EXPECT_EQ(o.falling[1], 1.0);
    EXPECT_TRUE(std::isnan(o.falling[3]));
    ForcingTable forecast;
    for (const int hour : {2, 3, 4, 5}) {
        forecast.time_us.push_back(o.table.time_us[0] + hour * kHourUs);
        forecast[Field::AirTemp].push_back(270.15);
        forecast[Field::Cloud].push_back(0.1);
    }
    const ForcingTable t = observed_weather(o, forecast);
    ASSERT_EQ(t.rows(), 6u);  // and two of the forecast
    // At -5 C with a dew point of -6 the air says more than half a cover.
    const double humidity = rel_humidity_of_dew_point_pct(268.15, 267.15);
    const double air = cloud_of_day({.mean_rel_humidity_pct = humidity});
    EXPECT_GT(air, 0.9);
    const double worth = kForecastCloudWorth * std::exp(-2.0 / kForecastCloudMemory_h);
    const double before = air - worth * (air - 0.1);
    EXPECT_NEAR(t[Field::Cloud][0], before, 1e-12);
    EXPECT_EQ(t[Field::Cloud][1], 1.0);
    EXPECT_NEAR(t[Field::Cloud][2], 0.1 + 0.9 * std::exp(-1.0 / kRainCloudMemory_h), 1e-12);
    EXPECT_EQ(t[Field::Cloud][5], 0.1);
    EXPECT_EQ(t[Field::AirTemp][0], 268.15);
    EXPECT_EQ(t[Field::AirTemp][5], 270.15);
    EXPECT_TRUE(std::isnan(t[Field::DewPoint][4]));
    EXPECT_FALSE(t.has(Field::Pressure));
    // No station measures pressure: the forecast's, on a mountain too.
    ForcingTable high = forecast;
    high[Field::Pressure] = {82400.0, 82600.0, 82600.0, 82600.0};
    const ForcingTable thin = observed_weather(o, high);
    EXPECT_EQ(thin[Field::Pressure][0], 82400.0);
    EXPECT_EQ(thin[Field::Pressure][2], 82400.0);
    EXPECT_EQ(thin[Field::Pressure][5], 82600.0);
    // Nothing forecast: what the air tells; without its humidity half a cover.
    ForcingTable silent = forecast;
    silent[Field::Cloud].clear();
    EXPECT_NEAR(observed_weather(o, silent)[Field::Cloud][0], air, 1e-12);
    MetroObservation dry = o;
    dry.table[Field::DewPoint].assign(o.table.rows(), kMissing);
    EXPECT_EQ(observed_weather(dry, silent)[Field::Cloud][0], 0.5);
    // A row that lacks its dew point, or its air, says nothing of the day's humidity.
    MetroObservation gaps = o;
    gaps.table[Field::DewPoint][1] = kMissing;
    gaps.table[Field::AirTemp][2] = kMissing;
    EXPECT_NEAR(observed_weather(gaps, silent)[Field::Cloud][0], air, 1e-12);
}

// A forecast begins with the mean of its first three hours, and one that snows out of a clear sky
// has left its clouds out.
TEST(Metro, CloudsWithWhichAForecastBegins)
{
    const auto measure = [](const char* minute) {
        return std::string("<measure><observation-time>2004-01-30T03:") + minute +
               "Z</observation-time><at>-5</at><td>-6</td><ws>18</ws><st>-3</st><sst>-1</sst>"
               "</measure>";
    };
    const MetroObservation o =
        read_metro_observation("<observation><measure-list>" + measure("50") + measure("59") +
                               "</measure-list></observation>");
    const auto forecast_of = [](const std::vector<double>& cc, double snow_cm_h) {
        std::string text = "<forecast><prediction-list>";
        for (std::size_t i = 0; i < cc.size(); ++i)
            text += "<prediction><forecast-time>2004-01-30T0" + std::to_string(4 + i) +
                    ":00Z</forecast-time><at>-5</at><td>-6</td><ws>9</ws><ra>0</ra><sn>" +
                    std::to_string(snow_cm_h * static_cast<double>(i)) + "</sn><cc>" +
                    std::to_string(cc[i]) + "</cc></prediction>";
        return text + "</prediction-list></forecast>";
    };
    const auto before = [&](const std::string& text) {
        return observed_weather(o, read_metro_forecast(text))[Field::Cloud][1];
    };
    const double last = kForecastCloudWorth * std::exp(-1.0 / 60.0 / kForecastCloudMemory_h),
                 air = 1.0 - last;
    const double humidity = rel_humidity_of_dew_point_pct(268.15, 267.15);
    const double of_air = cloud_of_day({.mean_rel_humidity_pct = humidity});
    EXPECT_NEAR(before(forecast_of({0, 4, 8, 1, 1}, 0.0)), 0.5 * last + of_air * air, 1e-9);
    EXPECT_NEAR(before(forecast_of({0, 0, 0, 0, 0}, 0.05)), of_air * air, 1e-9);
    EXPECT_NEAR(before(forecast_of({0, 0, 0, 0, 0}, 0.2)), last + of_air * air, 1e-9);
    // As weather of its own: told, and overcast until the last row, of which nothing is known.
    const ReadResult read = read_weather(forecast_of({0, 0, 2, 0, 0}, 0.2));
    const auto& cloud = read.table[Field::Cloud];
    ASSERT_EQ(cloud.size(), 5u);
    EXPECT_EQ(cloud[0], 1.0);
    EXPECT_EQ(cloud[2], 0.25);
    EXPECT_EQ(cloud[3], 1.0);
    EXPECT_EQ(cloud[4], 0.0);
    EXPECT_NE(to_text(read.report).find("out of a clear sky in 3 rows"), std::string::npos);
}

// Rain of measured hours: the station's word, where its air can be that of rain, before the
// forecast's.
TEST(Metro, RainOfTheMeasuredHours)
{
    constexpr double kMm_h = 1.0 / 3600.0;
    struct Row {
        const char *air, *dew, *pi;
        double forecast_mm_h, rain_mm_h;
    };
    constexpr Row kRows[] = {{"9", "8.5", "1", 0.0, 1.0},  {"9", "8.5", "1", 3.0, 3.0},
                             {"9", "6", "1", 0.0, 0.0},    {"1", "0.9", "1", 0.0, 0.0},
                             {"9", "8.5", "0", 3.0, 0.0},  {"9", "8.5", "9999", 0.5, 0.5},
                             {"9", "9999", "1", 0.5, 0.5}, {"9", "8.5", "9999", 0.0, 0.0}};
    std::string text = "<observation><measure-list>";
    int hour = 0;
    for (const Row& row : kRows)
        text += "<measure><observation-time>2004-01-30T0" + std::to_string(hour++) +
                ":00Z</observation-time><at>" + row.air + "</at><td>" + row.dew +
                "</td><ws>18</ws><st>3</st><sst>3</sst><pi>" + row.pi + "</pi></measure>";
    const MetroObservation o = read_metro_observation(text + "</measure-list></observation>");
    ForcingTable forecast;
    for (int i = 0; i < 10; ++i) {
        forecast.time_us.push_back(o.table.time_us[0] + i * kHourUs);
        forecast[Field::AirTemp].push_back(282.15);
        forecast[Field::Rain].push_back((i < 8 ? kRows[i].forecast_mm_h : 2.0) * kMm_h);
        forecast[Field::Snow].push_back(kMm_h);
    }
    ForcingTable t = observed_weather(o, forecast);
    ASSERT_EQ(t.rows(), 10u);
    for (std::size_t i = 0; i < 8; ++i)
        EXPECT_NEAR(t[Field::Rain][i] / kMm_h, kRows[i].rain_mm_h, 1e-12) << i;
    EXPECT_NEAR(t[Field::Rain][9] / kMm_h, 2.0, 1e-12);
    EXPECT_EQ(*std::max_element(t[Field::Snow].begin(), t[Field::Snow].end()), 0.0);
    // Hours before the forecast know none of its rain.
    for (std::int64_t& us : forecast.time_us) us += 6 * kHourUs;
    t = observed_weather(o, forecast);
    EXPECT_NEAR(t[Field::Rain][1] / kMm_h, 1.0, 1e-12);
    EXPECT_EQ(t[Field::Rain][5], 0.0);
}

}  // namespace
}  // namespace petrichor::weather
