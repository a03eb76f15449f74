// Laws and closed forms of patches and links. Where cells lie and how large they are: patch_cells_test.cpp.
#include "scene/patches/patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <set>

#include "base/error.h"
#include "tests/scene/patch_cuts.h"

namespace petrichor::scene {
namespace {

using namespace patch_cuts;

// Share of the light of the patches with normal `to` in the rows of those with normal `from`.
double form_factor(const Patches& p, glm::vec3 from, glm::vec3 to)
{
    double sum = 0.0, area = 0.0;
    for (std::uint32_t i = 0; i < p.count; ++i) {
        if (glm::dot(p.normal[i], from) < 0.9f) continue;
        int count = 0;
        for (int r = 0; r < p.rays; ++r) {
            const std::uint32_t j = p.row(i)[r];
            if (j < p.count && glm::dot(p.normal[j], to) > 0.9f) ++count;
        }
        sum += static_cast<double>(p.area_m2[i]) * count / p.rays;
        area += static_cast<double>(p.area_m2[i]);
    }
    return sum / area;
}

TEST(Patches, ARoomIsCutAsTheReferenceDoes)
{
    const Cut cut(room(), half_metre());
    EXPECT_EQ(cut.patches.count, 486u);
    double area = 0.0;
    for (std::uint32_t i = 0; i < cut.patches.count; ++i)
        area += static_cast<double>(cut.patches.area_m2[i]);
    EXPECT_NEAR(area, 96.0, 96.0 * 1e-3);
    for (const std::uint16_t id : cut.patches.links)
        ASSERT_LT(id, cut.patches.count) << "a ray left the room";
}

struct RayCase {
    int rays;
    double tolerance;
};
class RoomFactors : public testing::TestWithParam<RayCase> {};
TEST_P(RoomFactors, AreThoseOfACube)
{
    const Cut cut(room(), half_metre(GetParam().rays));
    EXPECT_NEAR(form_factor(cut.patches, {0, 1, 0}, {0, -1, 0}), 0.199825, GetParam().tolerance);
    EXPECT_NEAR(form_factor(cut.patches, {0, 1, 0}, {1, 0, 0}), 0.200044, GetParam().tolerance);
    EXPECT_NEAR(form_factor(cut.patches, {1, 0, 0}, {0, 0, -1}), 0.200044, GetParam().tolerance);
}
INSTANTIATE_TEST_SUITE_P(Rays, RoomFactors,
                         testing::Values(RayCase{64, 0.005}, RayCase{256, 0.003},
                                         RayCase{1024, 0.0015}),
                         [](const auto& test) { return "N" + std::to_string(test.param.rays); });

TEST(Patches, TwoSquaresFaceEachOther)
{
    // Unit squares at a distance of 1: 0.199825; at half of it 0.415253; at twice 0.068590.
    const struct {
        float distance;
        double factor;
    } cases[] = {{1.0f, 0.199825}, {0.5f, 0.415253}, {2.0f, 0.068590}};
    for (const auto& c : cases) {
        Scene scene = empty_scene();
        add_face(scene, {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
        add_face(scene, {0, c.distance, 0}, {1, 0, 0}, {0, 0, 1});
        PatchOptions options;
        options.cell_m = 0.1f;
        options.rays = 1024;
        const Cut cut(scene, options);
        EXPECT_NEAR(form_factor(cut.patches, {0, 1, 0}, {0, -1, 0}), c.factor, 0.002)
            << c.distance;
    }
}

// What a surface sends to a whole is what it sends to the parts.
TEST(Patches, FormFactorsAdd)
{
    const Cut cut(room(), half_metre(64));
    const Patches& p = cut.patches;
    for (std::uint32_t i = 0; i < p.count; ++i) {
        double parts = 0.0;
        for (int axis = 0; axis < 6; ++axis) {
            int count = 0;
            for (int r = 0; r < p.rays; ++r) count += axis_of(p.key[p.row(i)[r]]) == axis ? 1 : 0;
            parts += static_cast<double>(count) / p.rays;
        }
        ASSERT_EQ(parts, 1.0) << "patch " << i;
    }
}

// |A_i F_ij - A_j F_ji| falls like 1 / sqrt(N).
TEST(Patches, ReciprocityComesWithMoreRays)
{
    std::vector<double> asymmetry;
    for (const int rays : {64, 256, 1024}) {
        const Cut cut(room(), half_metre(rays));
        const Patches& p = cut.patches;
        std::map<std::pair<std::uint32_t, std::uint32_t>, double> sent;
        for (std::uint32_t i = 0; i < p.count; ++i) {
            for (int r = 0; r < p.rays; ++r)
                sent[{i, p.row(i)[r]}] += static_cast<double>(p.area_m2[i]) / p.rays;
        }
        double difference = 0.0, sum = 0.0;
        for (const auto& [pair, there] : sent) {
            const auto back = sent.find({pair.second, pair.first});
            const double other = back == sent.end() ? 0.0 : back->second;
            // Pairs with both ways come twice, the others once.
            const double weight = back == sent.end() ? 1.0 : 0.5;
            difference += weight * std::abs(there - other);
            sum += weight * (there + other);
        }
        asymmetry.push_back(difference / sum);
    }
    EXPECT_NEAR(asymmetry[0], 0.67, 0.08);
    EXPECT_NEAR(asymmetry[1], 0.42, 0.06);
    EXPECT_NEAR(asymmetry[2], 0.23, 0.05);
}

TEST(Patches, OpenGroundSeesTheSky)
{
    Scene scene = empty_scene();
    add_face(scene, {-20, 0, -20}, {0, 0, 40}, {40, 0, 0});
    const Cut cut(scene, half_metre(64));
    ASSERT_GT(cut.patches.count, 0u);
    EXPECT_LT(cut.patches.count, 600u) << "flat open ground stays coarse";
    for (std::uint32_t i = 0; i < cut.patches.count; ++i) {
        EXPECT_EQ(cut.patches.sky_view[i], 1.0f);
        EXPECT_EQ(cut.patches.open[i], 1.0f);
        for (const std::uint32_t word : cut.patches.visible[i]) EXPECT_EQ(word, 0xffffffffu);
    }
}

// The view factor of an infinite wall from the ground beside it is (1 - cos) / 2 of the height's
// angle; bits and links agree on the rest.
TEST(Patches, SkyViewBesideAWallIsTheClosedForm)
{
    Scene scene = empty_scene();
    add_face(scene, {-200, 0, 0}, {0, 0, 40}, {400, 0, 0});
    add_face(scene, {-200, 0, 0}, {400, 0, 0}, {0, 5, 0});  // faces +z
    const Cut cut(scene, half_metre(256));
    const Patches& p = cut.patches;
    double error = 0.0;
    int counted = 0;
    for (std::uint32_t i = 0; i < p.count; ++i) {
        if (p.normal[i].y < 0.9f || std::abs(p.position_m[i].x) > 20.0f) continue;
        if (p.position_m[i].z < 0.2f) continue;
        const double z = static_cast<double>(p.position_m[i].z);
        const double wall = 0.5 * (1.0 - z / std::sqrt(z * z + 25.0));
        EXPECT_NEAR(static_cast<double>(p.sky_view[i]), 1.0 - wall, 0.06) << "at " << z << " m";
        double bits = 0.0;
        for (int b = 0; b < 256; ++b) {
            const std::uint32_t word = p.visible[i][static_cast<std::size_t>(b >> 5)];
            if (!((word >> (b & 31)) & 1u)) continue;
            const glm::vec3 d = glm::normalize(shared::visibility_raw_direction(b));
            bits += static_cast<double>(shared::visibility_solid_angle(b) * d.y) /
                    std::numbers::pi;
        }
        error += std::abs(bits - (1.0 - wall));
        ++counted;
    }
    ASSERT_GT(counted, 20);
    EXPECT_LT(error / counted, 0.015);
}

TEST(Patches, VisibilityBitsCoverTheHemisphere)
{
    double sum = 0.0;
    for (int bit = 0; bit < 256; ++bit) {
        sum += static_cast<double>(shared::visibility_solid_angle(bit));
        const glm::vec3 d = glm::normalize(shared::visibility_raw_direction(bit));
        const glm::vec2 back = shared::visibility_texel(d);
        EXPECT_NEAR(back.x, static_cast<float>(bit % 16) + 0.5f, 1e-4f);
        EXPECT_NEAR(back.y, static_cast<float>(bit / 16) + 0.5f, 1e-4f);
    }
    EXPECT_NEAR(sum, 2.0 * std::numbers::pi, 0.02);
}

TEST(Patches, KeysAreDistinctAndFound)
{
    const Cut cut(room(), half_metre(16));
    const Patches& p = cut.patches;
    std::set<std::pair<std::uint32_t, std::uint32_t>> keys;
    for (std::uint32_t node = 0; node < p.nodes(); ++node) {
        keys.insert({p.key[node].low, p.key[node].high});
        EXPECT_EQ(find_node(p, p.key[node]), node);
    }
    EXPECT_EQ(keys.size(), p.nodes());
    for (std::uint32_t i = 0; i < p.count; ++i) {
        for (int k = 0; k < kPatchSamples; ++k) {
            const SamplePoint s =
                sample_point(cut.triangles, p.samples[std::size_t{i} * kPatchSamples +
                                                      static_cast<std::size_t>(k)]);
            EXPECT_EQ(patch_at(p, s.position_m, s.normal).value_or(~0u), i);
        }
    }
}

// Sun from the east: the ground west of a wall is dark, east of it lit.
TEST(Patches, AWallShadowsOneSide)
{
    Scene scene = empty_scene();
    add_face(scene, {-20, 0, -20}, {0, 0, 40}, {40, 0, 0});
    add_box(scene, {-0.2f, 0.0f, -15.0f}, {0.2f, 4.0f, 15.0f}, false);
    const Cut cut(scene, half_metre(64));
    const glm::vec3 sun = glm::normalize(glm::vec3(1.0f, 1.0f, 0.0f));
    const auto west = patch_at(cut.patches, {-1.5f, 0.0f, 0.0f}, {0, 1, 0});
    const auto east = patch_at(cut.patches, {1.5f, 0.0f, 0.0f}, {0, 1, 0});
    ASSERT_TRUE(west && east);
    EXPECT_LT(visible_share(cut.patches, *west, sun), 0.05f);
    EXPECT_GT(visible_share(cut.patches, *east, sun), 0.95f);
    EXPECT_EQ(visible_share(cut.patches, *east, -sun), 0.0f);
}

std::string bytes_of(const Patches& p)
{
    std::string all;
    const auto add = [&](const auto& list) {
        if (list.empty()) return;
        all.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(list[0]));
    };
    add(p.key);
    add(p.position_m);
    add(p.normal);
    add(p.area_m2);
    add(p.connected);
    add(p.open);
    add(p.children);
    add(p.material);
    add(p.sky_view);
    add(p.links);
    add(p.visible);
    add(p.table);
    return all;
}

Scene yard()
{
    Scene scene = empty_scene();
    add_face(scene, {-12, 0, -12}, {0, 0, 24}, {24, 0, 0});
    add_box(scene, {-3.0f, 0.0f, -2.0f}, {1.0f, 3.0f, -1.9f}, false);
    add_box(scene, {2.0f, 0.0f, 1.0f}, {2.5f, 0.5f, 1.5f}, false);
    return scene;
}

TEST(Patches, TheSameBytesForAnyNumberOfThreads)
{
    PatchOptions options = half_metre(64);
    options.threads = 1;
    const std::string one = bytes_of(Cut(yard(), options).patches);
    for (const int threads : {2, 3, 8}) {
        options.threads = threads;
        EXPECT_EQ(bytes_of(Cut(yard(), options).patches), one) << threads;
    }
}

// A row as what it names: keys of patches, or the number of a sky bin.
std::vector<std::uint64_t> named_row(const Patches& p, std::uint32_t i)
{
    std::vector<std::uint64_t> row;
    for (int r = 0; r < p.rays; ++r) {
        const std::uint32_t id = p.row(i)[r];
        row.push_back(id < p.count
                          ? (std::uint64_t{p.key[id].high} << 32) | p.key[id].low
                          : ~std::uint64_t{id - p.count});
    }
    return row;
}

TEST(Patches, WhatIsAddedElsewhereKeepsRowsThatDoNotSeeIt)
{
    // A hall with thick walls: what is put into it is seen from within only.
    Scene without = empty_scene();
    add_face(without, {-12, 0, -12}, {0, 0, 24}, {24, 0, 0});
    add_box(without, {-4.0f, 0.0f, -4.0f}, {4.0f, 8.0f, 4.0f}, false);
    add_box(without, {-3.5f, 4.0f, -3.5f}, {3.5f, 7.0f, 3.5f}, true);
    Scene with = without;
    add_box(with, {1.0f, 4.0f, 1.0f}, {1.6f, 4.5f, 1.6f}, false);
    const Cut a(without, half_metre(64)), b(with, half_metre(64));
    std::size_t same = 0, outside = 0, within = 0, changed = 0;
    for (std::uint32_t i = 0; i < a.patches.count; ++i) {
        const std::uint32_t j = find_node(b.patches, a.patches.key[i]);
        const glm::vec3 x = a.patches.position_m[i];
        if (x.y > 3.9f && x.y < 7.1f && std::abs(x.x) < 3.6f && std::abs(x.z) < 3.6f) {
            ++within;
            if (j >= b.patches.count || named_row(a.patches, i) != named_row(b.patches, j))
                ++changed;
            continue;
        }
        ++outside;
        ASSERT_LT(j, b.patches.count);
        if (named_row(a.patches, i) == named_row(b.patches, j)) ++same;
    }
    ASSERT_GT(outside, 100u);
    EXPECT_EQ(same, outside);
    ASSERT_GT(within, 100u);
    EXPECT_GT(changed, within / 4);
}

TEST(Patches, LightPassesWhereAlphaIsZero)
{
    Scene scene = empty_scene();
    add_face(scene, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
    Material leaf;
    leaf.alpha_mode = AlphaMode::Mask;
    leaf.double_sided = true;
    leaf.base_color_texture.texture = 0;
    scene.textures.resize(1);
    const std::size_t roof = add_material(scene, leaf);
    add_face(scene, {-20, 1, -20}, {0, 0, 40}, {40, 0, 0}, roof);
    const auto sky = [&](std::uint8_t left, std::uint8_t right) {
        const Cut cut(scene, half_metre(64), {{2, 1, {left, right}}});
        double sum = 0.0, area = 0.0;
        for (std::uint32_t i = 0; i < cut.patches.count; ++i) {
            if (cut.patches.position_m[i].y > 0.5f) continue;
            sum += static_cast<double>(cut.patches.sky_view[i] * cut.patches.area_m2[i]);
            area += static_cast<double>(cut.patches.area_m2[i]);
        }
        return sum / area;
    };
    EXPECT_NEAR(sky(0, 0), 1.0, 1e-6);
    EXPECT_LT(sky(255, 255), 0.01);
    EXPECT_NEAR(sky(0, 255), 0.5, 0.05);
}

TEST(Patches, AnyTrianglesAreDefined)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    {
        const Cut nothing(empty_scene(), half_metre());
        EXPECT_EQ(nothing.patches.count, 0u);
        EXPECT_FALSE(patch_at(nothing.patches, {0, 0, 0}, {0, 1, 0}));
    }
    {
        Scene scene = room();
        add_face(scene, {nan, 0, 0}, {0, 0, 1}, {1, 0, 0});
        add_face(scene, {0, 0, 0}, {0, 0, 0}, {1, 0, 0});
        const Cut cut(scene, half_metre(64));
        EXPECT_EQ(cut.patches.count, 486u);
        EXPECT_EQ(cut.triangles.left_out_degenerate(), 4u);
    }
    {
        // Inside out, it is a solid box, seen from where its faces look; nothing within is lit.
        Scene scene = room();
        for (auto& mesh : scene.meshes) {
            auto& indices = mesh.primitives[0].indices;
            for (std::size_t i = 0; i < indices.size(); i += 3) std::swap(indices[i], indices[i + 1]);
        }
        const Cut cut(scene, half_metre(64));
        ASSERT_EQ(cut.patches.count, 486u);
        for (std::uint32_t i = 0; i < cut.patches.count; ++i) {
            const float up = cut.patches.normal[i].y;
            EXPECT_NEAR(cut.patches.sky_view[i], 0.5f * (1.0f + up), 0.12f);
            for (int r = 0; r < cut.patches.rays; ++r)
                EXPECT_GE(cut.patches.row(i)[r], cut.patches.count) << "sees the sky alone";
        }
    }
    {
        Scene scene = empty_scene();  // one triangle of 10 km
        Primitive& p = scene.meshes[0].primitives[0];
        p.positions = {{0, 0, 0}, {0, 0, 1e4f}, {1e4f, 0, 0}};
        p.normals.assign(3, {0, 1, 0});
        p.indices = {0, 1, 2};
        PatchOptions options;
        options.rays = 16;
        const Cut cut(scene, options);
        EXPECT_GT(cut.patches.count, 20u);
        EXPECT_LT(cut.patches.count, 2000u);
        double area = 0.0;
        for (std::uint32_t i = 0; i < cut.patches.count; ++i)
            area += static_cast<double>(cut.patches.area_m2[i]);
        EXPECT_NEAR(area, 5e7, 5e5);
    }
}

TEST(Patches, OptionsOutOfRangeAreRefused)
{
    const Scene scene = room();
    const Triangles triangles(scene, {});
    const Tracer tracer(triangles);
    for (const auto spoil : {+[](PatchOptions& o) { o.rays = 5; },
                             +[](PatchOptions& o) { o.rays = 5000; },
                             +[](PatchOptions& o) { o.cell_m = -1.0f; },
                             +[](PatchOptions& o) { o.cell_m = std::nanf(""); },
                             +[](PatchOptions& o) { o.max_patches = 0; },
                             +[](PatchOptions& o) { o.max_patches = 65000; }}) {
        PatchOptions options;
        spoil(options);
        EXPECT_THROW(build_patches(tracer, options), Error);
    }
    PatchOptions stopped;
    stopped.stop = [] { return true; };
    EXPECT_THROW(build_patches(tracer, stopped), Interrupted);
}

}  // namespace
}  // namespace petrichor::scene
