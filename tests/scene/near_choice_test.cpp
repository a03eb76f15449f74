// Which polygons are close to a patch: what is asked, which faces are one, what is found and what is shared.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "scene/patches/detail/near_choice.h"
#include "scene/patches/detail/near_faces.h"
#include "scene/patches/detail/near_sources.h"
#include "scene/patches/detail/sampling.h"
#include "tests/scene/near_scenes.h"

namespace petrichor::scene {
namespace {

using namespace near_scenes;

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

}  // namespace
}  // namespace petrichor::scene
