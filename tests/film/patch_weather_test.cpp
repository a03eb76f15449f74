// A scene's own geometry under a weather file: where its water goes, what its patches hold.
#include "film/weather/patch_weather.h"
#include "film/weather/artist_places.h"
#include "film/weather/film_by_name.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formulas/weather/falls_here.h"
#include "scene/basins/water.h"
#include "tests/film/rain_table.h"
#include "weather/models/physical/mapping.h"

namespace petrichor::film {
namespace {

void add_quad(scene::Scene& scene, std::uint32_t material, const glm::vec3& corner,
              const glm::vec3& u, const glm::vec3& v)
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
    p.material = material;
    scene.meshes.front().primitives.push_back(std::move(p));
}

// Ground of 12 x 12 m with a trough along z at x = 2, a wall on the line x = -2 that faces east,
// and an awning over part of the ground.
scene::Scene yard()
{
    scene::Scene scene;
    for (const char* name : {"Asphalt", "brick wall", "Metal roof"}) {
        scene::Material m;
        m.name = name;
        m.base_color = glm::vec4(0.2f, 0.2f, 0.2f, 1.0f);
        m.metallic = 0.0f;
        m.double_sided = std::string(name) == "Metal roof";
        scene.materials.push_back(m);
    }
    scene.meshes.emplace_back();
    scene.instances.push_back({"yard", 0, glm::mat4(1.0f)});
    add_quad(scene, 0, {-6, 0, 6}, {7, 0, 0}, {0, 0, -12});
    // The trough is closed at both ends by the level of the ground around it.
    add_quad(scene, 0, {1, 0, 4}, {1, -0.1f, 0}, {0, 0, -8});
    add_quad(scene, 0, {2, -0.1f, 4}, {1, 0.1f, 0}, {0, 0, -8});
    add_quad(scene, 0, {1, 0, 6}, {2, 0, 0}, {0, 0, -2});
    add_quad(scene, 0, {1, 0, -4}, {2, 0, 0}, {0, 0, -2});
    add_quad(scene, 0, {3, 0, 6}, {3, 0, 0}, {0, 0, -12});
    add_quad(scene, 1, {-2, 0, 3}, {0, 0, -6}, {0, 3, 0});
    add_quad(scene, 2, {-6, 2.5f, 6}, {2, 0.5f, 0}, {0, 0, -12});
    return scene;
}

scene::Patches cut(const scene::Tracer& tracer)
{
    scene::PatchOptions options;
    options.cell_m = 0.5f;
    options.rays = 64;
    return scene::build_patches(tracer, options);
}

struct Place {
    scene::Scene scene = yard();
    scene::Triangles triangles{scene, {}};
    scene::Tracer tracer{triangles};
    scene::Patches patches = cut(tracer);
    std::vector<scene::PatchSurface> surfaces = scene::patch_surfaces(patches, triangles, {});
    SceneSites sites =
        scene_sites(scene, patches, tracer, surfaces, {}, weather::surface_preset("asphalt"));

