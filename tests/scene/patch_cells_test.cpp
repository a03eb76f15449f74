// Which cells a scene is cut into: where surface is buried or parted, beside lamps, on a backdrop and on hills.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "tests/scene/patch_cuts.h"

namespace petrichor::scene {
namespace {

using namespace patch_cuts;

// A floor under a box that stands on it is no surface of the scene.
TEST(Patches, BuriedSurfaceGetsNoPatch)
{
    Scene scene = empty_scene();
    add_face(scene, {-6, 0, -6}, {0, 0, 12}, {12, 0, 0});
    add_box(scene, {-3.0f, -0.5f, -3.0f}, {3.0f, 1.0f, 3.0f}, false);
    const Cut cut(scene, half_metre(64));
    double ground = 0.0;
    for (std::uint32_t i = 0; i < cut.patches.count; ++i) {
        if (cut.patches.normal[i].y < 0.9f || cut.patches.position_m[i].y > 0.5f) continue;
        ground += static_cast<double>(cut.patches.area_m2[i]);
    }
    EXPECT_NEAR(ground, 144.0 - 36.0, 4.0);
}

// A thin wall parts a cell: no patch lies on both sides.
TEST(Patches, SightPartsACellAtAThinWall)
{
    Scene scene = empty_scene();
    add_face(scene, {-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
    add_box(scene, {-4.0f, -0.2f, 0.115f}, {4.0f, 3.0f, 0.135f}, false);
    PatchOptions options = half_metre(32);
    const Cut split(scene, options);
    options.split_by_sight = false;
    const Cut whole(scene, options);
    const auto both_sides = [](const Cut& cut) {
        int count = 0;
        for (std::uint32_t i = 0; i < cut.patches.count; ++i) {
            if (axis_of(cut.patches.key[i]) != 2 || cut.patches.position_m[i].y > 0.5f) continue;
            int before = 0, behind = 0;
            for (std::size_t k = 0; k < kPatchSamples; ++k) {
                const glm::vec3 x = sample_point(cut.triangles,
                                                 cut.patches.samples[i * kPatchSamples + k])
                                        .position_m;
                ++(x.z < 0.12f ? before : behind);
            }
            count += std::min(before, behind) >= 4 ? 1 : 0;
        }
        return count;
    };
    EXPECT_GT(both_sides(whole), 4);
    EXPECT_LT(both_sides(split), both_sides(whole) / 3);
}

// A chimney that goes through the roof of a house: a slab on four walls, with a loft that nothing looks into.
Scene chimney(float roof_m)
{
    Scene scene = empty_scene();
    add_face(scene, {-12, 0, -12}, {0, 0, 24}, {24, 0, 0});
    add_box(scene, {-3.0f, roof_m - 0.1f, -3.0f}, {3.0f, roof_m, 3.0f}, false);
    const float top = roof_m - 0.05f;
    add_box(scene, {-2.9f, 0.0f, -2.9f}, {-2.8f, top, 2.9f}, false);
    add_box(scene, {2.8f, 0.0f, -2.9f}, {2.9f, top, 2.9f}, false);
    add_box(scene, {-2.85f, 0.0f, -2.9f}, {2.85f, top, -2.8f}, false);
    add_box(scene, {-2.85f, 0.0f, 2.8f}, {2.85f, top, 2.9f}, false);
    add_box(scene, {-0.43f, 0.0f, -0.43f}, {0.43f, roof_m + 2.0f, 0.43f}, false);
    return scene;
}

TEST(Patches, AWallIsWetDownToTheRoofThatItStandsIn)
{
    constexpr float kFace = 0.43f;
    int asked = 0;
    for (int k = 0; k < 12; ++k) {
        const float roof_m = 1.7f + 0.0413f * static_cast<float>(k);
        PatchOptions options = half_metre(32);
        options.cell_m = 0.35f;
        const Cut cut(chimney(roof_m), options);
        for (const glm::vec3 out : {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)}) {
            const glm::vec3 rain = -out * 6.0f + glm::vec3(0.0f, -5.0f, 0.0f);
            const glm::vec3 along(out.z, 0.0f, out.x);
            for (const float aside : {-0.33f, -0.1f, 0.1f, 0.33f}) {
                for (const float up : {0.025f, 0.05f, 0.08f, 0.14f}) {
                    const auto patch = patch_at(cut.patches, out * kFace + along * aside + glm::vec3(0.0f, roof_m + up, 0.0f), out);
                    const auto high = patch_at(cut.patches, out * kFace + along * aside + glm::vec3(0.0f, roof_m + 1.2f, 0.0f), out);
                    ASSERT_TRUE(patch && high);
                    const float there = rain_exposure(cut.patches, *high, rain);
                    ASSERT_GT(there, 0.5f);
                    EXPECT_GT(rain_exposure(cut.patches, *patch, rain), 0.75f * there) << "roof at " << roof_m << ", " << up << " over it, " << aside;
                    ++asked;
                }
            }
            // The loft stays dry.
            const auto below = patch_at(cut.patches, out * kFace + glm::vec3(0.0f, roof_m - 0.6f, 0.0f), out);
            ASSERT_TRUE(below);
            EXPECT_EQ(rain_exposure(cut.patches, *below, rain), 0.0f);
        }
    }
    EXPECT_EQ(asked, 12 * 4 * 16);
}

// However much surface there is, numbers fit 16 bits: cells grow.
TEST(Patches, CellsGrowUntilNumbersFit)
{
    Scene scene = room();
    PatchOptions options = half_metre(16);
    options.max_patches = 200;
    const Cut cut(scene, options);
    EXPECT_LE(cut.patches.count, 200u);
    EXPECT_GT(cut.patches.count, 50u);
    EXPECT_GT(cut.patches.level_cell_m(1), 0.5f);
}

// A box on ground that the program lays around it: the ground is patches near the box, coarse ones far
// from it.
TEST(Patches, ABackdropIsPatchesNearTheScene)
{
    Scene alone = empty_scene();
    add_box(alone, {-0.5f, 0.0f, -0.5f}, {0.5f, 1.0f, 0.5f}, false);
    Scene scene = alone;
    Scene ground = empty_scene();
    for (int i = -16; i < 16; ++i) {
        for (int k = -16; k < 16; ++k) {
            const glm::vec2 corner = 0.25f * glm::vec2(i, k + 1);
            add_face(ground, {corner.x, -0.001f, corner.y}, {0.25f, 0, 0},
                                   {0, 0, -0.25f});
        }
    }
    add_face(ground, {50, -0.001f, 1}, {1, 0, 0}, {0, 0, -1});
    scene.meshes.push_back(ground.meshes[0]);
    Instance below;
    below.mesh = 1;
    below.backdrop = true;
    scene.instances.push_back(below);

    const Triangles plain(alone, {}), all(scene, {});
    EXPECT_EQ(all.low(), plain.low());
    EXPECT_EQ(all.high(), plain.high());
    EXPECT_FALSE(plain.backdrop());
    EXPECT_TRUE(all.backdrop());
    EXPECT_EQ(plain.size(), 12u);
    // Within 4.1 halves of the diagonal, 3.55 m about the middle.
    EXPECT_GT(all.size(), 12u + 2u * 20u * 20u);
    EXPECT_LT(all.size(), 12u + 2u * 32u * 32u);
    const Tracer tracer(all);
    const Patches p = build_patches(tracer);
    const Patches boxed = build_patches(Tracer(plain));
    EXPECT_EQ(p.cell_m, 2.0f * boxed.cell_m);
    const auto beside = patch_at(p, {0.52f, -0.001f, 0.0f}, {0, 1, 0});
    const auto away = patch_at(p, {3.0f, -0.001f, 0.0f}, {0, 1, 0});
    ASSERT_TRUE(beside && away);
    EXPECT_LT(p.sky_view[*beside], 0.75f);
    EXPECT_GT(p.sky_view[*away], 0.95f);
    EXPECT_GT(level_of(p.key[*away]), level_of(p.key[*beside]) + 2);
    EXPECT_LT(p.count, 9000u);
    // What stands on it is lit by it: half of what a wall sees is ground.
    const auto wall = patch_at(p, {0.5f, 0.5f, 0.0f}, {1, 0, 0});
    ASSERT_TRUE(wall);
    int ground_links = 0;
    for (int r = 0; r < p.rays; ++r) ground_links += p.row(*wall)[r] < p.count ? 1 : 0;
    EXPECT_GT(ground_links, p.rays / 3);
}

// Open ground under a lamp of 1 m: wide cells, but beside the lamp none that is longer than its distance.
TEST(Patches, CellsBesideALampAreNoLongerThanItsDistance)
{
    Scene scene = empty_scene();
    add_face(scene, {-15, 0, 15}, {30, 0, 0}, {0, 0, -30});
    const auto edge_at = [](const Cut& cut, glm::vec3 at) {
        const auto leaf = patch_at(cut.patches, at, {0, 1, 0});
        return leaf ? cut.patches.level_cell_m(level_of(cut.patches.key[*leaf])) : 0.0f;
    };
    const Cut dark(scene, {});
    EXPECT_GT(edge_at(dark, {3, 0, 2}), 1.0f);
    Light lamp;
    lamp.position_m = {3, 1, 2};
    lamp.intensity = 100.0f;
    scene.lights.push_back(lamp);
    const Cut lit(scene, {});
    const Patches& p = lit.patches;
    EXPECT_LT(p.count, dark.patches.count + 200u);
    for (std::uint32_t i = 0; i < p.count; ++i) {
        float nearest_m = 100.0f;
        for (std::size_t k = 0; k < kPatchSamples; ++k)
            nearest_m = std::min(nearest_m, glm::distance(sample_point(lit.triangles, p.samples[i * kPatchSamples + k]).position_m, lamp.position_m));
        EXPECT_LE(p.level_cell_m(level_of(p.key[i])), nearest_m);
    }
    EXPECT_EQ(edge_at(lit, {-10, 0, -10}), edge_at(dark, {-10, 0, -10}));
    // The sun is no lamp, nor is what gives no light; near so many as these cells would be small everywhere.
    const auto like_dark = [&](const std::vector<Light>& lights) {
        Scene other = scene;
        other.lights = lights;
        return Cut(other, {}).patches.count == dark.patches.count;
    };
    Light sun = lamp, off = lamp;
    sun.kind = LightKind::Directional;
    off.intensity = 0.0f;
    EXPECT_TRUE(like_dark({sun}));
    EXPECT_TRUE(like_dark({off}));
    EXPECT_TRUE(like_dark(std::vector<Light>(65, lamp)));
}

// Hills of 200 m under the open sky: nothing is near, and each slope has its own sun.
TEST(Patches, SlopesOfALandscapeAreApart)
{
    Scene scene = empty_scene();
    constexpr int kCells = 80;
    constexpr float kEdge_m = 12.5f;
    const auto height = [](float x) { return 16.0f * std::sin(x * 2.0f * std::numbers::pi_v<float> / 200.0f); };
    for (int i = 0; i < kCells; ++i) {
        for (int k = 0; k < kCells; ++k) {
            const glm::vec2 at = kEdge_m * (glm::vec2(i, k) - 0.5f * kCells);
            const float rise = height(at.x + kEdge_m) - height(at.x);
            add_face(scene, {at.x, height(at.x), at.y + kEdge_m}, {kEdge_m, rise, 0}, {0, 0, -kEdge_m});
        }
    }
    const Cut cut(scene, {});
    const Patches& p = cut.patches;
    int sunny = 0, shady = 0;
    for (std::uint32_t i = 0; i < p.count; ++i) {
        const float edge_m = p.level_cell_m(level_of(p.key[i]));
        glm::vec3 mean(0.0f);
        for (int k = 0; k < kPatchSamples; ++k)
            mean += cut.triangles.normal(p.samples[i * kPatchSamples + static_cast<std::size_t>(k)].triangle);
        if (edge_m > 8.0f) {
            EXPECT_GE(glm::length(mean) / kPatchSamples, 0.98f) << edge_m << " m";
        }
        sunny += p.normal[i].x > 0.2f ? 1 : 0;
        shady += p.normal[i].x < -0.2f ? 1 : 0;
    }
    EXPECT_GT(sunny, 300);
    EXPECT_GT(shady, 300);
    EXPECT_LT(p.count, 20000u);
}

}  // namespace
}  // namespace petrichor::scene
