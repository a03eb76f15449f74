// Taps of a scenario on the ground of a scene.
#include "film/weather/tap_sites.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "base/error.h"
#include "film/jobs/scene_places.h"
#include "film/scenario/scenario.h"
#include "film/weather/artist_places.h"
#include "film/weather/hollows.h"
#include "film/weather/patch_weather.h"
#include "scene/basins/water.h"
#include "tests/film/rain_table.h"

namespace petrichor::film {
namespace {

void add_quad(scene::Scene& scene, const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v)
{
    scene::Primitive p;
    const glm::vec3 normal = glm::normalize(glm::cross(u, v));
    for (const glm::vec2 at :
         {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
        p.positions.push_back(corner + u * at.x + v * at.y);
        p.normals.push_back(normal);
        p.uv0.push_back(at);
    }
    p.indices = {0, 1, 2, 0, 2, 3};
    p.material = 0;
    scene.meshes.front().primitives.push_back(std::move(p));
}

// A street of 12 x 8 m that falls from x = -6 to x = 2, and beyond it rises as far: a trough along z,
// closed by walls of ground at both ends.
scene::Scene valley()
{
    scene::Scene scene;
    scene::Material m;
    m.name = "asphalt";
    m.base_color = glm::vec4(0.2f, 0.2f, 0.2f, 1.0f);
    m.metallic = 0.0f;
    scene.materials.push_back(m);
    scene.meshes.emplace_back();
    scene.instances.push_back({"valley", 0, glm::mat4(1.0f)});
    add_quad(scene, {-6, 0.4f, 4}, {8, -0.4f, 0}, {0, 0, -8});
    add_quad(scene, {2, 0, 4}, {4, 0.4f, 0}, {0, 0, -8});
    add_quad(scene, {-6, 0.4f, 5}, {12, 0, 0}, {0, 0, -1});
    add_quad(scene, {-6, 0.4f, -4}, {12, 0, 0}, {0, 0, -1});
    return scene;
}

struct Valley {
    scene::Scene scene;
    scene::Triangles triangles{scene, {}};
    scene::Tracer tracer{triangles};
    scene::Patches patches;
    std::vector<scene::PatchSurface> surfaces;

    explicit Valley(scene::Scene ground = valley()) : scene(std::move(ground))
    {
        scene::PatchOptions options;
        options.cell_m = 0.5f;
        options.rays = 64;
        patches = scene::build_patches(tracer, options);
        surfaces = scene::patch_surfaces(patches, triangles, {});
    }
    SceneSites sites(const std::vector<ScenarioTap>& taps) const
    {
        ScenarioGround keys;
        keys.taps = taps;
        return scene_sites(scene, patches, tracer, surfaces, keys,
                           weather::surface_preset("asphalt"));
    }
};

ScenarioTap tap_at(double x_m, double z_m, double litres_per_min = 12.0)
{
    ScenarioTap tap;
    tap.x_z_m = {x_m, z_m};
    tap.litres_per_min = litres_per_min;
    return tap;
}

TEST(TapSites, WaterRunsStraightDownToTheHollow)
{
    const Valley place;
    const SceneSites sites = place.sites({tap_at(-3.3, 1.2)});
    ASSERT_EQ(sites.taps.size(), 1u);
    EXPECT_NEAR(sites.taps[0].tap.flow_kg_s, 0.2, 1e-12);
    ASSERT_FALSE(sites.taps[0].tap.stretches.empty());
    const weather::TapStretch& tap = sites.taps[0].tap.stretches[0];
    ASSERT_NE(tap.runs_to, weather::kRunsOut);
    ASSERT_NE(tap.runs_to & weather::kToPond, 0u);
    // Five metres in patches of about one, from the tap to the bottom of the trough, each lower.
    EXPECT_GE(tap.way.size(), 5u);
    EXPECT_LE(tap.way.size(), 12u);
    EXPECT_NEAR(place.patches.position_m[tap.way.front()].x, -3.3f, 0.8f);
    EXPECT_NEAR(place.patches.position_m[tap.way.back()].x, 2.0f, 0.8f);
    for (std::size_t i = 0; i < tap.way.size(); ++i) {
        const glm::vec3 at = place.patches.position_m[tap.way[i]];
        EXPECT_NEAR(at.z, 1.2f, 0.6f) << i;
        EXPECT_GT(at.x, -4.0f);
        EXPECT_LT(at.x, 2.6f);
        if (i > 0) {
            EXPECT_LE(at.y, place.patches.position_m[tap.way[i - 1]].y + 0.03f) << i;
        }
    }
    const std::set<std::uint32_t> once(tap.way.begin(), tap.way.end());
    EXPECT_EQ(once.size(), tap.way.size());
}

TEST(TapSites, WaterFindsItsWayOverLevelGround)
{
    // Steps down to the right: 3 3 3 2 2 1 between solid rims, two cells high.
    SceneGround ground;
    ground.field.width = 8;
    ground.field.depth = 4;
    const float inf = scene::kSolid_m;
    ground.field.height_m = {inf, inf, inf, inf, inf, inf, inf, inf,  //
                             inf, 3,   3,   3,   2,   2,   1,   inf,  //
                             inf, 3,   3,   3,   2,   2,   2,   inf,  //
                             inf, inf, inf, inf, inf, inf, inf, inf};
    ground.basins = scene::find_basins(ground.field);
    const auto way =
        way_of_water(ground, ground.field.height_m, ground.field.cell_of(1, 2), true);
    ASSERT_EQ(way.size(), 6u);
    EXPECT_EQ(way.back(), ground.field.cell_of(6, 1));
    for (std::size_t i = 1; i < way.size(); ++i)
        EXPECT_LE(ground.field.height_m[way[i]], ground.field.height_m[way[i - 1]]);
    EXPECT_EQ(way_of_water(ground, ground.field.height_m, way.back(), true),
              std::vector<std::size_t>{way.back()});
}

TEST(TapSites, AHollowFillsInADryDay)
{
    const Valley place;
    const auto dry = rain_table(30, 0.0, 0.0, 0.0);
    ScenarioTap tap = tap_at(-3.3, 1.2, 30.0);
    tap.from_s = 3600.0;
    tap.to_s = 4.5 * 3600.0;
    const SceneSites sites = place.sites({tap});
    weather::PatchParams params;
    const std::int64_t start_us = dry.time_us.front();
    params.taps = taps_of_run(sites.taps, [&](double time_s) {
        return start_us + static_cast<std::int64_t>(time_s * 1e6);
    });
    PlaceWeatherOfFile run(sites, dry, params, start_us);
    const auto before = run.at(dry.time_us[1]);
    EXPECT_EQ(run.sums().books.let_in, 0.0);
    EXPECT_EQ(run.sums().ponds_m3, 0.0);
    const auto after = run.at(dry.time_us[6]);
    const PlaceSums sums = run.sums();
    EXPECT_NEAR(sums.books.let_in, 30.0 * 3.5 * 60.0, 1e-6);  // litres are kilograms
    EXPECT_EQ(sums.books.fallen, 0.0);
    EXPECT_GT(sums.ponds_m3, 5.5);
    EXPECT_LE(std::abs(sums.books.residual()), 1e-9 * sums.books.let_in);
    const weather::TapStretch& way = sites.taps[0].tap.stretches[0];
    const std::uint32_t pond = way.runs_to & ~weather::kToPond;
    EXPECT_GT(after->levels_m[pond + 1], before->levels_m[pond + 1] + 0.1f);
    // The way is wet, the ground above the tap is dry.
    const auto film = [&](std::uint32_t patch) {
        return after->states[patch * PLACE_STATE_TEXELS + 2].x;
    };
    EXPECT_GT(film(way.way[2]), 0.2f);
    for (std::uint32_t i = 0; i < place.patches.count; ++i)
        if (place.patches.position_m[i].x < -4.0f) {
            EXPECT_EQ(film(i), 0.0f) << i;
        }
}

// Two troughs one below the other: the lower one and the way to it stay dry until the upper is full.
TEST(TapSites, WaterRunsOverTheBrimToTheNextHollowAndOut)
{
    scene::Scene scene = valley();
    scene.meshes.front().primitives.clear();
    const std::vector<glm::vec2> profile{{-6, 0.6f}, {-3, 0.2f}, {-1, 0.35f},
                                         {2, 0.05f}, {4, 0.2f},  {6, -0.1f}};
    for (std::size_t i = 1; i < profile.size(); ++i) {
        const glm::vec2 a = profile[i - 1], b = profile[i];
        add_quad(scene, {a.x, a.y, 4}, {b.x - a.x, b.y - a.y, 0}, {0, 0, -8});
    }
    add_quad(scene, {-6, 0.6f, 5}, {12, 0, 0}, {0, 0, -1});
    add_quad(scene, {-6, 0.6f, -4}, {12, 0, 0}, {0, 0, -1});
    const Valley place(std::move(scene));
    const SceneSites sites = place.sites({tap_at(-4.4, 0.3, 60.0)});
    const std::vector<weather::TapStretch>& ways = sites.taps[0].tap.stretches;
    ASSERT_EQ(ways.size(), 3u);
    EXPECT_NEAR(ways[0].spill_m, 0.35, 0.01);
    EXPECT_NEAR(ways[1].spill_m, 0.2, 0.01);
    EXPECT_EQ(ways[2].runs_to, weather::kRunsOut);
    EXPECT_NE(ways[0].runs_to, ways[1].runs_to);
    const auto dry = rain_table(30, 0.0, 0.0, 0.0);
    weather::PatchParams params;
    params.taps = taps_of_run(sites.taps, [](double) { return std::int64_t{0}; });
    params.taps[0].from_us = dry.time_us.front();
    PlaceWeatherOfFile run(sites, dry, params, dry.time_us.front());
    const auto wet_at = [&](std::size_t hour) {
        const auto now = run.at(dry.time_us[hour]);
        std::vector<bool> wet;
        for (const weather::TapStretch& stretch : ways)
            wet.push_back(now->states[stretch.way[stretch.way.size() / 2] * PLACE_STATE_TEXELS + 2].x >
                          0.2f);
        return wet;
    };
    // 3.6 m3 an hour; the upper trough holds 1.9 m3, the lower one 2.1.
    EXPECT_EQ(wet_at(0), (std::vector<bool>{false, false, false}));
    EXPECT_EQ(wet_at(1), (std::vector<bool>{true, false, false}));
    EXPECT_EQ(wet_at(2), (std::vector<bool>{true, true, false}));
    EXPECT_EQ(wet_at(8), (std::vector<bool>{true, true, true}));
    const weather::PatchLedger books = run.sums().books;
    EXPECT_GT(books.out, 1000.0);
    EXPECT_LE(std::abs(books.residual()), 1e-9 * books.let_in);
}

// Under keys of the artist model: dry weather, an hour of the clock each second.
TEST(ArtistTaps, WetTheirWayAndFillTheHollowUnderKeysToo)
{
    const Valley place;
    ScenarioTap tap = tap_at(-3.3, 1.2, 30.0);
    tap.from_s = 1.0;
    tap.to_s = 4.5;
    const SceneSites sites = place.sites({tap});
    const WeatherScript script = read_weather_script(
        "[weather]\nkeys = [{ time_s = 0, temperature_c = 20, rainfall = 0 }, { time_s = 40, temperature_c = 20 }]", "test");
    const ArtistPlaces places(sites, script, 50.0, 0.0, {1.0, 0.0, 40.0});
    const ArtistPlaces without(place.sites({}), script, 50.0, 0.0);
    const weather::TapStretch& way = sites.taps[0].tap.stretches[0];
    const std::uint32_t pit = (way.runs_to & ~weather::kToPond) + 1;
    const auto film = [&](double time_s, std::uint32_t patch) { return places.at(time_s)->states[patch * PLACE_STATE_TEXELS].x; };
    const auto over_pit_m = [&](double time_s) {
        return places.at(time_s)->levels_m[pit] - sites.ground.basins.hollow[pit].pit_m;
    };
    EXPECT_EQ(film(0.9, way.way[2]), 0.0f);
    EXPECT_LE(over_pit_m(0.9), 0.0f);
    EXPECT_GT(film(4.4, way.way[2]), 0.9f);
    EXPECT_GT(over_pit_m(2.0), 0.02f);
    EXPECT_GT(over_pit_m(4.4), over_pit_m(2.0) + 0.05f);
    // 30 l a minute for 3.5 hours.
    scene::BasinWater water(sites.ground.basins);
    std::vector<double> into(sites.ground.basins.pits + std::size_t{1}, 0.0);
    into[pit] = 6.3;
    scene::pour(sites.ground.basins, water, into);
    EXPECT_NEAR(places.at(4.5)->levels_m[pit], scene::levels_m(sites.ground.basins, water)[pit], 0.003f);
    // It dries as puddles do, and nothing else was ever wet.
    EXPECT_LT(film(39.0, way.way[2]), 0.2f);
    EXPECT_LT(over_pit_m(39.0), over_pit_m(4.5) - 0.01f);
    for (std::uint32_t i = 0; i < place.patches.count; ++i)
        if (place.patches.position_m[i].x < -4.0f) {
            EXPECT_EQ(film(4.4, i), 0.0f) << i;
        }
    EXPECT_EQ(places.at(0.5)->states, without.at(0.5)->states);
}

TEST(ArtistTaps, KeepTheirWayOpenInFrost)
{
    const Valley place;
    ScenarioTap tap = tap_at(-3.3, 1.2, 30.0);
    tap.to_s = 10.0;
    const SceneSites sites = place.sites({tap});
    const WeatherScript script = read_weather_script(
        "[weather]\nkeys = [{ time_s = 0, temperature_c = -12, rainfall = 0 }, { time_s = 40, temperature_c = -12 }]", "test");
    const ArtistPlaces places(sites, script, 50.0, 0.0, {1.0, 0.0, 40.0});
    const std::uint32_t on_way = sites.taps[0].tap.stretches[0].way[2];
    const auto of = [&](double time_s, std::size_t texel) { return places.at(time_s)->states[on_way * PLACE_STATE_TEXELS + texel]; };
    EXPECT_LT(of(9.0, 1).y, 0.05f);
    EXPECT_GT(of(9.0, 0).x, 0.9f);
    // Then it freezes, and stays as ice.
    EXPECT_GT(of(30.0, 1).y, 0.9f);
    EXPECT_GT(of(30.0, 0).z, 0.3f);
}

TEST(ArtistTaps, AreNoColderThanTheirWaterAndJumpAtTheirTimes)
{
    WeatherScript script = read_weather_script(
        "[weather]\nkeys = [{ time_s = 0, temperature_c = -8, rainfall = 0.2 }, { time_s = 20, temperature_c = 30, rainfall = 0.2 }]", "test");
    const WeatherScript under_a_roof = script_at_place(script, {0.0, 1.0, 1.0, 1.0});
    const WeatherScript below = script_below_taps(script, under_a_roof, {{4.0, 18.0, 10.0}});
    const auto air = [&](double s) { return weather::value_at(below.timeline.temperature_c, 1e6 * s); };
    EXPECT_NEAR(air(2.0), -4.2, 1e-4);
    EXPECT_NEAR(air(5.0), 10.0, 1e-4);
    EXPECT_NEAR(air(17.5), 25.25, 1e-4);
    EXPECT_NEAR(air(19.0), 28.1, 1e-4);
    EXPECT_NEAR(weather::value_at(below.timeline.rainfall, 3.999e6), 0.2, 1e-9);
    EXPECT_EQ(weather::value_at(below.timeline.rainfall, 4.001e6), 1.0);
    EXPECT_NEAR(weather::value_at(below.timeline.rainfall, 18.001e6), 0.2, 1e-9);
    const weather::Channel& wets = below.timeline.parameters.at("accumulation_rate_wetness");
    EXPECT_EQ(weather::value_at(wets, 2e6), 0.0);
    EXPECT_EQ(weather::value_at(wets, 10e6), script.params.accumulation_rate_wetness);
}

// Without patches too water leaves by the drains of the keys, and what is no ground holds none.
TEST(Hollows, KnowTheDrainsOfTheKeys)
{
    const scene::Scene scene = valley();
    ScenarioGround keys;
    const Hollows without(scene, keys);
    ASSERT_TRUE(without.any());
    const auto stands = [](const Hollows& hollows) {
        const auto place = hollows.at(1.0f);
        return place && std::any_of(place->levels_m.begin() + 1, place->levels_m.end(), [](float m) { return m > scene::kDry_m; });
    };
    EXPECT_TRUE(stands(without));
    keys.drains.emplace_back(2.0, 0.0, 8.0);
    EXPECT_FALSE(stands(Hollows(scene, keys)));
}

TEST(TapSites, OutsideOfTheGroundTheyAreRefused)
{
    const Valley place;
    EXPECT_THROW(place.sites({tap_at(500.0, 0.0)}), Error);
    EXPECT_THROW(place.sites({tap_at(0.0, -7.0)}), Error);
    EXPECT_NO_THROW(place.sites({tap_at(0.0, 0.0)}));
    SceneGround nothing;
    EXPECT_THROW(tap_sites({tap_at(0.0, 0.0)}, nothing, place.patches), Error);
}

std::string error_of(const std::string& ground)
{
    try {
        parse_scenario("[scene]\nfile = \"demo:street\"\n" + ground, "s.toml");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(GroundKeys, TapsAndDrainsAreTables)
{
    const Scenario s = parse_scenario(
        "[scene]\nfile = \"demo:street\"\n[ground]\ndrains = [[1.0, 2.0, 0.3]]\n"
        "[[ground.drain]]\nx_z_m = [4.0, -5.0]\nradius_m = 0.2\n"
        "[[ground.drain]]\nx_z_m = [0.0, 1.0]\n"
        "[[ground.tap]]\nx_z_m = [2.0, -1.5]\nlitres_per_min = 20.0\ntemperature_c = 4.0\nto_s = 600.0\n",
        "s.toml");
    const std::set<std::vector<double>> drains = [&] {
        std::set<std::vector<double>> all;
        for (const glm::dvec3& d : s.ground.drains) all.insert({d.x, d.y, d.z});
        return all;
    }();
    EXPECT_EQ(drains, (std::set<std::vector<double>>{
                          {1.0, 2.0, 0.3}, {4.0, -5.0, 0.2}, {0.0, 1.0, 0.0}}));
    ASSERT_EQ(s.ground.taps.size(), 1u);
    EXPECT_EQ(s.ground.taps[0].x_z_m, glm::dvec2(2.0, -1.5));
    EXPECT_EQ(s.ground.taps[0].litres_per_min, 20.0);
    EXPECT_EQ(s.ground.taps[0].temperature_c, 4.0);
    EXPECT_FALSE(s.ground.taps[0].from_s.has_value());
    EXPECT_EQ(s.ground.taps[0].to_s, 600.0);
}

TEST(GroundKeys, WhatATapCannotBeIsRefused)
{
    const std::string tap = "[[ground.tap]]\nx_z_m = [2.0, -1.5]\n";
    EXPECT_EQ(error_of(tap + "litres_per_min = 1.0\n"), "");
    for (const char* flow : {"-1.0", "nan", "inf", "\"much\""})
        EXPECT_NE(error_of(tap + "litres_per_min = " + flow + "\n"), "") << flow;
    EXPECT_NE(error_of(tap), "");
    EXPECT_NE(error_of("[[ground.tap]]\nlitres_per_min = 1.0\n"), "");
    EXPECT_NE(error_of("[[ground.tap]]\nx_z_m = [nan, 0.0]\nlitres_per_min = 1.0\n"), "");
    EXPECT_NE(error_of(tap + "litres_per_min = 1.0\nfrom_s = 5.0\nto_s = 4.0\n"), "");
    EXPECT_EQ(error_of(tap + "litres_per_min = 1.0\ntemperature_c = 60\n"), "");
    EXPECT_NE(error_of(tap + "litres_per_min = 1.0\ntemperature_c = -1\n"), "");
    EXPECT_NE(error_of(tap + "litres_per_min = 1.0\ntemperature_c = nan\n"), "");
    EXPECT_NE(error_of(tap + "litres_per_minute = 1.0\n"), "");
    EXPECT_NE(error_of("[[ground.drain]]\nx_z_m = [0.0, 0.0]\nradius_m = -1.0\n"), "");
    EXPECT_NE(error_of("[[ground.drain]]\nradius_m = 1.0\n"), "");
}

TEST(GroundKeys, ATapWithoutPatchesIsSaid)
{
    const auto says_so = [](const std::string& text) {
        const Sequence sequence = make_sequence(parse_scenario(text, "s.toml"));
        std::vector<std::string> notes;
        const ScenePlaces places(sequence, 1, {}, {}, notes);
        return std::count_if(notes.begin(), notes.end(), [](const std::string& note) {
            return note.find("no water runs") != std::string::npos;
        });
    };
    const std::string preset = "[weather]\npreset = \"storm\"\n";
    const std::string tap = "[[ground.tap]]\nx_z_m = [0.0, 0.0]\nlitres_per_min = 1.0\n";
    EXPECT_EQ(says_so(preset), 0);
    EXPECT_EQ(says_so(preset + tap), 1);
    EXPECT_EQ(says_so(preset + "[ground]\npatches = false\n" + tap), 1);
}

}  // namespace
}  // namespace petrichor::film