    // The first patch that a test accepts.
    template <class Test>
    std::uint32_t patch_where(const Test& test) const
    {
        for (std::uint32_t i = 0; i < patches.count; ++i)
            if (test(patches.position_m[i], patches.normal[i])) return i;
        ADD_FAILURE() << "no such patch";
        return 0;
    }
};

TEST(PatchSites, NamesSayWhatThingsAreMadeOf)
{
    const auto kind = [](const char* name, float metallic = 0.0f) {
        scene::Material m;
        m.name = name;
        m.metallic = metallic;
        return surface_of_material(m, weather::surface_preset("rock")).name;
    };
    EXPECT_EQ(kind("Old_Cobblestone.002"), "cobblestone");
    EXPECT_EQ(kind("ROOF tiles"), "roof_tile");
    EXPECT_EQ(kind("zinc roof"), "roof_metal");
    EXPECT_EQ(kind("Material.001"), "rock");
    EXPECT_EQ(kind("Plants"), "lawn");
    EXPECT_EQ(kind("planks"), "wood");
    EXPECT_EQ(kind("Material.001", 1.0f), "roof_metal");
}

TEST(FilmByName, LawnsShowAThirdOfAFilmUnlessTheirMaterialSaysMore)
{
    scene::Scene scene;
    for (const char* name : {"GrassMaterial", "cobble", "Grass of a garden"}) {
        scene.materials.emplace_back();
        scene.materials.back().name = name;
    }
    scene.materials[2].weather.film = 0.8f;
    set_films_by_name(scene);
    EXPECT_EQ(scene.materials[0].weather.film, 0.35f);
    EXPECT_EQ(scene.materials[1].weather.film, 1.0f);
    EXPECT_EQ(scene.materials[2].weather.film, 0.8f);
}

// A closed box without its floor.
void add_box(scene::Scene& scene, std::uint32_t material, const glm::vec3& low,
             const glm::vec3& high)
{
    const glm::vec3 s = high - low;
    add_quad(scene, material, {low.x, low.y, high.z}, {s.x, 0, 0}, {0, s.y, 0});
    add_quad(scene, material, {high.x, low.y, low.z}, {-s.x, 0, 0}, {0, s.y, 0});
    add_quad(scene, material, {high.x, low.y, high.z}, {0, 0, -s.z}, {0, s.y, 0});
    add_quad(scene, material, {low.x, low.y, low.z}, {0, 0, s.z}, {0, s.y, 0});
    add_quad(scene, material, {low.x, high.y, high.z}, {s.x, 0, 0}, {0, 0, -s.z});
}

TEST(PatchSites, HousesHaveRoomsBehindTheirWallsAndGardenWallsAir)
{
    scene::Scene scene = yard();
    add_box(scene, 1, {-4, 0, -14}, {4, 3, -8});      // a house
    add_box(scene, 1, {-4, 0, 10}, {4, 2, 10.4f});    // a garden wall
    add_box(scene, 1, {-4, 1.85f, 9.85f}, {4, 2.1f, 10.55f});  // its coping
    add_box(scene, 1, {1, 0, -7.9f}, {2, 1, -7.5f});  // a chest before the house
    // A bush behind the garden wall is no room of it.
    scene::Material bush;
    bush.name = "Bush";
    bush.double_sided = true;
    bush.metallic = 0.0f;
    scene.materials.push_back(bush);
    add_quad(scene, 3, {-4, 0, 13}, {8, 0, 0}, {0, 3, 0});
    add_quad(scene, 3, {-4, 3, 13}, {8, 0, 0}, {0, 0, -2.6f});
    const scene::Triangles triangles(scene, {});
    const scene::Tracer tracer(triangles);
    const scene::Patches patches = cut(tracer);
    const auto surfaces = scene::patch_surfaces(patches, triangles, {});
    const SceneSites sites =
        scene_sites(scene, patches, tracer, surfaces, {}, weather::surface_preset("asphalt"));
    std::size_t house = 0, garden = 0, chest = 0, lone = 0, leaves = 0;
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        const glm::vec3 at = patches.position_m[i];
        const weather::PatchKind& kind = sites.set.kinds[sites.set.patches[i].kind];
        if (patches.material[i] == 3) {
            ++leaves;
            EXPECT_TRUE(kind.surface.open_below && !kind.room_behind);
            EXPECT_LT(kind.surface.layers.at(0).thickness_m, 0.05);
        } else if (std::abs(patches.normal[i].y) > 0.3f) {
            EXPECT_FALSE(kind.room_behind || kind.surface.open_below) << at.x << " " << at.z;
        } else if (at.z < -7.95f) {
            ++house;
            EXPECT_TRUE(kind.room_behind) << at.x << " " << at.y << " " << at.z;
            EXPECT_DOUBLE_EQ(kind.surface.layers.at(0).thickness_m, 0.3);
        } else if (at.z > 9.0f && std::abs(patches.normal[i].z) > 0.9f) {
            ++garden;
            EXPECT_TRUE(kind.surface.open_below && !kind.room_behind) << at.x << " " << at.z;
            EXPECT_DOUBLE_EQ(kind.surface.layers.at(0).thickness_m, 0.1);
        } else if (at.z < -7.4f && patches.normal[i].x * patches.normal[i].x > 0.9f) {
            ++chest;
            EXPECT_TRUE(kind.surface.open_below && !kind.room_behind) << at.x << " " << at.z;
        } else if (std::abs(at.x + 2.0f) < 0.1f && std::abs(at.z) < 3.0f) {
            ++lone;  // a wall of one side: nobody knows what is behind
            EXPECT_TRUE(!kind.surface.open_below && !kind.room_behind &&
                        kind.surface.layers.empty());
        }
    }
    EXPECT_GT(house, 50u);
    EXPECT_GT(garden, 10u);
    EXPECT_GT(chest, 2u);
    EXPECT_GT(lone, 20u);
    EXPECT_GT(leaves, 50u);
}

