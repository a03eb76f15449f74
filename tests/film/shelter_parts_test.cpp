// Patches cut where a shelter ends, and what stands upwind of them.
#include "film/weather/shelter_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "film/weather/patch_weather.h"
#include "film/weather/upwind.h"
#include "tests/film/rain_table.h"

namespace petrichor::film {
namespace {

void add_quad(scene::Scene& scene, const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v)
{
    scene::Primitive p;
    const glm::vec3 normal = glm::normalize(glm::cross(u, v));
    for (const glm::vec2 at : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
        p.positions.push_back(corner + u * at.x + v * at.y);
        p.normals.push_back(normal);
        p.uv0.push_back(at);
    }
    p.indices = {0, 1, 2, 0, 2, 3};
    p.material = 0;
    scene.meshes.front().primitives.push_back(std::move(p));
}

void add_box(scene::Scene& scene, const glm::vec3& low, const glm::vec3& size)
{
    const glm::vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z), high = low + size;
    add_quad(scene, low, x, z);
    add_quad(scene, low + y, z, x);
    add_quad(scene, low, z, y);
    add_quad(scene, low, y, x);
    add_quad(scene, high, -z, -y);
    add_quad(scene, high, -y, -x);
}

constexpr float kEdge_m = 1.13f;

// Ground of 10 x 10 m with a slab over it, 3 m wide along x and 4 m along z, and a wall in the west.
struct Yard {
    scene::Scene scene;
    std::unique_ptr<scene::Triangles> triangles;
    std::unique_ptr<scene::Tracer> tracer;
    scene::Patches patches;
    SceneSites sites;

