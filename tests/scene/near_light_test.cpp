// Light of what stands closer to a patch than it is wide: closed forms, a furnace, a sunlit sill.
#include "scene/patches/near_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "formulas/light/near_light.h"
#include "scene/patches/detail/near_choice.h"
#include "scene/patches/detail/near_faces.h"
#include "scene/patches/detail/near_four.h"
#include "scene/patches/detail/near_sources.h"
#include "scene/patches/detail/sampling.h"
#include "scene/patches/lamps.h"
#include "scene/patches/lookup.h"
#include "scene/patches/radiosity.h"
#include "scene/patches/surfaces.h"
#include "tests/scene/patch_scenes.h"

namespace petrichor::scene {
namespace {

using namespace patch_scenes;
constexpr float kPi = std::numbers::pi_v<float>;

// A corner of a square of 2b x 2b at distance 1 over the foot of its middle: four times a quarter's.
float square_over_point(float b)
{
    const float r = std::sqrt(1.0f + b * b);
    return 4.0f / (2.0f * kPi) * 2.0f * (b / r) * std::atan(b / r);
}

TEST(NearFormFactor, OfASquareAboveIsTheClosedForm)
{
    for (const float b : {0.05f, 0.5f, 2.0f, 40.0f}) {
        // Seen from below: it faces down.
        const float found = shared::near_form_factor({-b, 1, -b}, {b, 1, -b}, {b, 1, b}, {-b, 1, b},
                                                     {0, 1, 0});
        EXPECT_NEAR(found, square_over_point(b), 3e-4f) << b;
        EXPECT_EQ(shared::near_form_factor({-b, 1, b}, {b, 1, b}, {b, 1, -b}, {-b, 1, -b}, {0, 1, 0}),
                  0.0f)
            << "from behind";
    }
    // Of a wall that stands on the point's own plane, c away, a high and 2 b wide.
    const float a = 1.0f, b = 0.5f;
    for (const float c : {0.005f, 0.02f, 0.3f}) {
        const float r = std::sqrt(a * a + c * c);
        const float right = (std::atan(b / c) - c / r * std::atan(b / r)) / kPi;
        EXPECT_NEAR(
            shared::near_form_factor({c, 0, -b}, {c, 0, b}, {c, a, b}, {c, a, -b}, {0, 1, 0}),
            right, 5e-4f)
            << c;
    }
    // A corner at the point itself is a number.
    EXPECT_TRUE(std::isfinite(
        shared::near_form_factor({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0}, {0, 0, 1})));
}

// The other side of a leaf looks at every point of the leaf from no distance at all: half of the points of a leaf anywhere lie
// in front of it by rounding, and were as dark as it.
TEST(NearFormFactor, OfTheBackOfItsOwnSheetAPointSeesNothing)
{
    int before_by_rounding = 0;
    for (std::uint64_t i = 0; i < 400; ++i) {
        const auto number = [&](std::uint64_t k) { return unit_float(mixed(i, 50 + k)); };
        const glm::vec3 n = cosine_direction({0, 1, 0}, number(0), number(1));
        const Tangents frame = tangents_of(n);
        const glm::vec3 at(20.0f * number(2) - 10.0f, 3.0f * number(3), 20.0f * number(4) - 10.0f);
        const glm::vec3 u = frame.t * (0.02f + 0.2f * number(5)), v = frame.b * (0.02f + 0.2f * number(6));
        // In turn as seen from below.
        const std::array<glm::vec3, 4> corners{at, at + v, at + v + u, at + u};
        const glm::vec3 x = at + u * number(7) + v * number(8);
        std::array<glm::vec3, 4> c;
        for (std::size_t k = 0; k < 4; ++k) c[k] = corners[k] - x;
        EXPECT_EQ(shared::near_form_factor(c[0], c[1], c[2], c[3], n), 0.0f) << i;
        before_by_rounding += glm::dot(glm::cross(c[2] - c[0], c[3] - c[1]), c[0]) < 0.0f ? 1 : 0;
        // Another leaf over it, at a fiftieth of its size, fills nearly all that its middle sees, and from its other side nothing.
        const float high = 0.02f * std::sqrt(glm::dot(u + v, u + v));
        for (std::size_t k = 0; k < 4; ++k) c[k] = corners[k] - (at + 0.5f * (u + v)) + n * high;
        EXPECT_GT(shared::near_form_factor(c[0], c[1], c[2], c[3], n), 0.7f) << i;
        EXPECT_EQ(shared::near_form_factor(c[3], c[2], c[1], c[0], n), 0.0f) << i;
    }
    EXPECT_GT(before_by_rounding, 100);
}

// What a point of this normal sees of a convex polygon's front, by rays over its hemisphere.
double seen_by_rays(const std::array<glm::vec3, 4>& c, glm::vec3 n, int rays)
{
    const auto part = [](glm::vec3 a, glm::vec3 b, glm::vec3 d, glm::vec3 way) {
        // Within all three planes through the point and an edge; the front is where they turn right.
        return glm::dot(glm::cross(b, a), way) >= 0.0f && glm::dot(glm::cross(d, b), way) >= 0.0f &&
               glm::dot(glm::cross(a, d), way) >= 0.0f;
    };
    int met = 0;
    for (int r = 0; r < rays; ++r) {
        const glm::vec3 way = row_direction(n, r, rays, 11);
        met += part(c[0], c[1], c[2], way) || part(c[0], c[2], c[3], way) ? 1 : 0;
    }
    return static_cast<double>(met) / static_cast<double>(rays);
}

// Anywhere: over the horizon, across it, below, from the front and from behind.
TEST(NearFormFactor, IsWhatRaysSeeWhereverThePolygonStands)
{
    int across = 0, behind = 0, below = 0, large = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
        const auto number = [&](std::uint64_t k) { return unit_float(mixed(i, k)); };
        const glm::vec3 n = cosine_direction({0, 1, 0}, number(0), number(1));
        const glm::vec3 u = cosine_direction({1, 0, 0}, number(2), number(3)) * (0.1f + 3.0f * number(4));
        const glm::vec3 v = cosine_direction({0, 0, 1}, number(5), number(6)) * (0.1f + 3.0f * number(7));
        const glm::vec3 corner = glm::vec3(number(8), number(9), number(10)) - 0.5f;
        std::array<glm::vec3, 4> c{corner, corner + u, corner + u + v, corner + v};
        if (i % 2 == 0) std::swap(c[1], c[3]);
        if (i % 5 == 0) c[3] = c[2];  // a triangle
        int up = 0;
        for (const glm::vec3& x : c) up += glm::dot(x, n) > 0.0f ? 1 : 0;
        const bool front = glm::dot(glm::cross(c[1] - c[0], c[2] - c[0]), c[0]) < 0.0f;
        const float found = shared::near_form_factor(c[0], c[1], c[2], c[3], n);
        if (!front || up == 0) {
            EXPECT_EQ(found, 0.0f) << i;
        } else {
            EXPECT_NEAR(static_cast<double>(found), seen_by_rays(c, n, 8192), 4e-3) << i << ", corners up: " << up;
        }
        across += front && up > 0 && up < 4 ? 1 : 0;
        behind += front ? 0 : 1;
        below += front && up == 0 ? 1 : 0;
        large += found > 0.3f ? 1 : 0;
    }
    EXPECT_GT(across, 40);
    EXPECT_GT(behind, 50);
    EXPECT_GT(below, 10);
    EXPECT_GT(large, 10);
}

// A wall that goes on below a point's plane is the wall above it.
TEST(NearFormFactor, OfAWallCutByTheHorizonIsThatOfTheUpperPart)
{
    const float a = 1.0f, b = 0.5f;
    for (const float c : {1e-4f, 0.001f, 0.02f, 0.3f}) {
        const float r = std::sqrt(a * a + c * c);
        const float right = (std::atan(b / c) - c / r * std::atan(b / r)) / kPi;
        for (const float deep : {0.0f, 0.01f, 1.0f, 30.0f}) {
            EXPECT_NEAR(shared::near_form_factor({c, -deep, -b}, {c, -deep, b}, {c, a, b}, {c, a, -b}, {0, 1, 0}),
                        right, 5e-4f)
                << c << " " << deep;
        }
        EXPECT_EQ(shared::near_form_factor({c, -1.0f, -b}, {c, -1.0f, b}, {c, 0, b}, {c, 0, -b}, {0, 1, 0}),
                  0.0f)
            << "below";
    }
    // A strip of 1 cm along the foot of a pane, a tenth of a millimetre to 1 cm from the point: half of 1 - h / sqrt(h^2 + w^2).
    const float w = 0.01f;
    for (const float h : {1e-4f, 1e-3f, 5e-3f, 0.01f}) {
        EXPECT_NEAR(shared::near_form_factor({h, 0, -9}, {h, 0, 9}, {h, w, 9}, {h, w, -9}, {0, 1, 0}),
                    0.5f * (1.0f - h / std::sqrt(h * h + w * w)), 1e-3f)
            << h;
    }
}

struct Cut {
    explicit Cut(const Scene& made, float cell_m = 0.5f)
        : scene(made), triangles(scene, {}), tracer(triangles)
    {
        PatchOptions options;
        options.cell_m = cell_m;
        patches = build_patches(tracer, options);
        glow = trace_glow(patches, tracer, glowing_patches(patches, patch_surfaces(patches, triangles, {})));
        near = trace_near(patches, tracer, &glow);
    }
    Scene scene;
    Triangles triangles;
    Tracer tracer;
    Patches patches;
    GlowLinks glow;
    NearLinks near;
};

struct Lit {
    Lit(const Cut& cut, const Relight& input)
        : light(relight(cut.patches, input)),
          ways(lookup_ways(cut.patches, input.near)),
          planes(lookup_planes(cut.patches)),
          lit{ways.table, ways.ways, planes, light.irradiance, light.gradient, ways.grid, light.near}
    {
    }
    PatchIrradiance light;
    LookupWays ways;
    std::vector<glm::vec4> planes;
    LitPatches lit;
};

// A room with a box in it, everything as bright: wherever a point lies, and however much of what it sees is
// close by, it gets the same light.
TEST(NearLight, AFurnaceIsAFurnaceAtEveryPoint)
{
    Scene scene = room();
    add_box(scene, {1, 0, 1}, {1.7f, 1.3f, 1.9f}, false);
    const Cut cut(scene);
    ASSERT_GT(cut.near.entries(), 100u);
    const std::vector<glm::vec3> albedo(cut.patches.count, glm::vec3(0.8f)),
        direct(cut.patches.count, glm::vec3(0.0f)), emission(cut.patches.count, glm::vec3(1.0f)),
        sky(shared::kSkyBins, glm::vec3(0.0f)),
        near_direct(cut.near.sources(), glm::vec3(0.0f)),
        near_albedo(cut.near.sources(), glm::vec3(0.8f)), near_emission(cut.near.sources(), glm::vec3(1.0f));
    Relight input;
    input.albedo = albedo;
    input.direct = direct;
    input.emission = emission;
    input.sky = sky;
    input.bounces = 100;
    input.near = &cut.near;
    input.near_albedo = near_albedo;
    input.near_direct = near_direct;
    input.near_emission = near_emission;
    const Lit lit(cut, input);
    int close = 0;
    for (std::uint32_t t = 0; t < cut.triangles.size(); ++t) {
        for (int k = 0; k < 100; ++k) {
            const float u = static_cast<float>(k % 10) * 0.0999f,
                        v = static_cast<float>(k / 10) * 0.0999f;
            if (u + v >= 1.0f) continue;
            const glm::vec3 x = cut.triangles.point(t, {u, v});
            if (x.y < 1e-3f && x.x > 0.9f && x.x < 1.8f && x.z > 0.9f && x.z < 2.0f) continue;
            const auto found = light_at(lit.lit, x, cut.triangles.normal(t));
            ASSERT_GT(found.weight, 0.0f);
            EXPECT_NEAR(found.irradiance.x, 5.0f, 2e-3f) << x.x << " " << x.y << " " << x.z;
            EXPECT_LE(found.open, 1.0f);
            EXPECT_GE(found.open, 0.0f);
            close += found.open < 0.75f ? 1 : 0;
        }
    }
    EXPECT_GT(close, 20) << "corners";
}

// In one number: a line from the polygon's plane to a reach before it, no more than all and no less than nothing.
TEST(NearFormFactor, WhatIsSeenIsALineOverTheHeight)
{
    for (const float at_plane : {-1.0f, -0.3f, 0.0f, 0.5f, 1.0f, 1.6f, 2.0f}) {
        for (const float at_reach : {-2.0f, -0.7f, 0.0f, 0.4f, 1.0f, 2.9f}) {
            const float packed = shared::near_seen_packed(at_plane, at_reach);
            for (const float height : {0.0f, 0.1f, 0.5f, 0.9f, 1.0f})
                EXPECT_NEAR(shared::near_seen(packed, height), std::clamp(at_plane + (at_reach - at_plane) * height, 0.0f, 1.0f), 2.5e-3f);
            EXPECT_EQ(shared::near_seen(packed, -0.5f), shared::near_seen(packed, 0.0f));
            EXPECT_EQ(shared::near_seen(packed, 7.0f), shared::near_seen(packed, 1.0f));
        }
    }
    EXPECT_GT(shared::near_seen(shared::near_seen_packed(9.0f, 9.0f), 1.0f), 0.99f) << "held to what fits";
    // What faces up a metre below the point, two the other way round.
    EXPECT_NEAR(shared::near_height({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}), 1.0f, 1e-6f);
    EXPECT_NEAR(shared::near_height({-1, -1, -1}, {1, -1, -1}, {1, -1, 1}, {-1, -1, 1}), -1.0f, 1e-6f);
}

// The side of a board of 2 mm on a glowing wall, so narrow that no cell has it: half of what it sees is the wall.
TEST(NearLight, AStripWithoutAPatchSeesTheWallThatItStandsOn)
{
    Scene scene = empty_scene();
    add_face(scene, {-1.5f, -1.5f, 0}, {3, 0, 0}, {0, 3, 0});            // the wall, facing +z
    add_face(scene, {0.1f, -1, 0}, {0, 0, 0.002f}, {0, 2, 0});           // the side, facing -x
    const Cut cut(scene, 0.35f);
    const std::vector<glm::vec3> albedo(cut.patches.count, glm::vec3(0.0f)), direct(albedo), emission(cut.patches.count, glm::vec3(1.0f)),
        sky(shared::kSkyBins, glm::vec3(0.0f)), near_albedo(cut.near.sources(), glm::vec3(0.0f)), near_direct(near_albedo),
        near_emission(cut.near.sources(), glm::vec3(1.0f));
    Relight input;
    input.albedo = albedo;
    input.direct = direct;
    input.emission = emission;
    input.sky = sky;
    input.near = &cut.near;
    input.near_albedo = near_albedo;
    input.near_direct = near_direct;
    input.near_emission = near_emission;
    const Lit lit(cut, input);
    const LeafFinder finder(cut.patches);
    int without = 0;
    for (int k = -9; k <= 9; ++k) {
        const glm::vec3 x{0.1f, 0.1f * static_cast<float>(k), 0.001f};
        const std::uint32_t leaf = finder.leaf_at(x, {-1, 0, 0});
        ASSERT_LT(leaf, cut.patches.count);
        without += cut.patches.normal[leaf].z > 0.9f ? 1 : 0;
        EXPECT_NEAR(light_at(lit.lit, x, {-1, 0, 0}).irradiance.x, 0.5f, 0.06f) << x.y;
    }
    EXPECT_GT(without, 5);
}

// A wall over a sill of 6 cm that the sun lights, no sky: a finger's breadth above the sill its light is
// nearly half of what the sill sends, an arm's length above nothing of it is left.
TEST(NearLight, ASunlitSillLightsTheBreadthAboveIt)
{
    Scene scene = empty_scene();
    add_face(scene, {0, 0, 2}, {0, 0, -4}, {0, 3, 0});         // the wall, facing +x
    add_face(scene, {0, 1.0f, 2}, {0.06f, 0, 0}, {0, 0, -4});  // the sill, facing up
    const Cut cut(scene, 0.35f);
    const glm::vec3 sun = glm::normalize(glm::vec3(1.0f, 1.5f, 0.0f));
    const std::vector<glm::vec3> albedo(cut.patches.count, glm::vec3(0.5f)),
        sky(shared::kSkyBins, glm::vec3(0.0f));
    std::vector<glm::vec3> direct(cut.patches.count, glm::vec3(0.0f)),
        near_direct(cut.near.sources(), glm::vec3(0.0f));
    const std::vector<glm::vec3> near_albedo(cut.near.sources(), glm::vec3(0.5f));
    add_sun(cut.patches, sun, glm::vec3(1.0f), direct);
    add_sun(cut.near, sun, glm::vec3(1.0f), near_direct);
    Relight input;
    input.albedo = albedo;
    input.direct = direct;
    input.sky = sky;
    input.bounces = 2;
    input.near = &cut.near;
    input.near_albedo = near_albedo;
    input.near_direct = near_direct;
    const Lit lit(cut, input);
    // Of a strip of width w that meets the wall, h below the point: half of 1 - h / sqrt(h^2 + w^2).
    for (const float h : {0.01f, 0.03f, 0.08f, 0.15f}) {
        const float right =
            0.5f * 0.5f * sun.y * (1.0f - h / std::sqrt(h * h + 0.06f * 0.06f));
        double sum = 0.0;
        for (int k = -8; k <= 8; ++k) {
            sum += static_cast<double>(
                       light_at(lit.lit, {0, 1.0f + h, 0.1f * static_cast<float>(k)}, {1, 0, 0})
                           .irradiance.x) /
                   17.0;
        }
        EXPECT_NEAR(sum, right, 0.25 * static_cast<double>(right) + 0.01) << h;
    }
    EXPECT_LT(light_at(lit.lit, {0, 2.2f, 0}, {1, 0, 0}).irradiance.x, 0.01f);
    EXPECT_LT(light_at(lit.lit, {0, 0.98f, 0}, {1, 0, 0}).irradiance.x, 0.02f) << "below it";

    // Put in place, by links that stand: the same texels, whatever light was there before.
    const StandingLinks standing = standing_links(cut.patches, &cut.near);
    std::vector<glm::vec4> texels = near_texels(cut.near);
    ASSERT_EQ(texels.size(), lit.light.near.size());
    EXPECT_NE(texels, lit.light.near);
    input.standing = &standing;
    input.near_texels = texels;
    for (int frame = 0; frame < 2; ++frame) {
        EXPECT_TRUE(relight(cut.patches, input).near.empty());
        EXPECT_EQ(texels, lit.light.near);
        for (std::size_t t = 1; t < texels.size(); t += 4) texels[t].w = 7.0f;
    }
}

// A plate hides a lamp from one half of a sill: each of a polygon's four points knows for itself.
TEST(NearLight, ALampIsSeenPointByPoint)
{
    Scene scene = empty_scene();
    add_face(scene, {0, 0, 2}, {0, 0, -4}, {0, 3, 0});        // a wall, facing +x
    add_face(scene, {0, 1.0f, 2}, {0.3f, 0, 0}, {0, 0, -4});  // the sill, facing up
    add_face(scene, {-1, 1.5f, 3}, {3, 0, 0}, {0, 0, -3});    // over z of 0 to 3
    const Cut cut(scene, 0.35f);
    Light lamp;
    lamp.kind = LightKind::Point;
    lamp.position_m = {1.0f, 3.0f, 0.0f};
    lamp.intensity = 100.0f;
    lamp.range_m = 20.0f;
    const auto reach = trace_near_lamp(cut.near, cut.tracer, 0.35f, lamp.position_m, lamp.range_m);
    std::vector<glm::vec3> direct(cut.near.sources(), glm::vec3(0.0f));
    add_lamp(cut.near, lamp, {}, reach, direct);
    int whole = 0, half = 0, none = 0;
    for (std::size_t s = 0; s < cut.near.sources(); ++s) {
        const glm::vec3 n = cut.near.normal[s], middle = near_middle(cut.near, s);
        if (n.y < 0.9f || middle.y > 1.2f) continue;
        glm::vec3 expected(0.0f);
        for (std::size_t k = 0; k < NearLinks::kSamples; ++k) {
            const PatchSample& at = cut.near.samples[s * NearLinks::kSamples + k];
            const glm::vec3 x = cut.triangles.point(at.triangle, at.at);
            if (std::abs(x.z) < 0.005f) continue;
            const bool lit = x.z < 0.0f;
            EXPECT_EQ((reach[s] >> k & 1) != 0, lit) << x.x << " " << x.z;
            if (lit) expected += 0.25f * lamp_irradiance(lamp, {}, x, n);
        }
        EXPECT_NEAR(direct[s].x, expected.x, 1e-3f * expected.x + 1e-6f);
        whole += reach[s] == NearLinks::kAllLit ? 1 : 0;
        none += reach[s] == 0 ? 1 : 0;
        half += reach[s] != 0 && reach[s] != NearLinks::kAllLit ? 1 : 0;
    }
    EXPECT_GT(whole, 1);
    EXPECT_GT(none, 1);
    EXPECT_GT(half, 0);
}

// A box covers half of a sill: what the sill sends is asked of the half that shows, with all of the sky that it has.
TEST(NearLight, ASourceIsWhereItsFaceShows)
{
    Scene scene = empty_scene();
    add_face(scene, {0, 0, 2}, {0, 0, -4}, {0, 3, 0});        // a wall, facing +x
    add_face(scene, {0, 1.0f, 2}, {0.3f, 0, 0}, {0, 0, -4});  // the sill, facing up
    add_box(scene, {0.14f, 0.9f, -3.0f}, {0.5f, 1.01f, 3.0f}, false);
    const Cut cut(scene, 0.35f);
    int sources = 0;
    for (std::size_t s = 0; s < cut.near.sources(); ++s) {
        if (cut.near.normal[s].y < 0.9f || std::abs(near_middle(cut.near, s).y - 1.0f) > 0.001f) continue;
        ++sources;
        for (std::size_t k = 0; k < NearLinks::kSamples; ++k)
            EXPECT_LT(cut.near.points[s * NearLinks::kSamples + k].x, 0.14f);
        EXPECT_GT(visible_share(cut.near.visible[s], glm::normalize(glm::vec3(0.05f, 1.0f, 0.0f))), 0.97f);
        for (std::size_t r = 0; r < NearLinks::kLinks; ++r)
            EXPECT_NE(cut.near.links[s * NearLinks::kLinks + r], cut.patches.black());
    }
    EXPECT_GT(sources, 8);
    EXPECT_LT(sources, 24) << "pieces as long as cells, shared";
}

// A sill of 4 m, sunlit in one half: entries along it send what is beside them, and all of a place the same.
TEST(NearLight, EntriesShareTheSourceBesideThem)
{
    Scene scene = empty_scene();
    add_face(scene, {0, 0, 2}, {0, 0, -4}, {0, 3, 0});         // the wall, facing +x
    add_face(scene, {0, 1.0f, 2}, {0.06f, 0, 0}, {0, 0, -4});  // the sill, facing up
    const Cut cut(scene, 0.35f);
    ASSERT_LT(cut.near.sources() * 2, cut.near.entries() * 3);
    int far = 0;
    for (std::uint32_t i = 0; i < cut.patches.count; ++i) {
        for (std::uint32_t e = cut.near.first[i]; e < cut.near.first[i + 1]; ++e) {
            const std::uint32_t s = cut.near.source[e];
            if (cut.near.normal[s].y < 0.9f) continue;
            // Half of a piece, and half of a patch.
            EXPECT_LT(std::abs(near_middle(cut.near, s).z - cut.patches.position_m[i].z), 0.36f) << e;
            ++far;
        }
    }
    EXPECT_GT(far, 10);
}

// A strip of 1 cm that stands on a wall is met by one ray in a hundred of a patch of 35 cm, or by none: it is known all the same,
// and a hair beside it half of the light is its.
TEST(NearLight, AThinStripIsKnownToEveryPatchAlongIt)
{
    Scene scene = empty_scene();
    add_face(scene, {0, 0, 2}, {0, 0, -4}, {0, 3, 0});         // the wall, facing +x
    add_face(scene, {0, 1.0f, 2}, {0.01f, 0, 0}, {0, 0, -4});  // the strip, facing up
    const Cut cut(scene, 0.35f);
    const std::vector<glm::vec3> albedo(cut.patches.count, glm::vec3(0.0f)), sky(shared::kSkyBins, glm::vec3(0.0f)),
        direct(cut.patches.count, glm::vec3(0.0f)), near_direct(cut.near.sources(), glm::vec3(1.0f));
    std::vector<glm::vec3> near_albedo;
    for (std::size_t s = 0; s < cut.near.sources(); ++s)
        near_albedo.push_back(glm::vec3(cut.near.normal[s].y > 0.9f ? 0.5f : 0.0f));
    Relight input;
    input.albedo = albedo;
    input.direct = direct;
    input.sky = sky;
    input.near = &cut.near;
    input.near_albedo = near_albedo;
    input.near_direct = near_direct;
    const Lit lit(cut, input);
    for (int k = -30; k <= 30; ++k) {
        const float z = 0.06f * static_cast<float>(k);
        for (const float h : {0.001f, 0.005f, 0.02f}) {
            const float right = 0.5f * 0.5f * (1.0f - h / std::sqrt(h * h + 1e-4f));
            EXPECT_NEAR(light_at(lit.lit, {0, 1.0f + h, z}, {1, 0, 0}).irradiance.x, right, 0.05f * right) << z << " " << h;
        }
    }
}

// What patches ask for what is close has a point that faces along n at each place, of more than two that are found.
void expect_asked(const Cut& cut, const std::vector<glm::vec3>& places, glm::vec3 n)
{
    const auto receivers = near_receivers(cut.patches, cut.tracer, near_faces(cut.triangles), 0);
    const LeafFinder finder(cut.patches);
    int asked = 0;
    for (const glm::vec3& at : places) {
        const std::uint32_t leaf = finder.leaf_at(at, n);
        if (leaf >= cut.patches.count) continue;
        ++asked;
        EXPECT_TRUE(std::any_of(receivers[leaf].begin(), receivers[leaf].end(),
                                [&](const SamplePoint& p) { return glm::dot(p.normal, n) > 0.9f; }))
            << at.x;
    }
    EXPECT_GT(asked, 2);
}

// Land of two sides with smooth normals: its own back is nothing that stands close to it.
TEST(NearLight, TheBackOfASheetIsNotCloseToItsFront)
{
    Scene scene = empty_scene();
    scene.materials[0].double_sided = true;
    Primitive& p = scene.meshes[0].primitives[0];
    constexpr int kSide = 60;
    const auto height = [](float x, float z) {
        return 0.004f * (std::sin(9.0f * x + 1.0f) + std::sin(7.0f * z + 3.0f * std::sin(5.0f * x)));
    };
    for (int z = 0; z <= kSide; ++z) {
        for (int x = 0; x <= kSide; ++x) {
            const glm::vec2 at = 0.08f * glm::vec2(x, z);
            p.positions.emplace_back(at.x, height(at.x, at.y), at.y);
            const float e = 0.05f;
            p.normals.push_back(glm::normalize(glm::vec3(height(at.x - e, at.y) - height(at.x + e, at.y), 2.0f * e,
                                                         height(at.x, at.y - e) - height(at.x, at.y + e))));
            p.uv0.emplace_back(0.0f, 0.0f);
        }
    }
    const auto number = [](int x, int z) { return static_cast<std::uint32_t>(z * (kSide + 1) + x); };
    for (int z = 0; z < kSide; ++z)
        for (int x = 0; x < kSide; ++x)
            p.indices.insert(p.indices.end(), {number(x, z), number(x, z + 1), number(x + 1, z), number(x + 1, z),
                                               number(x, z + 1), number(x + 1, z + 1)});
    const Cut cut(scene, 0.175f);
    std::size_t above = 0, own = 0;
    for (std::uint32_t leaf = 0; leaf < cut.patches.count; ++leaf) {
        if (cut.patches.normal[leaf].y < 0.7f) continue;
        ++above;
        for (std::uint32_t e = cut.near.first[leaf]; e < cut.near.first[leaf + 1]; ++e)
            own += cut.near.normal[cut.near.source[e]].y < 0.0f ? 1u : 0u;
    }
    EXPECT_GT(above, 100u);
    EXPECT_EQ(own, 0u);
}

// The bevel of a table is a hundredth of the cells along it: it is asked all the same.
TEST(NearLight, ABevelWithoutSamplesIsAsked)
{
    Scene scene = empty_scene();
    add_face(scene, {0, 1, 1}, {2, 0, 0}, {0, 0, -1});
    add_face(scene, {0, 0.998f, 1.002f}, {2, 0, 0}, {0, 0.002f, -0.002f});
    const Cut cut(scene, 0.5f);
    const glm::vec3 n = glm::normalize(glm::vec3(0, 1, 1));
    std::vector<glm::vec3> places;
    for (int k = 0; k < 4; ++k) places.emplace_back(0.25f + 0.5f * static_cast<float>(k), 0.999f, 1.001f);
    expect_asked(cut, places, n);
}

// Of a beam's end most of a side lies in the wall, its middle too: what stands out is asked all the same.
TEST(NearLight, ABeamsEndThatStandsOutOfAWallIsAsked)
{
    Scene scene = empty_scene();
    add_box(scene, {0, 0, -0.4f}, {6, 4, 0}, false);
    std::vector<glm::vec3> ends;
    for (int k = 0; k < 12; ++k) {
        const glm::vec3 low(0.31f + 0.47f * static_cast<float>(k), 0.3f + 0.25f * static_cast<float>(k), -0.18f);
        add_box(scene, low, low + glm::vec3(0.1f, 0.06f, 0.19f), false);
        // What the lookup finds there faces half along.
        add_face(scene, low + glm::vec3(-0.02f, 0.08f, 0.181f), {0.08f, 0, 0.1f}, {0, 0.1f, 0});
        ends.push_back(low + glm::vec3(0.0f, 0.03f, 0.185f));
    }
    const Cut cut(scene, 0.35f);
    const glm::vec3 n(-1, 0, 0);
    expect_asked(cut, ends, n);
}

// Two triangles of a face are one polygon.
TEST(NearLight, AFaceOfABoxIsOnePolygon)
{
    Scene scene = room();
    add_box(scene, {1, 0, 1}, {1.7f, 1.3f, 1.9f}, false);
    const Triangles triangles(scene, {});
    const NearFaces faces = near_faces(triangles);
    EXPECT_EQ(triangles.size(), 24u);
    ASSERT_EQ(faces.faces.size(), 12u);
    for (const NearFace& face : faces.faces) {
        ASSERT_EQ(face.polygon.count, 4);
        EXPECT_NEAR(area_m2(face.polygon), triangles.area_m2(face.triangles[0]) + triangles.area_m2(face.triangles[1]), 1e-4f);
        EXPECT_NE(face.triangles[0], face.triangles[1]);
        const auto& c = face.polygon.corner;
        EXPECT_GT(glm::dot(glm::cross(c[1] - c[0], c[2] - c[0]), face.normal), 0.0f);
    }
}

// Four at a time get the bits of one at a time, above the horizon, across it, below, beside an edge and behind.
TEST(NearFormFactor, FourPointsGetWhatEachOfThemGets)
{
    int across = 0, seen = 0, beside = 0;
    for (std::uint64_t i = 0; i < 400; ++i) {
        const auto number = [&](std::uint64_t k) { return unit_float(mixed(i, 90 + k)); };
        const glm::vec3 u = cosine_direction({1, 0, 0}, number(0), number(1)) * (0.01f + 3.0f * number(2));
        const glm::vec3 v = cosine_direction({0, 0, 1}, number(3), number(4)) * (0.01f + 3.0f * number(5));
        const glm::vec3 at(4.0f * number(6) - 2.0f, 4.0f * number(7) - 2.0f, 4.0f * number(8) - 2.0f);
        const std::array<glm::vec3, 4> corners{at, at + u, i % 3 == 0 ? at + v : at + u + v, at + v};
        const NearPolygon polygon = polygon_of(corners);
        const glm::vec3 front = front_of(corners);
        std::vector<SamplePoint> points;
        for (std::uint64_t k = 0; k < 7; ++k) {
            const float far = k == 0 ? 0.0f : 3.0f * number(10 + 5 * k);
            points.push_back({at + u * number(11 + 5 * k) + (front - v) * far,
                              cosine_direction({0, 1, 0}, number(12 + 5 * k), number(13 + 5 * k))});
        }
        const FourPoints four(points);
        ASSERT_EQ(four.position_m.size(), 2u);
        for (std::size_t k = 0; k < points.size(); ++k) {
            const SamplePoint& p = points[k];
            const auto lane = static_cast<int>(k % 4);
            std::array<glm::vec3, 4> c;
            int up = 0;
            for (std::size_t j = 0; j < 4; ++j) {
                c[j] = corners[j] - p.position_m;
                up += glm::dot(c[j], p.normal) >= 0.0f ? 1 : 0;
            }
            const float one = shared::near_form_factor(c[0], c[1], c[2], c[3], p.normal);
            EXPECT_EQ(near_form_factors(corners, four.position_m[k / 4], four.normal[k / 4])[lane], one) << i << " " << k;
            const glm::vec3 nearest = nearest_in(polygon, front, p.position_m);
            const Four3 found = nearest_in(polygon, front, four.position_m[k / 4]);
            EXPECT_EQ(glm::vec3(found.x[lane], found.y[lane], found.z[lane]), nearest) << i << " " << k;
            across += one > 0.0f && up > 0 && up < 4 ? 1 : 0;
            seen += one > 0.0f && up == 4 ? 1 : 0;
            beside += std::abs(glm::dot(nearest - p.position_m, front)) < distance_m(polygon, front, p.position_m) ? 1 : 0;
        }
    }
    EXPECT_GT(across, 200);
    EXPECT_GT(seen, 100);
    EXPECT_GT(beside, 200);
}

// What is not looked at has less than was found: the guess that faces are put in order by is never below what they have.
TEST(NearLight, NoFaceHasMoreThanItMayHave)
{
    Scene scene = room();
    for (std::uint64_t i = 0; i < 40; ++i) {
        const auto number = [&](std::uint64_t k) { return unit_float(mixed(i, 300 + k)); };
        const glm::vec3 low(3.5f * number(0), i % 2 == 0 ? 0.0f : 2.0f * number(1), 3.5f * number(2));
        add_box(scene, low, low + glm::vec3(0.02f + 0.4f * number(3), 0.02f + 1.2f * number(4), 0.02f + 0.4f * number(5)), false);
    }
    const Cut cut(scene);
    const NearFaces faces = near_faces(cut.triangles);
    const NearSources sources(cut.patches, cut.tracer, faces, nullptr, {});
    const NearChooser chooser(cut.patches, cut.tracer, faces, sources, {});
    const auto receivers = near_receivers(cut.patches, cut.tracer, faces, 1);
    std::size_t have = 0, may = 0, all = 0;
    for (std::uint32_t patch = 0; patch < cut.patches.count; patch += 7) {
        if (receivers[patch].empty()) continue;
        all += faces.faces.size();
        const auto around = chooser.surroundings(patch, receivers[patch]);
        for (std::uint32_t f = 0; f < faces.faces.size(); ++f) {
            const auto one = chooser.candidate(f, false, around, 1e-4f);
            const float most = chooser.most_square(f, false, around);
            may += most >= 1e-4f ? 1 : 0;
            if (!one) continue;
            ++have;
            EXPECT_GE(most, one->square) << patch << " " << f;
        }
    }
    EXPECT_GT(have, 300u);
    EXPECT_LT(may, all / 8);  // and it is of use
}

TEST(NearLight, IsTheSameForAnyNumberOfThreads)
{
    Scene scene = room();
    add_box(scene, {1, 0, 1}, {1.7f, 1.3f, 1.9f}, false);
    const Cut cut(scene);
    for (const int threads : {1, 3}) {
        const NearLinks again = trace_near(cut.patches, cut.tracer, &cut.glow, {}, threads);
        EXPECT_EQ(again.first, cut.near.first);
        EXPECT_EQ(again.corners, cut.near.corners);
        EXPECT_EQ(again.seen, cut.near.seen);
        EXPECT_EQ(again.source, cut.near.source);
        EXPECT_EQ(again.normal, cut.near.normal);
        EXPECT_EQ(again.points, cut.near.points);
        EXPECT_EQ(again.sender, cut.near.sender);
        EXPECT_EQ(again.visible, cut.near.visible);
        EXPECT_EQ(again.rays, cut.near.rays);
        EXPECT_EQ(again.links, cut.near.links);
        EXPECT_EQ(again.material, cut.near.material);
        EXPECT_EQ(again.glow_more, cut.near.glow_more);
        EXPECT_EQ(again.glow_taken, cut.near.glow_taken);
    }
    for (std::uint32_t i = 0; i < cut.patches.count; ++i) {
        EXPECT_LE(cut.near.first[i + 1] - cut.near.first[i], NearLinks::kMostAPatch);
        EXPECT_LE(cut.near.rays_of(i), static_cast<std::uint32_t>(cut.patches.rays));
    }
}

}  // namespace
}  // namespace petrichor::scene