// A timber frame: its beams are bodies of their own, sunk into a wall of one side.
TEST(PatchSites, ABeamSunkIntoAWallHasBehindItWhatTheWallHas)
{
    scene::Scene scene = yard();
    scene::Material wood;
    wood.name = "Wood beam";
    wood.metallic = 0.0f;
    scene.materials.push_back(wood);
    add_box(scene, 3, {-2.09f, 0.8f, -2.2f}, {-1.97f, 1.7f, 2.2f});   // in the wall
    add_box(scene, 3, {-0.09f, 0.8f, -2.2f}, {0.03f, 1.7f, 2.2f});    // the same, free
    const scene::Triangles triangles(scene, {});
    const scene::Tracer tracer(triangles);
    const scene::Patches patches = cut(tracer);
    const auto surfaces = scene::patch_surfaces(patches, triangles, {});
    const SceneSites sites =
        scene_sites(scene, patches, tracer, surfaces, {}, weather::surface_preset("asphalt"));
    std::size_t sunk = 0, lone = 0;
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        const glm::vec3 at = patches.position_m[i];
        if (patches.material[i] != 3 || patches.normal[i].x < 0.9f) continue;
        const weather::PatchKind& kind = sites.set.kinds[sites.set.patches[i].kind];
        const bool free = at.x > -1.0f;
        ++(free ? lone : sunk);
        EXPECT_EQ(kind.surface.open_below, free) << at.x << " " << at.y << " " << at.z;
    }
    EXPECT_GT(sunk, 4u);
    EXPECT_GT(lone, 4u);
}

TEST(PatchSites, BladesOfALawnHaveAirAroundAndItsBanksSoil)
{
    scene::Scene scene = yard();
    scene::Material lawn;
    lawn.name = "Lawn";
    lawn.metallic = 0.0f;
    lawn.double_sided = true;
    scene.materials.push_back(lawn);
    for (int k = 0; k < 900; ++k)
        add_quad(scene, 3, {0.03f * static_cast<float>(k % 30), 0, 0.03f * static_cast<float>(k / 30)},
                 {0.01f, 0, 0}, {0, 0.3f, 0.02f});
    add_quad(scene, 3, {3, 0, 0}, {3, 0, 0}, {0, 2, -0.2f});  // a bank
    const scene::Triangles triangles(scene, {});
    const scene::Tracer tracer(triangles);
    const scene::Patches patches = cut(tracer);
    const auto surfaces = scene::patch_surfaces(patches, triangles, {});
    const SceneSites sites =
        scene_sites(scene, patches, tracer, surfaces, {}, weather::surface_preset("asphalt"));
    std::size_t blades = 0, bank = 0;
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        if (patches.material[i] != 3 || std::abs(patches.normal[i].y) > 0.3f) continue;
        const weather::PatchKind& kind = sites.set.kinds[sites.set.patches[i].kind];
        const bool blade = patches.position_m[i].x < 2.0f;
        ++(blade ? blades : bank);
        EXPECT_EQ(kind.surface.open_below, blade) << patches.position_m[i].x;
        EXPECT_NEAR(kind.surface.layers.at(0).thickness_m, blade ? 0.02 : 0.01, 1e-9);
    }
    EXPECT_GT(blades, 4u);
    EXPECT_GT(bank, 8u);
}

