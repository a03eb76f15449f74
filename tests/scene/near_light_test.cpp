// Light of what stands closer to a patch than it is wide: a furnace, a sunlit sill, a lamp, the same for any number of threads.
#include "scene/patches/near_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "scene/patches/lamps.h"
#include "tests/scene/near_scenes.h"

namespace petrichor::scene {
namespace {

using namespace near_scenes;

// A room with a box in it, everything as bright: wherever a point lies, and however much of what it sees is
// close by, it gets the same light.
TEST(NearLight, AFurnaceIsAFurnaceAtEveryPoint)
{
    Scene scene = room();
    add_box(scene, {1, 0, 1}, {1.7f, 1.3f, 1.9f}, false);
    const Cut cut(scene);
    ASSERT_GT(cut.near.entries(), 100u);
    Given given(cut, 0.8f);
    given.emission.assign(cut.patches.count, glm::vec3(1.0f));
    given.near_emission.assign(cut.near.sources(), glm::vec3(1.0f));
    Relight input = given.input();
    input.bounces = 100;
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

// The side of a board of 2 mm on a glowing wall, so narrow that no cell has it: half of what it sees is the wall.
TEST(NearLight, AStripWithoutAPatchSeesTheWallThatItStandsOn)
{
    Scene scene = empty_scene();
    add_face(scene, {-1.5f, -1.5f, 0}, {3, 0, 0}, {0, 3, 0});            // the wall, facing +z
    add_face(scene, {0.1f, -1, 0}, {0, 0, 0.002f}, {0, 2, 0});           // the side, facing -x
    const Cut cut(scene, 0.35f);
    Given given(cut, 0.0f);
    given.emission.assign(cut.patches.count, glm::vec3(1.0f));
    given.near_emission.assign(cut.near.sources(), glm::vec3(1.0f));
    const Lit lit(cut, given.input());
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

// A closed box of sheets in the open, their inner sides a hair beyond borders of cells: the point that a lookup lifts off them
// lies in cells that have none of their patches. Inside it is dark up to the corners.
TEST(NearLight, ASheetOnABorderOfCellsHasTheLightOfItsOwnSide)
{
    constexpr float kEdge = 0.1f, kHair = 0.03f * 0.5f * kEdge;  // of a regular cell
    const auto border = [](int eighth) { return (8.0f * static_cast<float>(eighth) - shared::kPatchGridShift) * 0.5f * kEdge; };
    const glm::vec3 low(border(-1) - kHair), high(border(1) + kHair);
    Scene scene = empty_scene();
    scene.materials[0].double_sided = true;
    add_box(scene, low, high, true);
    const Cut cut(scene, kEdge);
    Given given(cut, 0.5f);
    given.sky.assign(shared::kSkyBins, glm::vec3(1.0f));
    const Lit lit(cut, given.input());
    const LeafFinder finder(cut.patches);
    constexpr int kAcross = 25;
    for (std::uint32_t t = 0; t < cut.triangles.size(); ++t) {
        const glm::vec3 n = cut.triangles.normal(t);
        float inside = 0.0f, outside = 0.0f;
        for (int k = 0; k < kAcross * kAcross; ++k) {
            const float u = (static_cast<float>(k % kAcross) + 0.5f) / static_cast<float>(kAcross),
                        v = (static_cast<float>(k / kAcross) + 0.5f) / static_cast<float>(kAcross);
            if (u + v >= 1.0f) continue;
            const glm::vec3 x = cut.triangles.point(t, {u, v});
            const std::uint32_t leaf = finder.leaf_at(x, n);
            ASSERT_LT(leaf, cut.patches.count);
            EXPECT_GT(glm::dot(cut.patches.normal[leaf], n), 0.99f) << x.x << " " << x.y << " " << x.z;
            inside = std::max(inside, light_at(lit.lit, x, n).irradiance.x);
            outside = std::max(outside, light_at(lit.lit, x, -n).irradiance.x);
        }
        EXPECT_LT(inside, 0.02f) << n.x << " " << n.y << " " << n.z;
        EXPECT_GT(outside, 0.4f) << n.x << " " << n.y << " " << n.z;
    }
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
    Given given(cut, 0.5f);
    add_sun(cut.patches, sun, glm::vec3(1.0f), given.direct);
    add_sun(cut.near, sun, glm::vec3(1.0f), given.near_direct);
    Relight input = given.input();
    input.bounces = 2;
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

// A strip of 1 cm that stands on a wall is met by one ray in a hundred of a patch of 35 cm, or by none: it is known all the same,
// and a hair beside it half of the light is its.
TEST(NearLight, AThinStripIsKnownToEveryPatchAlongIt)
{
    Scene scene = empty_scene();
    add_face(scene, {0, 0, 2}, {0, 0, -4}, {0, 3, 0});         // the wall, facing +x
    add_face(scene, {0, 1.0f, 2}, {0.01f, 0, 0}, {0, 0, -4});  // the strip, facing up
    const Cut cut(scene, 0.35f);
    Given given(cut, 0.0f);
    given.near_direct.assign(cut.near.sources(), glm::vec3(1.0f));
    for (std::size_t s = 0; s < cut.near.sources(); ++s)
        given.near_albedo[s] = glm::vec3(cut.near.normal[s].y > 0.9f ? 0.5f : 0.0f);
    const Lit lit(cut, given.input());
    for (int k = -30; k <= 30; ++k) {
        const float z = 0.06f * static_cast<float>(k);
        for (const float h : {0.001f, 0.005f, 0.02f}) {
            const float right = 0.5f * 0.5f * (1.0f - h / std::sqrt(h * h + 1e-4f));
            EXPECT_NEAR(light_at(lit.lit, {0, 1.0f + h, z}, {1, 0, 0}).irradiance.x, right, 0.05f * right) << z << " " << h;
        }
    }
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