    explicit Yard(float slab_m = 2.5f)
    {
        scene::Material m;
        m.name = "asphalt";
        m.base_color = glm::vec4(0.2f, 0.2f, 0.2f, 1.0f);
        m.metallic = 0.0f;
        scene.materials.push_back(m);
        scene.meshes.emplace_back();
        scene.instances.push_back({"yard", 0, glm::mat4(1.0f)});
        add_quad(scene, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
        add_box(scene, {-1.87f, slab_m, -2.03f}, {3.0f, 0.1f, 4.0f});
        add_box(scene, {-4.6f, 0.0f, -5.0f}, {0.2f, 2.0f, 10.0f});
        triangles = std::make_unique<scene::Triangles>(scene, std::vector<scene::AlphaImage>{});
        tracer = std::make_unique<scene::Tracer>(*triangles);
        scene::PatchOptions options;
        options.cell_m = 0.4f;
        options.rays = 64;
        patches = scene::build_patches(*tracer, options);
        const auto surfaces = scene::patch_surfaces(patches, *triangles, {});
        sites = scene_sites(scene, patches, *tracer, surfaces, {}, weather::surface_preset("asphalt"));
    }
};

// Metres inside of the slab's outline, seen from above; below 0 outside.
float within_m(const glm::vec3& at)
{
    return std::min({at.x + 1.87f, kEdge_m - at.x, at.z + 2.03f, 1.97f - at.z});
}

TEST(ShelterParts, LieOnBothSidesOfTheEdgeAndAddUpToTheirPatch)
{
    const Yard yard;
    const ShelterParts& shelter = yard.sites.shelter;
    const weather::PatchSet& set = yard.sites.set;
    ASSERT_GE(shelter.cuts.size(), 12u);
    double area = 0.0, cut_area = 0.0;
    for (const weather::WeatherPatch& p : set.patches) area += p.area_m2;
    for (std::uint32_t i = 0; i < yard.patches.count; ++i) cut_area += static_cast<double>(yard.patches.area_m2[i]);
    EXPECT_NEAR(area, cut_area, 1e-4 * area);
    EXPECT_LT(static_cast<double>(set.patches.size()), 1.2 * yard.patches.count);
    std::size_t ground = 0;
    for (const ShelterParts::Cut& cut : shelter.cuts) {
        const std::uint32_t patch = cut.parts.patch;
        if (yard.patches.position_m[patch].y > 0.1f) continue;
        ++ground;
        double parts_m2 = 0.0;
        for (std::uint32_t part = 0; part < cut.parts.count; ++part) {
            const std::uint32_t number = cut.weather_patch(part);
            parts_m2 += set.patches[number].area_m2;
            EXPECT_EQ(shelter.of[number], patch);
        }
        EXPECT_NEAR(parts_m2, static_cast<double>(yard.patches.area_m2[patch]), 1e-5);
        // The first has the sky over it, the last has not; the line is that of the slab.
        const std::uint32_t last = cut.weather_patch(cut.parts.count - 1);
        EXPECT_LT(within_m(shelter.position_m[patch]), 0.02f);
        EXPECT_GT(within_m(shelter.position_m[last]), -0.02f);
        EXPECT_GT(set.patches[patch].sky_share, set.patches[last].sky_share);
    }
    EXPECT_GE(ground, 12u);
}

TEST(ShelterParts, DrawTheLineBelowAnEdgeInRain)
{
    // As low as a bench: bits of directions are 7 degrees apart, a hand's width at that height.
    const Yard yard(0.5f);
    // A shower of a tenth of a millimetre in a calm.
    auto rain = rain_table(6, 0.0, 0.0, 0.0);
    rain[weather::Field::Precip][3] = 0.4 / 3600.0;
    weather::PatchParams params;
    PlaceWeatherOfFile run(yard.sites, rain, params, rain.time_us.front());
    const auto place = run.at(rain.time_us[4]);
    const weather::PatchLedger books = run.sums().books;
    EXPECT_GT(books.fallen, 0.0);
    EXPECT_LE(std::abs(books.residual()), 1e-9 * books.fallen);
    const auto parts = gpu::parts_of(place->shape->table, place->shape->grid);
    ASSERT_EQ(parts.size(), yard.sites.shelter.cuts.size());
    ASSERT_EQ(place->states.size(), (yard.patches.count + gpu::count_of_parts(parts)) * PLACE_STATE_TEXELS);
    const auto rain_share = [&](std::size_t number) { return place->states[number * PLACE_STATE_TEXELS + 1].z; };
    std::size_t lines = 0;
    float outside = 0.0f, below = 0.0f;
    for (const gpu::PlaceParts& one : parts) {
        if (yard.patches.position_m[one.patch].y > 0.1f) continue;
        const std::size_t first = yard.patches.count + one.first;
        ASSERT_EQ(one.count, 2u);
        outside += rain_share(first);
        below += rain_share(first + 1);
        EXPECT_GT(rain_share(first), rain_share(first + 1) + 0.2f);
        ++lines;
        // The patch itself is their mean by area.
        double sum = 0.0, area = 0.0;
        for (std::uint32_t part = 0; part < one.count; ++part) {
            const double own = yard.sites.set.patches[yard.sites.shelter.cuts[static_cast<std::size_t>(&one - parts.data())].weather_patch(part)].area_m2;
            sum += own * static_cast<double>(place->states[(first + part) * PLACE_STATE_TEXELS + 2].x);
            area += own;
        }
        EXPECT_NEAR(static_cast<double>(place->states[one.patch * PLACE_STATE_TEXELS + 2].x), sum / area, 1e-5);
    }
    ASSERT_GE(lines, 12u);
    EXPECT_GT(outside / static_cast<float>(lines), 0.75f);
    EXPECT_LT(below / static_cast<float>(lines), 0.25f);
}

TEST(ShelterParts, OpenGroundIsCutNowhere)
{
    scene::Scene scene;
    scene.materials.emplace_back();
    scene.meshes.emplace_back();
    scene.instances.push_back({"plain", 0, glm::mat4(1.0f)});
    add_quad(scene, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
    const scene::Triangles triangles(scene, {});
    const scene::Tracer tracer(triangles);
    scene::PatchOptions options;
    options.rays = 64;
    const scene::Patches patches = scene::build_patches(tracer, options);
    const auto surfaces = scene::patch_surfaces(patches, triangles, {});
    const SceneSites sites = scene_sites(scene, patches, tracer, surfaces, {}, weather::surface_preset("asphalt"));
    EXPECT_TRUE(sites.shelter.cuts.empty());
    EXPECT_EQ(sites.set.patches.size(), patches.count);
    EXPECT_EQ(sites.shape->table.size(), patches.table.size());
}

TEST(Upwind, IsTheWallThatStandsThere)
{
    Yard yard;
    find_upwind(yard.sites.set, yard.sites.shelter.position_m, *yard.tracer);
    ASSERT_EQ(yard.sites.set.upwind.size(), yard.sites.set.patches.size());
    std::size_t asked = 0;
    for (std::size_t i = 0; i < yard.sites.set.patches.size(); ++i) {
        const glm::vec3 at = yard.sites.shelter.position_m[i];
        if (yard.sites.set.patches[i].normal.y < 0.9 || at.y > 0.1f || at.x < -4.2f || at.x > -2.5f || std::abs(at.z) > 4.0f) continue;
        const weather::Upwind west = yard.sites.set.upwind[i][12], east = yard.sites.set.upwind[i][4];
        EXPECT_NEAR(west.distance_m, at.x + 4.4f, 0.02f);
        EXPECT_GT(west.height_m, 1.5f);
        EXPECT_LT(west.height_m, 2.5f);
        EXPECT_TRUE(std::isinf(east.distance_m));
        ++asked;
    }
    EXPECT_GE(asked, 20u);
}

TEST(Upwind, IsAskedWhereWindMayCarrySnow)
{
    auto table = rain_table(6, 0.0, 0.0, 0.0);
    EXPECT_FALSE(wind_may_carry_snow(table));
    table[weather::Field::Wind][2] = 12.0;
    table[weather::Field::AirTemp][2] = 268.0;
    EXPECT_TRUE(wind_may_carry_snow(table));
    table[weather::Field::AirTemp][2] = 285.0;
    EXPECT_FALSE(wind_may_carry_snow(table));
}

}  // namespace
}  // namespace petrichor::film