TEST(PatchSites, WaterGoesWhereTheSceneLeadsIt)
{
    const Place place;
    const weather::PatchSet& set = place.sites.set;
    EXPECT_EQ(set.patches.size(), place.patches.count + place.sites.shelter.cuts.size());
    // The sides of the trough drain to its hollow.
    const auto side = place.patch_where([](glm::vec3 p, glm::vec3 n) {
        return p.x > 1.2f && p.x < 1.8f && std::abs(p.z) < 3.0f && n.y > 0.5f;
    });
    ASSERT_NE(set.patches[side].runs_to, weather::kRunsOut);
    EXPECT_NE(set.patches[side].runs_to & weather::kToPond, 0u);
    // Open ground beside the edge leads out.
    const auto edge = place.patch_where(
        [](glm::vec3 p, glm::vec3 n) { return p.x > 5.0f && p.z > 4.0f && n.y > 0.9f; });
    EXPECT_EQ(set.patches[edge].runs_to, weather::kRunsOut);
    // The wall's rain runs to the ground at its foot, which splashes back.
    const auto foot = place.patch_where(
        [](glm::vec3 p, glm::vec3 n) { return n.x > 0.9f && p.y < 0.4f && std::abs(p.z) < 2.0f; });
    ASSERT_LT(set.patches[foot].runs_to, set.patches.size());
    EXPECT_GT(place.patches.normal[set.patches[foot].runs_to].y, 0.9f);
    EXPECT_NE(set.patches[foot].foot, weather::kNoPatch);
    EXPECT_LT(set.patches[foot].foot_height_m, 0.6);
    const auto high = place.patch_where(
        [](glm::vec3 p, glm::vec3 n) { return n.x > 0.9f && p.y > 2.5f && std::abs(p.z) < 1.0f; });
    EXPECT_EQ(set.patches[high].foot, weather::kNoPatch);
    EXPECT_GT(set.patches[high].wall_factor, set.patches[foot].wall_factor);
    // The roof sheds its water over the eaves, most of it into a gutter.
    const auto eaves = place.patch_where(
        [](glm::vec3 p, glm::vec3 n) { return n.y > 0.9f && p.y > 2.4f && p.x < -5.6f; });
    EXPECT_EQ(set.kinds[set.patches[eaves].kind].surface.name, "roof_metal");
    EXPECT_GT(set.patches[eaves].gutter_share + (set.patches[eaves].runs_to == weather::kRunsOut),
              0.5);
    weather::check_patches(set);
}

TEST(PatchWeatherOfAScene, RainFillsTheHollowAndTheBooksClose)
{
    Place place;
    const auto table = rain_table(30, 5.0, 0.0, 0.0);
    weather::PatchParams params;
    PlaceWeatherOfFile run(place.sites, table, params, table.time_us.front());
    const auto at = [&](int hour) { return run.at(table.time_us[static_cast<std::size_t>(hour)]); };
    const auto dry = at(0);
    const auto wet = at(8);
    const PlaceSums sums = run.sums();
    EXPECT_GT(sums.ponds_m3, 0.0);
    EXPECT_LT(std::abs(sums.books.residual()), 1e-9 * sums.books.fallen);
    ASSERT_EQ(wet->levels_m.size(), place.sites.ground.basins.pits + 1);
    bool rose = false;
    for (std::size_t i = 1; i < wet->levels_m.size(); ++i)
        rose = rose || wet->levels_m[i] > dry->levels_m[i] + 0.005f;
    EXPECT_TRUE(rose);
    // Without end it is as full as it gets: the level of the ground.
    const auto full = at(29);
    float highest = -1.0f;
    for (std::size_t i = 1; i < full->levels_m.size(); ++i)
        highest = std::max(highest, full->levels_m[i]);
    EXPECT_NEAR(highest, 0.0f, 0.01f);
    // Under the roof it stays dry, but for what the run-off brings.
    const auto under = place.patch_where([](glm::vec3 p, glm::vec3 n) {
        return n.y > 0.9f && p.y < 0.1f && p.x > -5.4f && p.x < -4.6f && std::abs(p.z) < 3.0f;
    });
    const auto open = place.patch_where([](glm::vec3 p, glm::vec3 n) {
        return n.y > 0.9f && p.y < 0.1f && p.x > 4.0f && p.x < 5.0f && std::abs(p.z) < 3.0f;
    });
    EXPECT_EQ(wet->states[under * PLACE_STATE_TEXELS + 2].x, 0.0f);
    EXPECT_GT(wet->states[open * PLACE_STATE_TEXELS + 2].x, 0.3f);
    EXPECT_EQ(wet->states[under * PLACE_STATE_TEXELS + 1].z, 0.0f);
    // In any order.
    const auto again = at(8);
    EXPECT_EQ(again->states, wet->states);
    EXPECT_EQ(again->levels_m, wet->levels_m);
}

