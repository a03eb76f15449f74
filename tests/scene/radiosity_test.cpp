// Light over links: furnace, white sky, energy, sources that add up, glow, lookup.
#include "scene/patches/radiosity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "base/error.h"
#include "formulas/light/near_light.h"
#include "scene/patches/lookup.h"
#include "scene/patches/patch_file.h"
#include "tests/scene/patch_scenes.h"

namespace petrichor::scene {
namespace {

using namespace patch_scenes;
constexpr float kPi = std::numbers::pi_v<float>;

struct Cut {
    explicit Cut(const Scene& made, int rays = 64, float cell_m = 0.5f)
        : scene(made), triangles(scene, {}), tracer(triangles)
    {
        PatchOptions options;
        options.cell_m = cell_m;
        options.rays = rays;
        patches = build_patches(tracer, options);
    }
    Scene scene;
    Triangles triangles;
    Tracer tracer;
    Patches patches;
};

struct Lights {
    explicit Lights(const Patches& p, glm::vec3 rho = glm::vec3(0.0f))
        : albedo(p.count, rho),
          direct(p.count, glm::vec3(0.0f)),
          emission(p.count, glm::vec3(0.0f)),
          sky(shared::kSkyBins, glm::vec3(0.0f))
    {
    }
    Relight input(int bounces) const
    {
        Relight r;
        r.albedo = albedo;
        r.direct = direct;
        r.emission = emission;
        r.sky = sky;
        r.bounces = bounces;
        return r;
    }
    std::vector<glm::vec3> albedo, direct, emission, sky;
};

TEST(Radiosity, AFurnaceHoldsOneOverOneMinusAlbedo)
{
    const Cut cut(room());
    Lights lights(cut.patches, glm::vec3(0.8f));
    lights.emission.assign(cut.patches.count, glm::vec3(1.0f));
    const PatchIrradiance lit = relight(cut.patches, lights.input(100));
    for (std::uint32_t i = 0; i < cut.patches.count; ++i) {
        ASSERT_NEAR(lit.radiosity[i].x, 5.0f, 5e-6f);
        ASSERT_NEAR(lit.irradiance[i].x, 5.0f, 5e-6f);
    }
}

TEST(Radiosity, AWhiteSkyGivesItsShare)
{
    Scene scene = empty_scene();
    add_face(scene, {-6, 0, -6}, {0, 0, 12}, {12, 0, 0});
    add_box(scene, {-1, 0, -1}, {1, 3, 1}, false);
    const Cut cut(scene);
    Lights lights(cut.patches);
    lights.sky.assign(shared::kSkyBins, glm::vec3(kPi));
    const PatchIrradiance lit = relight(cut.patches, lights.input(3));
    for (std::uint32_t i = 0; i < cut.patches.count; ++i) {
        int sky = 0;
        for (int r = 0; r < cut.patches.rays; ++r)
            sky += cut.patches.row(i)[r] >= cut.patches.count &&
                           cut.patches.row(i)[r] < cut.patches.black()
                       ? 1
                       : 0;
        EXPECT_NEAR(lit.irradiance[i].x,
                    kPi * static_cast<float>(sky) / static_cast<float>(cut.patches.rays), 1e-5f);
    }
}

// k bounces lose at most albedo^(k+1) of what all would give.
TEST(Radiosity, BouncesLoseNoMoreThanTheirPower)
{
    const Cut cut(room());
    Lights lights(cut.patches, glm::vec3(0.6f));
    lights.emission.assign(cut.patches.count, glm::vec3(1.0f));
    double before = 0.0;
    for (const int bounces : {0, 1, 2, 3, 5, 8}) {
        const PatchIrradiance lit = relight(cut.patches, lights.input(bounces));
        double sum = 0.0, area = 0.0;
        for (std::uint32_t i = 0; i < cut.patches.count; ++i) {
            sum += static_cast<double>(lit.radiosity[i].x * cut.patches.area_m2[i]);
            area += static_cast<double>(cut.patches.area_m2[i]);
        }
        const double mean = sum / area, all = 2.5;
        EXPECT_GT(mean, before);
        EXPECT_LE(mean, all * (1.0 + 1e-5));
        EXPECT_GE(mean, all * (1.0 - std::pow(0.6, bounces + 1)) - 1e-5);
        before = mean;
    }
}

TEST(Radiosity, SourcesAddUp)
{
    const Cut cut(room());
    Lights a(cut.patches, glm::vec3(0.5f)), b = a, both = a;
    for (std::uint32_t i = 0; i < cut.patches.count; ++i) {
        a.direct[i] = glm::vec3(static_cast<float>(i % 7), 0, 1);
        b.emission[i] = glm::vec3(static_cast<float>(i % 5), 2, 0);
        both.direct[i] = a.direct[i];
        both.emission[i] = b.emission[i];
    }
    const auto la = relight(cut.patches, a.input(3)), lb = relight(cut.patches, b.input(3)),
               lboth = relight(cut.patches, both.input(3));
    for (std::uint32_t i = 0; i < cut.patches.nodes(); ++i) {
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(lboth.irradiance[i][c], la.irradiance[i][c] + lb.irradiance[i][c], 2e-5f);
    }
}

// A sheet of a tenth of a square metre, lit, 3 m over a wide floor: a cell of that meets it with one ray in a hundred or none.
TEST(Radiosity, WhatASmallSheetSendsToWideCellsIsKnownByItsOwnRays)
{
    Scene scene = empty_scene();
    add_face(scene, {-12, 0, -12}, {0, 0, 24}, {24, 0, 0});
    const glm::vec3 corner(-0.15f, 3.0f, -0.15f), u(0.3f, 0, 0), v(0, 0, 0.3f);
    add_face(scene, corner, u, v);
    const Cut cut(scene, 128, 0.35f);
    const Patches& p = cut.patches;
    Lights lights(p, glm::vec3(0.5f));
    for (std::uint32_t i = 0; i < p.count; ++i)
        if (p.normal[i].y < -0.5f) lights.direct[i] = glm::vec3(2.0f);
    const PatchIrradiance lit = relight(p, lights.input(0));
    double square = 0.0, square_by_rows = 0.0, sum = 0.0, all = 0.0, wanted_all = 0.0;
    int wide = 0;
    for (std::uint32_t i = 0; i < p.count; ++i) {
        if (p.normal[i].y < 0.5f || level_of(p.key[i]) < 2 || glm::length(p.position_m[i]) > 6.0f) continue;
        const glm::vec3 x = p.position_m[i];
        const float wanted = shared::near_form_factor(corner - x, corner + u - x, corner + u + v - x, corner + v - x, {0, 1, 0});
        int met = 0;
        for (int r = 0; r < p.rays; ++r) {
            const std::uint32_t j = p.row(i)[r];
            met += j < p.count && p.normal[j].y < -0.5f ? 1 : 0;
        }
        square += std::pow(static_cast<double>(lit.irradiance[i].x - wanted), 2.0);
        square_by_rows += std::pow(static_cast<double>(static_cast<float>(met) / static_cast<float>(p.rays) - wanted), 2.0);
        sum += static_cast<double>(wanted);
        all += static_cast<double>(lit.irradiance[i].x * p.area_m2[i]);
        wanted_all += static_cast<double>(wanted * p.area_m2[i]);
        ++wide;
    }
    ASSERT_GT(wide, 30);
    EXPECT_LT(square, 0.3 * square_by_rows);
    EXPECT_LT(std::sqrt(square / wide), 0.8 * sum / wide);
    EXPECT_NEAR(all, wanted_all, 0.1 * wanted_all);
}

TEST(Radiosity, AlbedoOfOneStaysFinite)
{
    const Cut cut(room(), 32);
    Lights lights(cut.patches, glm::vec3(1.5f));
    lights.emission.assign(cut.patches.count, glm::vec3(1.0f));
    const auto lit = relight(cut.patches, lights.input(64));
    EXPECT_LT(lit.radiosity[0].x, 50.0f);
}

TEST(Radiosity, TheSameBytesForAnyNumberOfThreads)
{
    const Cut cut(room());
    Lights lights(cut.patches, glm::vec3(0.5f, 0.6f, 0.7f));
    for (std::uint32_t i = 0; i < cut.patches.count; ++i)
        lights.direct[i] = glm::vec3(static_cast<float>(i * 37 % 101));
    Relight input = lights.input(3);
    input.threads = 1;
    const auto one = relight(cut.patches, input);
    const StandingLinks known = standing_links(cut.patches);
    for (const int threads : {2, 5}) {
        input.threads = threads;
        input.standing = threads == 5 ? &known : nullptr;
        const auto more = relight(cut.patches, input);
        EXPECT_EQ(std::memcmp(one.irradiance.data(), more.irradiance.data(),
                              one.irradiance.size() * sizeof(glm::vec4)),
                  0);
        EXPECT_EQ(std::memcmp(one.gradient.data(), more.gradient.data(),
                              one.gradient.size() * sizeof(glm::vec4)),
                  0);
    }
}

// The sun over a wall: only what it sees, by the cosine.
TEST(Radiosity, SunFallsByCosineOnWhatItSees)
{
    Scene scene = empty_scene();
    add_face(scene, {-6, 0, -6}, {0, 0, 12}, {12, 0, 0});
    const Cut cut(scene);
    std::vector<glm::vec3> direct(cut.patches.count, glm::vec3(0.0f));
    const glm::vec3 sun = glm::normalize(glm::vec3(1, 2, 0.5f));
    add_sun(cut.patches, sun, glm::vec3(1000.0f, 900.0f, 800.0f), direct);
    for (const glm::vec3& d : direct) {
        EXPECT_NEAR(d.x, 1000.0f * sun.y, 0.1f);
        EXPECT_NEAR(d.z, 800.0f * sun.y, 0.1f);
    }
    add_sun(cut.patches, -sun, glm::vec3(1000.0f), direct);
    EXPECT_NEAR(direct[0].x, 1000.0f * sun.y, 0.1f) << "a sun below the horizon adds nothing";
}

TEST(Radiosity, ALampReachesWhatItSees)
{
    Scene scene = empty_scene();
    add_face(scene, {-6, 0, -6}, {0, 0, 12}, {12, 0, 0});
    add_box(scene, {-0.1f, 0, -6}, {0.1f, 4, 6}, false);
    const Cut cut(scene);
    const auto reached = trace_lamp(cut.patches, cut.tracer, {3, 2, 0}, 20.0f);
    const auto at = [&](glm::vec3 x) {
        const auto patch = patch_at(cut.patches, x, {0, 1, 0});
        return static_cast<int>(reached[patch.value()]);
    };
    EXPECT_EQ(at({3, 0, 1}), 255);
    EXPECT_EQ(at({-3, 0, 1}), 0);
    const auto near = trace_lamp(cut.patches, cut.tracer, {3, 2, 0}, 2.5f);
    EXPECT_EQ(static_cast<int>(near[patch_at(cut.patches, {3, 0, 5}, {0, 1, 0}).value()]), 0);
}

// A small bright square 1 m above a floor: pairs find its form factor, rows are luck.
TEST(Radiosity, AGlowingWindowIsLinkedByPairs)
{
    Scene scene = empty_scene();
    add_face(scene, {-3, 0, -3}, {0, 0, 6}, {6, 0, 0});
    Material lamp;
    lamp.emissive = glm::vec3(1.0f);
    const std::size_t window = add_material(scene, lamp);
    add_face(scene, {-0.05f, 1, -0.05f}, {0.1f, 0, 0}, {0, 0, 0.1f}, window);  // faces down
    const Cut cut(scene, 64, 0.2f);
    std::vector<std::uint32_t> senders;
    Lights lights(cut.patches);
    double area = 0.0;
    for (std::uint32_t i = 0; i < cut.patches.count; ++i) {
        if (cut.patches.material[i] != 1) continue;
        senders.push_back(i);
        lights.emission[i] = glm::vec3(1000.0f);
        area += static_cast<double>(cut.patches.area_m2[i]);
    }
    EXPECT_NEAR(area, 0.01, 0.002);
    const GlowLinks glow = trace_glow(cut.patches, cut.tracer, senders);
    Relight input = lights.input(0);
    input.glow = &glow;
    const auto lit = relight(cut.patches, input);
    for (const float x : {0.0f, 0.5f, 1.0f}) {
        const auto patch = patch_at(cut.patches, {x, 0, 0}, {0, 1, 0});
        const glm::vec3 c = cut.patches.position_m[patch.value()];
        const double r2 = static_cast<double>(c.x * c.x + c.z * c.z) + 1.0;
        const double expected = 1000.0 * 0.01 / (std::numbers::pi * r2 * r2);
        EXPECT_NEAR(static_cast<double>(lit.irradiance[*patch].x), expected, 0.25 * expected) << x;
    }
}

// A glow that a ray in a hundred meets, low over the horizon: a patch has what its open sky sends, not what its rays
// chance to meet.
TEST(Radiosity, ASmallGlowFallsOnAllOpenPatchesAlike)
{
    Scene scene = empty_scene();
    add_face(scene, {-6, 0, -6}, {0, 0, 12}, {12, 0, 0});
    add_box(scene, {-0.4f, 0, -0.4f}, {0.4f, 1, 0.4f}, false);
    const Cut cut(scene, 128);
    Lights lights(cut.patches);
    std::vector<SkyTexel> above(shared::kVisibilityTexels);
    float expected = 0.0f;
    for (int t = 0; t < shared::kVisibilityTexels; ++t) {
        const glm::vec3 d = glm::normalize(shared::visibility_raw_direction(t));
        const bool glow = d.y < 0.12f && d.x > 0.9f;
        above[static_cast<std::size_t>(t)] = {glm::vec3(kPi * (glow ? 80.0f : 0.5f)), d};
        expected += (glow ? 80.0f : 0.5f) * d.y * shared::visibility_solid_angle(t);
    }
    for (int bin = 0; bin < shared::kSkyBins; ++bin) {
        const glm::vec3 d = shared::sky_bin_direction(bin);
        lights.sky[static_cast<std::size_t>(bin)] =
            glm::vec3(d.y <= 0.0f ? 0.0f : kPi * (d.y < 0.12f && d.x > 0.9f ? 80.0f : 0.5f));
    }
    Relight input = lights.input(0);
    input.sky_above = above;
    const auto lit = relight(cut.patches, input);
    int open = 0;
    for (std::uint32_t i = 0; i < cut.patches.count; ++i) {
        if (cut.patches.normal[i].y < 0.99f || cut.patches.position_m[i].y > 0.5f) continue;
        // On the side of the glow, where the box hides nothing of it, and next to nothing of the rest.
        if (cut.patches.position_m[i].x < 0.6f || cut.patches.sky_view[i] < 0.999f) continue;
        ++open;
        EXPECT_NEAR(lit.irradiance[i].x, expected, 0.02f * expected);
    }
    EXPECT_GT(open, 50);
    // In the box's shadow from the glow there is only the rest of the sky.
    float darkest = expected;
    for (std::uint32_t i = 0; i < cut.patches.count; ++i) {
        const glm::vec3 x = cut.patches.position_m[i];
        if (cut.patches.normal[i].y > 0.99f && x.y < 0.5f && x.x < -0.45f && x.x > -0.9f && std::abs(x.z) < 0.2f)
            darkest = std::min(darkest, lit.irradiance[i].x);
    }
    EXPECT_LT(darkest, 0.6f * expected);
}

TEST(PatchCells, ARayIsInABinOfItsSideOfTheHorizon)
{
    for (int k = 0; k < 20000; ++k) {
        const float turn = 0.0007f * static_cast<float>(k), y = 0.4f * std::sin(0.37f * static_cast<float>(k));
        const glm::vec3 d = glm::normalize(glm::vec3(std::cos(turn), y * y * y, std::sin(turn)));
        const int bin = shared::sky_bin_left(d);
        ASSERT_TRUE(bin >= 0 && bin < shared::kSkyBins);
        EXPECT_EQ(shared::sky_bin_above(bin), d.y > 0.0f) << d.x << " " << d.y << " " << d.z;
        EXPECT_EQ(shared::sky_bin_direction(bin).y > 0.0f, d.y > 0.0f);
        EXPECT_GT(glm::dot(shared::sky_bin_direction(bin), d), 0.98f) << "and near it";
    }
}

TEST(PatchCells, TexelsOfTheSkyAddUpToTheHemisphere)
{
    double solid = 0.0, up = 0.0;
    const float step = 2.0f / static_cast<float>(shared::kVisibilityAcross * 4);
    for (int t = 0; t < shared::kVisibilityTexels; ++t) {
        for (int s = 0; s < shared::kSkySubsamples; ++s) {
            const glm::vec4 d = shared::visibility_subsample(t, s);
            const double area = static_cast<double>(0.5f * step * step * d.w);
            solid += area;
            up += area * static_cast<double>(d.y);
        }
    }
    EXPECT_NEAR(solid, 2.0 * std::numbers::pi, 1e-5);
    EXPECT_NEAR(up, std::numbers::pi, 1e-4);
}

// Radiance a + b . w has a closed form for any normal.
TEST(Radiosity, TheGradientTurnsIrradianceAsALinearSkyDoes)
{
    Scene scene = empty_scene();
    add_face(scene, {-6, 0, -6}, {0, 0, 12}, {12, 0, 0});
    const Cut cut(scene, 128);
    Lights lights(cut.patches);
    const glm::vec3 b{0.5f, 0.2f, -0.3f};
    for (int bin = 0; bin < shared::kSkyBins; ++bin) {
        const float radiance = 1.0f + glm::dot(b, shared::sky_bin_direction(bin));
        lights.sky[static_cast<std::size_t>(bin)] = glm::vec3(kPi * radiance);
    }
    const auto lit = relight(cut.patches, lights.input(0));
    const glm::vec3 up{0, 1, 0};
    const float e = kPi + 2.0f * kPi / 3.0f * b.y;
    glm::vec3 mean(0.0f);
    for (std::uint32_t i = 0; i < cut.patches.count; ++i) {
        EXPECT_NEAR(lit.irradiance[i].x, e, 0.03f * e);
        mean += glm::vec3(lit.gradient[i]) / static_cast<float>(cut.patches.count);
    }
    const glm::vec3 expected = b * (2.0f * kPi / 3.0f / e);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(mean[k], expected[k], 0.03f);
    EXPECT_EQ(shared::irradiance_towards(mean, up, up), 1.0f);
    const glm::vec3 bent = glm::normalize(glm::vec3(0.4f, 1.0f, 0.0f));
    EXPECT_GT(shared::irradiance_towards(mean, up, bent),
              shared::irradiance_towards(mean, up, glm::vec3(-bent.x, bent.y, bent.z)));
}

struct Looked {
    explicit Looked(const Cut& cut, const PatchIrradiance& light)
        : ways(lookup_ways(cut.patches)),
          planes(lookup_planes(cut.patches)),
          lit{ways.table, ways.ways, planes, light.irradiance, light.gradient, ways.grid}
    {
    }
    LookupWays ways;
    std::vector<glm::vec4> planes;
    LitPatches lit;
};

TEST(PatchLookup, AConstantStaysConstantEverywhere)
{
    Scene scene = room();
    add_box(scene, {1, 0, 1}, {1.7f, 1.3f, 1.9f}, false);
    const Cut cut(scene);
    PatchIrradiance light;
    light.irradiance.assign(cut.patches.nodes(), glm::vec4(3.0f, 2.0f, 1.0f, 0.5f));
    light.gradient.resize(cut.patches.nodes());
    const auto sizes = lookup_sizes(cut.patches);
    for (std::uint32_t i = 0; i < cut.patches.nodes(); ++i)
        light.gradient[i] = glm::vec4(0.1f, 0.2f, 0.3f, sizes[i]);
    const Looked looked(cut, light);
    int fallbacks = 0;
    for (std::uint32_t t = 0; t < cut.triangles.size(); ++t) {
        for (int k = 0; k < 100; ++k) {
            const float u = static_cast<float>(k % 10) * 0.0999f, v = static_cast<float>(k / 10) * 0.0999f;
            if (u + v >= 1.0f) continue;
            const glm::vec3 x = cut.triangles.point(t, {u, v});
            // What is below the box is buried.
            if (x.y < 1e-3f && x.x > 0.9f && x.x < 1.8f && x.z > 0.9f && x.z < 2.0f) continue;
            const auto found = light_at(looked.lit, x, cut.triangles.normal(t));
            ASSERT_GT(found.weight, 0.0f) << x.x << " " << x.y << " " << x.z;
            fallbacks += glm::dot(found.normal, cut.triangles.normal(t)) < 0.5f ? 1 : 0;
            EXPECT_NEAR(found.irradiance.x, 3.0f, 1e-4f);
            EXPECT_NEAR(found.irradiance.z, 1.0f, 1e-4f);
            EXPECT_NEAR(found.open, 0.5f, 1e-4f);
        }
    }
    EXPECT_EQ(fallbacks, 0);
}

// Deep snow over small cells: its surface is in none of them, or in those of what hangs in the air.
TEST(PatchLookup, SnowHasTheLightOfTheGroundBelowIt)
{
    Scene scene = empty_scene();
    add_face(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
    add_face(scene, {-0.3f, 0.9f, -0.3f}, {0.1f, 0.3f, 0.6f}, {0.6f, 0.2f, 0});  // a leaf over it
    const Cut cut(scene, 32, 0.05f);
    PatchIrradiance light;
    light.irradiance.assign(cut.patches.nodes(), glm::vec4(9.0f));
    light.gradient.assign(cut.patches.nodes(), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    for (std::uint32_t i = 0; i < cut.patches.count; ++i) {
        if (std::abs(cut.patches.normal[i].y) > 0.999f) light.irradiance[i] = glm::vec4(2.0f);
    }
    const Looked looked(cut, light);
    const glm::vec3 up(0, 1, 0);
    int elsewhere = 0;
    for (int k = 0; k < 40; ++k) {
        const glm::vec3 x(-0.8f + 0.04f * static_cast<float>(k), 0.2f + 0.005f * static_cast<float>(k), 0.31f);
        const auto found = light_at(looked.lit, x, glm::normalize(glm::vec3(0.2f, 1.0f, 0.1f)), 0.5f);
        ASSERT_GT(found.weight, 0.0f) << k;
        EXPECT_NEAR(found.irradiance.x, 2.0f, 1e-4f) << k;
        const auto without = light_at(looked.lit, x, up);
        elsewhere += without.weight > 0.0f && std::abs(without.irradiance.x - 2.0f) < 1e-4f ? 0 : 1;
    }
    EXPECT_GT(elsewhere, 30) << "which it would not find";
    // Not from so far below that no snow lies so deep.
    EXPECT_EQ(light_at(looked.lit, {-0.8f, 40.0f, 0.31f}, up, 0.5f).weight, 0.0f);
}

TEST(PatchLookup, GroundAroundAThingHasNoSquareOfOtherLight)
{
    // Cells are fine around it and coarse beyond: from fine to coarse the light goes on as it lies there.
    Scene scene = empty_scene();
    for (int i = 0; i < 25; ++i) {
        const glm::vec3 at(0.45f * static_cast<float>(i % 5 - 2), 0.001f, 0.45f * static_cast<float>(i / 5 - 2));
        add_box(scene, at - glm::vec3(0.1f, 0.0f, 0.1f), at + glm::vec3(0.1f, 0.4f, 0.1f), false);
    }
    Scene ground = empty_scene();
    for (int i = 0; i < 256; ++i) {
        const float x = static_cast<float>(i % 16) - 8.0f, z = static_cast<float>(i / 16) - 8.0f;
        add_face(ground, {x, 0, z}, {0, 0, 1}, {1, 0, 0});
    }
    scene.meshes.push_back(ground.meshes[0]);
    scene.instances.push_back({});
    scene.instances.back().mesh = 1;
    scene.instances.back().backdrop = true;
    const Cut cut(scene, 32, 0.0f);
    // Dark around the middle.
    const auto there = [](glm::vec3 x) {
        return 1.0f - 0.8f * std::exp(-glm::dot(glm::vec2(x.x, x.z), glm::vec2(x.x, x.z)) / 0.25f);
    };
    std::vector<glm::vec4> leaves;
    int coarsest = 0;
    for (std::uint32_t i = 0; i < cut.patches.count; ++i) {
        leaves.emplace_back(there(cut.patches.position_m[i]));
        coarsest = std::max(coarsest, level_of(cut.patches.key[i]));
    }
    ASSERT_GE(coarsest, 3);
    PatchIrradiance light;
    light.irradiance = with_interior(cut.patches, leaves);
    light.gradient.assign(cut.patches.nodes(), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    const Looked looked(cut, light);
    for (int turn = 0; turn < 8; ++turn) {
        const float angle = 0.3f + 0.785398f * static_cast<float>(turn);
        float before = 0.0f;
        for (float r = 1.05f; r < 2.5f; r += 0.005f) {
            const glm::vec3 x(r * std::cos(angle), 0.0f, r * std::sin(angle));
            const float found = light_at(looked.lit, x, {0, 1, 0}).irradiance.x;
            EXPECT_NEAR(found, there(x), 0.06f) << turn << " " << r;
            if (before > 0.0f) {
                EXPECT_NEAR(found, before, 0.02f) << turn << " " << r;
            }
            before = found;
        }
    }
}

TEST(PatchLookup, FarFromEverythingHasNoWeight)
{
    const Cut cut(room(), 32);
    PatchIrradiance light;
    light.irradiance.assign(cut.patches.nodes(), glm::vec4(1.0f));
    light.gradient.assign(cut.patches.nodes(), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    const Looked looked(cut, light);
    EXPECT_EQ(light_at(looked.lit, {500, 3, 200}, {0, 1, 0}).weight, 0.0f);
}

// A closed room under a bright sky: what leaks through walls of this thickness (reference 4: .006
// at 2 cm, .0009 at 10 cm, .0008 at 20 cm; how walls fall on cells decides).
struct WallCase {
    float thickness_m;
    double most;
};
class RoomLeak : public testing::TestWithParam<WallCase> {};
TEST_P(RoomLeak, IsSmall)
{
    const float w = GetParam().thickness_m;
    Scene scene = empty_scene();
    add_face(scene, {-12, 0, -12}, {0, 0, 24}, {24, 0, 0});
    const glm::vec3 low{-2.1f, 0.0f, -2.1f}, high{2.1f, 3.0f, 2.1f};
    add_box(scene, low - glm::vec3(w, 0, w), high + glm::vec3(w), false);
    // Walls and ceiling from within; the floor is the ground.
    add_box(scene, low - glm::vec3(0, 1, 0), high, true);
    const Cut cut(scene, 128, 0.35f);
    Lights lights(cut.patches, glm::vec3(0.5f));
    lights.sky.assign(shared::kSkyBins, glm::vec3(kPi));
    for (int bin = 0; bin < shared::kSkyBins; ++bin) {
        if (shared::sky_bin_direction(bin).y < 0.0f)
            lights.sky[static_cast<std::size_t>(bin)] = glm::vec3(0.0f);
    }
    const auto light = relight(cut.patches, lights.input(3));
    const Looked looked(cut, light);
    double sum = 0.0;
    int points = 0;
    for (float x = -2.05f; x < 2.06f; x += 0.1f) {
        for (float z = -2.05f; z < 2.06f; z += 0.1f) {
            sum += static_cast<double>(light_at(looked.lit, {x, 0, z}, {0, 1, 0}).irradiance.x);
            sum += static_cast<double>(light_at(looked.lit, {x, 3, z}, {0, -1, 0}).irradiance.x);
            points += 2;
        }
    }
    EXPECT_LT(sum / points / std::numbers::pi, GetParam().most);
}
INSTANTIATE_TEST_SUITE_P(Walls, RoomLeak,
                         testing::Values(WallCase{0.02f, 0.04}, WallCase{0.1f, 0.02},
                                         WallCase{0.2f, 0.02}),
                         [](const auto& test) {
                             return "cm" + std::to_string(static_cast<int>(
                                               test.param.thickness_m * 100.0f + 0.5f));
                         });

TEST(PatchFile, ComesBackBitForBit)
{
    const Cut cut(room());
    const auto bytes = patches_to_bytes(cut.patches);
    const Patches back = patches_from_bytes(bytes, cut.triangles.size());
    EXPECT_EQ(patches_to_bytes(back), bytes);
    EXPECT_EQ(back.links, cut.patches.links);
    EXPECT_EQ(back.children, cut.patches.children);
    ASSERT_EQ(back.table.size(), cut.patches.table.size());
    for (std::size_t i = 0; i < back.table.size(); ++i) ASSERT_EQ(back.table[i], cut.patches.table[i]);
    EXPECT_EQ(std::memcmp(back.visible.data(), cut.patches.visible.data(),
                          back.visible.size() * sizeof back.visible[0]),
              0);
}

TEST(PatchFile, DamageIsRefused)
{
    const Cut cut(room(), 16);
    const auto bytes = patches_to_bytes(cut.patches);
    const std::uint32_t triangles = cut.triangles.size();
    EXPECT_THROW(patches_from_bytes({}, triangles), Error);
    for (const std::size_t cutoff : {std::size_t{10}, bytes.size() / 2, bytes.size() - 1})
        EXPECT_THROW(patches_from_bytes(std::span(bytes).first(cutoff), triangles), Error);
    for (std::size_t at = 0; at < bytes.size(); at += 997) {
        auto damaged = bytes;
        damaged[at] ^= std::byte{0x10};
        EXPECT_THROW(patches_from_bytes(damaged, triangles), Error) << "byte " << at;
    }
    EXPECT_THROW(patches_from_bytes(bytes, 3), Error) << "another scene";
    auto longer = bytes;
    longer.push_back(std::byte{0});
    EXPECT_THROW(patches_from_bytes(longer, triangles), Error);
}

TEST(PatchFile, TheFingerprintHoldsWhatDecides)
{
    PatchOptions options;
    const std::string first = patches_fingerprint("scene", options);
    EXPECT_NE(patches_fingerprint("other", options), first);
    options.threads = 7;
    EXPECT_EQ(patches_fingerprint("scene", options), first);
    options.rays = 64;
    EXPECT_NE(patches_fingerprint("scene", options), first);
}

}  // namespace
}  // namespace petrichor::scene