// Frost after rain: what stands in the hollow turns to ice, which floats: the level stays.
TEST(PatchWeatherOfAScene, TheHollowFreezes)
{
    const Place place;
    const auto table = rain_table(72, 10.0, 2.0, 0.0, 4, -12.0);
    PlaceWeatherOfFile run(place.sites, table, {}, table.time_us.front());
    const auto bottom = place.patch_where([](glm::vec3 p, glm::vec3 n) {
        return n.y > 0.9f && p.y < -0.05f && std::abs(p.z) < 2.0f;
    });
    const auto high = place.patch_where([](glm::vec3 p, glm::vec3 n) {
        return n.y > 0.9f && p.x > 4.0f && p.x < 5.0f && p.y < 0.1f && std::abs(p.z) < 3.0f;
    });
    const auto ice = [&](const gpu::PlaceWeather& at, std::uint32_t patch) {
        return at.states[patch * PLACE_STATE_TEXELS + 2].w;
    };
    const auto wet = run.at(table.time_us[4]);
    const double before_m3 = run.sums().ponds_m3;
    EXPECT_LT(wet->states[bottom * PLACE_STATE_TEXELS + 1].y, 0.01f);
    EXPECT_EQ(run.sums().pond_ice_kg, 0.0);
    const auto frozen = run.at(table.time_us[60]);
    const PlaceSums sums = run.sums();
    EXPECT_EQ(frozen->states[bottom * PLACE_STATE_TEXELS + 1].y, 1.0f);
    EXPECT_GT(ice(*frozen, bottom), 5.0f);
    EXPECT_GT(ice(*frozen, bottom), ice(*frozen, high) + 4.0f);
    EXPECT_LT(frozen->states[bottom * PLACE_STATE_TEXELS + 3].x, 0.9f);
    EXPECT_GT(sums.pond_ice_kg, 0.05 * sums.ponds_m3 * weather::kWaterDensity);
    EXPECT_LE(sums.pond_ice_kg, sums.ponds_m3 * weather::kWaterDensity * (1.0 + 1e-9));
    EXPECT_GT(sums.ponds_m3, 0.8 * before_m3);
    EXPECT_LT(std::abs(sums.books.residual()), 1e-9 * sums.books.fallen);
}

// What stands below the levels is what the books say, to rounding; it rises until it spills.
TEST(PatchWeatherOfAScene, TwoTenAndFortyMillimetresStandAsTheyFell)
{
    const Place place;
    double capacity = 0.0;
    for (const scene::Hollow& h : place.sites.ground.basins.hollow)
        if (h.parent == 0) capacity += h.capacity_m3;
    double before = 0.0, out_before = -1.0;
    for (const double mm : {2.0, 10.0, 40.0}) {
        const auto table = rain_table(4, mm, 0.0, 0.0);
        PlaceWeatherOfFile run(place.sites, table, {}, table.time_us.front());
        const auto wet = run.at(table.time_us[1]);
        const PlaceSums sums = run.sums();
        const scene::HeightField& field = place.sites.ground.field;
        double below = 0.0;
        for (std::size_t c = 0; c < field.cells(); ++c) {
            const std::uint32_t label = place.sites.ground.basins.label[c];
            if (label == scene::kOutside || label == scene::kNoLabel) continue;
            const float depth = wet->levels_m[label] - field.height_m[c];
            if (depth > 0.0f) below += static_cast<double>(depth) * field.cell_m * field.cell_m;
        }
        EXPECT_NEAR(below, sums.ponds_m3, 1e-4 * capacity) << mm;
        // Film and cracks take the first two.
        if (mm > 2.0) {
            EXPECT_GT(sums.ponds_m3, before) << mm;
        }
        EXPECT_LE(sums.ponds_m3, capacity * (1.0 + 1e-9)) << mm;
        EXPECT_GT(sums.books.out, out_before) << mm;
        EXPECT_LT(std::abs(sums.books.residual()), 1e-9 * sums.books.fallen) << mm;
        before = sums.ponds_m3;
        out_before = sums.books.out;
    }
}

TEST(PatchWeatherOfAScene, TheWallIsWetInTheWindThatBlowsOnIt)
{
    Place place;
    const auto wall = place.patch_where([](glm::vec3 p, glm::vec3 n) {
        return n.x > 0.9f && p.y > 1.5f && p.y < 2.4f && std::abs(p.z) < 2.0f;
    });
    const auto film_in = [&](double from_deg) {
        const auto table = rain_table(6, 5.0, 6.0, from_deg);
        PlaceWeatherOfFile run(place.sites, table, {}, table.time_us.front());
        return run.at(table.time_us[3])->states[wall * PLACE_STATE_TEXELS + 2].x;
    };
    EXPECT_GT(film_in(90.0), 0.2f);
    EXPECT_EQ(film_in(270.0), 0.0f);
}

// While a wet yard freezes, the film that is shown is the liquid one: no share of it is taken off twice.
TEST(PatchWeatherOfAScene, TheFilmThatIsShownIsLiquid)
{
    Place place;
    auto table = rain_table(14, 4.0, 3.0, 0.0, 3);
    for (std::size_t i = 2; i < 14; ++i)
        table[weather::Field::AirTemp][i] = weather::kZeroCelsiusK - 12.0;
    PlaceWeatherOfFile run(place.sites, table, {}, table.time_us.front());
    std::size_t both = 0;
    for (const int minutes : {150, 210, 300, 480}) {
        const auto at = run.at(table.time_us.front() + minutes * std::int64_t{60000000});
        for (std::size_t i = 0; i < place.patches.count; ++i) {
            const glm::vec4* s = &at->states[i * PLACE_STATE_TEXELS];
            EXPECT_NEAR(s[0].x, shared::wetness_of_film(s[2].x), 1e-5f) << i;
            if (s[2].x > 0.05f && s[1].y > 0.1f) ++both;
        }
    }
    EXPECT_GT(both, 20u) << "film and ice at once";
}

// The renderer's text of the map says what the model's does.
TEST(PatchWeatherOfAScene, WetnessIsThatOfTheModel)
{
    for (const double mm : {0.0, 0.01, 0.1, 0.25, 1.0, 5.0})
        EXPECT_NEAR(static_cast<double>(shared::wetness_of_film(static_cast<float>(mm))),
                    weather::wetness_of_film({}, mm), 1e-6);
}

// A ball in the air: nothing is ground, there are no hollows, and all that runs off leaves the scene.
TEST(PatchWeatherOfAScene, SomethingWithoutGroundHasItsWeather)
{
    scene::Scene scene = yard();
    scene.meshes.front().primitives.clear();
    add_quad(scene, 1, {-1, 5, 1}, {2, 0, 0}, {0, 2, 0});
    add_quad(scene, 1, {1, 5, -1}, {-2, 0, 0}, {0, 2, 0});
    const scene::Triangles triangles(scene, {});
    const scene::Tracer tracer(triangles);
    const scene::Patches patches = cut(tracer);
    ASSERT_GT(patches.count, 0u);
    const auto surfaces = scene::patch_surfaces(patches, triangles, {});
    const SceneSites sites =
        scene_sites(scene, patches, tracer, surfaces, {}, weather::surface_preset("asphalt"));
    EXPECT_EQ(sites.ground.basins.pits, 0u);
    for (const double wind : {0.0, 60.0}) {
        const auto table = rain_table(6, 5.0, wind, 180.0);
        PlaceWeatherOfFile run(sites, table, {}, table.time_us.front());
        const auto place = run.at(table.time_us[5]);
        for (const glm::vec4& texel : place->states)
            for (int k = 0; k < 4; ++k) EXPECT_TRUE(std::isfinite(texel[k]));
        const PlaceSums sums = run.sums();
        EXPECT_EQ(sums.ponds_m3, 0.0);
        EXPECT_LE(std::abs(sums.books.residual()), 1e-9 * sums.books.fallen);
        if (wind > 0.0) {
            EXPECT_GT(sums.books.out, 0.0);
        } else {
            EXPECT_EQ(sums.books.fallen, 0.0) << "upright faces in still air";
        }
    }
}

// A file of one row: its weather, for as long as it is asked for.
TEST(PatchWeatherOfAScene, AFileOfOneRowIsItsHour)
{
    const Place place;
    const auto table = rain_table(1, 5.0, 3.0, 180.0);
    PlaceWeatherOfFile run(place.sites, table, {}, table.time_us.front());
    constexpr std::int64_t kHour_us = 3600000000LL;
    const auto end = run.at(table.time_us.front() + 10 * kHour_us);
    const PlaceSums sums = run.sums();
    EXPECT_GT(sums.books.fallen, 0.0);
    EXPECT_LT(std::abs(sums.books.residual()), 1e-9 * sums.books.fallen);
    const auto before = run.at(table.time_us.front() - 10 * kHour_us);
    EXPECT_EQ(run.sums().books.fallen, 0.0);
    for (const auto& states : {end->states, before->states})
        for (const glm::vec4& texel : states)
            for (int k = 0; k < 4; ++k) EXPECT_TRUE(std::isfinite(texel[k]));
}

TEST(SceneGroundKeys, DrainsAndGlobsThatMeetNothingAreSaid)
{
    const scene::Scene scene = yard();
    ScenarioGround keys;
    std::vector<std::string> notes;
    EXPECT_GT(scene_ground(scene, keys, notes).basins.hollow.back().capacity_m3, 0.1);
    EXPECT_TRUE(notes.empty());
    keys.drains = {{2.0, 0.0, 0.2}, {500.0, 0.0, 0.1}};
    keys.ground = {"no such thing"};
    const SceneGround drained = scene_ground(scene, keys, notes);
    double capacity = 0.0;
    for (const scene::Hollow& h : drained.basins.hollow)
        if (h.parent == 0) capacity += h.capacity_m3;
    EXPECT_LT(capacity, 0.05);
    EXPECT_EQ(notes.size(), 2u);
}

TEST(ArtistPlaces, KeysKnowShelterAndHollows)
{
    const Place place;
    const WeatherScript script = read_weather_script(
        "[weather]\nkeys = [{ time_s = 0, temperature_c = 12, rainfall = 0.8, wind_m_s = 0.5, "
        "wind_from_deg = 90 }, { time_s = 20, rainfall = 0.8 }]",
        "test");
    const ArtistPlaces places(place.sites, script, 50.0, 0.0);
    EXPECT_GT(places.scripts(), 2u);
    EXPECT_LT(places.scripts(), 200u);
    const auto wet = places.at(10.0);
    const auto under = place.patch_where([](glm::vec3 p, glm::vec3 n) {
        return n.y > 0.9f && p.y < 0.1f && p.x > -5.4f && p.x < -4.6f && std::abs(p.z) < 3.0f;
    });
    const auto open = place.patch_where([](glm::vec3 p, glm::vec3 n) {
        return n.y > 0.9f && p.y < 0.1f && p.x > 4.0f && p.x < 5.0f && std::abs(p.z) < 3.0f;
    });
    EXPECT_LT(wet->states[under * PLACE_STATE_TEXELS].x, 0.15f);
    EXPECT_GT(wet->states[open * PLACE_STATE_TEXELS].x, 0.8f);
    EXPECT_GT(wet->states[open * PLACE_STATE_TEXELS].z, 0.5f);
    bool stands = false;
    for (std::uint32_t i = 1; i < wet->levels_m.size(); ++i)
        stands = stands || wet->levels_m[i] > place.sites.ground.basins.hollow[i].pit_m + 0.003f;
    EXPECT_TRUE(stands);
    // It is the wind of the rain that counts, not that of the middle: here it blows from the roof's side.
    const WeatherScript turning = read_weather_script(
        "[weather]\ninterpolation = \"hold\"\nkeys = [{ time_s = 0, temperature_c = 12, rainfall = 0.8, "
        "wind_m_s = 9, wind_from_deg = 90 }, { time_s = 8, rainfall = 0, wind_from_deg = 270 }, { time_s = 20, rainfall = 0 }]",
        "test");
    const auto wall = place.patch_where([](glm::vec3 p, glm::vec3 n) {
        return n.x > 0.9f && p.y > 1.5f && p.y < 2.4f && std::abs(p.z) < 2.0f;
    });
    const auto driven = ArtistPlaces(place.sites, turning, 50.0, 0.0).at(8.0);
    EXPECT_GT(driven->states[wall * PLACE_STATE_TEXELS + 1].z, 0.3f);
    // In the open it is the script itself.
    const auto alone =
        weather::artist_moment(script.solve(), script.timeline, script.sky, 10.0).values;
    const WeatherScript same = script_at_place(script, {});
    const auto again = weather::artist_moment(same.solve(), same.timeline, same.sky, 10.0).values;
    EXPECT_EQ(alone.flood_puddles, again.flood_puddles);
    EXPECT_EQ(alone.film_albedo, again.film_albedo);
    // What is set by hand lies at a place as at a pixel without patches: a fifth of the rain leaves
    // most of the film.
    const WeatherScript set = read_weather_script(
        "[weather]\nkeys = [{ time_s = 0, temperature_c = 12, rainfall = 0, script_controlled = 0, "
        "wetness = 0.9, puddles = 0.5 }]",
        "test");
    const auto fifth = script_at_place(set, {0.2, 1.0, 1.0, 1.0});
    const auto film = weather::artist_moment(fifth.solve(), fifth.timeline, fifth.sky, 10.0).values;
    EXPECT_NEAR(shared::wetness_of_film(film.film_mm), 0.9f * shared::film_share(0.2f), 0.01f);
    EXPECT_NEAR(film.flood_puddles, 0.5f * shared::flood_share(0.2f), 0.02f);
    const WeatherScript dry = script_at_place(script, {0.0, 1.0, 1.0, 1.0});
    EXPECT_EQ(weather::artist_moment(dry.solve(), dry.timeline, dry.sky, 10.0).values.film_albedo,
              0.0f);
}

// Puddles that freeze stay as ice, as without places; hoar keeps off walls and from below roofs.
TEST(ArtistPlaces, KeepIceAndHoarWhereTheyAre)
{
    const Place place;
    const WeatherScript script = read_weather_script(
        "[weather]\nkeys = [{ time_s = 0, temperature_c = 8, rainfall = 0.9 }, { time_s = 14, rainfall = 0.9 }, "
        "{ time_s = 15, temperature_c = 8, rainfall = 0 }, { time_s = 17, temperature_c = -14, rainfall = 0 }, "
        "{ time_s = 40, temperature_c = -14, rainfall = 0 }]",
        "test");
    const auto cold = ArtistPlaces(place.sites, script, 50.0, 0.0).at(36.0);
    const auto of = [&](std::uint32_t patch, int texel) {
        return cold->states[patch * PLACE_STATE_TEXELS + static_cast<std::size_t>(texel)];
    };
    const auto open = place.patch_where([](glm::vec3 p, glm::vec3 n) {
        return n.y > 0.9f && p.y < 0.1f && p.x > 4.0f && p.x < 5.0f && std::abs(p.z) < 3.0f;
    });
    const auto under = place.patch_where([](glm::vec3 p, glm::vec3 n) {
        return n.y > 0.9f && p.y < 0.1f && p.x > -5.4f && p.x < -4.6f && std::abs(p.z) < 3.0f;
    });
    const auto wall = place.patch_where([](glm::vec3 p, glm::vec3 n) {
        return n.x > 0.9f && p.y > 1.5f && p.y < 2.4f && std::abs(p.z) < 2.0f;
    });
    const auto model =
        weather::artist_moment(script.solve(), script.timeline, script.sky, 36.0).values;
    EXPECT_GT(of(open, 0).z, model.flood_puddles + 0.2f) << "ice, which the model itself makes snow of";
    EXPECT_GT(of(open, 1).x, 0.5f);
    EXPECT_EQ(of(wall, 1).x, 0.0f);
    EXPECT_LT(of(under, 1).x, 0.5f * of(open, 1).x);
}

}  // namespace
}  // namespace petrichor::film
