// Where water drips from: roofs, sheets, boxes and what is near them.
#include "scene/drips/drip_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "tests/scene/patch_scenes.h"

namespace petrichor::scene {
namespace {

using namespace patch_scenes;

Scene on_ground()
{
    Scene scene = empty_scene();
    add_face(scene, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
    return scene;
}

// A sheet two metres deep in plan that comes down to an edge of 4 m at x = 2, 3 m above the ground.
void add_awning(Scene& scene)
{
    add_face(scene, {0, 4, 4}, {2, -1, 0}, {0, 0, -4});
}

std::vector<DripPoint> points_of(const Scene& scene, const DripOptions& options = {})
{
    const Triangles triangles(scene, {});
    return drip_points(Tracer(triangles), options);
}

float drained_m2(const std::vector<DripPoint>& points)
{
    float sum = 0.0f;
    for (const DripPoint& p : points) sum += p.drained_m2;
    return sum;
}

TEST(DripPoints, AreOnTheLowerEdgeAlone)
{
    Scene scene = on_ground();
    add_awning(scene);
    const std::vector<DripPoint> points = points_of(scene);
    EXPECT_NEAR(static_cast<double>(points.size()), 100.0, 20.0);
    for (const DripPoint& p : points) {
        EXPECT_NEAR(p.from_m.x, 2.015f, 1e-4f);
        EXPECT_NEAR(p.from_m.y, 3.0f, 1e-4f);
        EXPECT_GE(p.from_m.z, 0.0f);
        EXPECT_LE(p.from_m.z, 4.0f);
        EXPECT_NEAR(p.ground_m, 0.0f, 1e-4f);
    }
    // All that falls on the sheet comes off it.
    EXPECT_NEAR(drained_m2(points), 8.0f, 1.6f);
}

TEST(DripPoints, NoneUnderARoofAndLessUnderHalfOfOne)
{
    Scene whole = on_ground();
    add_awning(whole);
    const float open_m2 = drained_m2(points_of(whole));
    Scene half = whole;
    add_face(half, {-5, 6, 9}, {6, 0, 0}, {0, 0, -14});  // over the upper half
    // The roof drips too, higher up.
    float half_m2 = 0.0f;
    for (const DripPoint& p : points_of(half)) half_m2 += p.from_m.y < 5.0f ? p.drained_m2 : 0.0f;
    EXPECT_NEAR(half_m2 / open_m2, 0.5f, 0.15f);
    Scene roofed = whole;
    add_face(roofed, {-5, 6, 9}, {14, 0, 0}, {0, 0, -14});
    for (const DripPoint& p : points_of(roofed)) EXPECT_GT(p.from_m.y, 5.0f);
    roofed.materials[0].weather.sheltered = true;
    EXPECT_TRUE(points_of(roofed).empty());
}

// Of what runs over where it freezes: below the outer side of a gutter, and of nothing else that catches water.
TEST(DripPoints, AreBelowTheOuterSideOfAGutterIfAsked)
{
    const DripOptions options{.gutters = true};
    Scene bare = on_ground();
    add_awning(bare);
    EXPECT_EQ(points_of(bare, options).size(), points_of(bare).size());
    for (const DripPoint& p : points_of(bare, options)) EXPECT_EQ(p.gutter, 0u);

    Scene gutter = bare;  // of 12 by 8 cm below the edge
    add_box(gutter, {1.98f, 2.88f, -0.2f}, {2.10f, 2.96f, 4.2f}, false);
    const auto points = points_of(gutter, options);
    std::vector<DripPoint> over;
    for (const DripPoint& p : points)
        if (p.gutter != 0) over.push_back(p);
    EXPECT_NEAR(static_cast<double>(over.size()), 100.0, 20.0);
    for (const DripPoint& p : over) {
        EXPECT_NEAR(p.from_m.x, 2.10f, 1e-3f);
        EXPECT_NEAR(p.from_m.y, 2.88f, 1e-3f);
        EXPECT_NEAR(p.ground_m, 0.0f, 1e-3f);
    }
    EXPECT_NEAR(drained_m2(over), 8.0f, 1.6f) << "all that falls on the sheet";
    for (const DripPoint& p : points_of(gutter)) EXPECT_EQ(p.gutter, 0u);

    Scene rows = on_ground();  // tiles over tiles: the next row is no gutter
    add_awning(rows);
    add_face(rows, {1.9f, 2.98f, 4}, {2, -1, 0}, {0, 0, -4});
    for (const DripPoint& p : points_of(rows, options)) EXPECT_EQ(p.gutter, 0u);
}

TEST(DripPoints, NoneIntoAGutterOnWallsOnTheGroundOrAtTheRimOfTheScene)
{
    Scene gutter = on_ground();
    add_awning(gutter);
    const std::size_t open = points_of(gutter).size();
    add_face(gutter, {1.9f, 2.8f, 4.2f}, {0.3f, 0, 0}, {0, 0, -4.4f});  // below the edge
    for (const DripPoint& p : points_of(gutter)) EXPECT_LT(p.from_m.y, 2.85f);
    EXPECT_GT(open, 0u);

    Scene block = on_ground();  // water runs down its walls
    add_box(block, {-1, 0, -1}, {1, 2, 1}, false);
    EXPECT_TRUE(points_of(block).empty());

    Scene sheet = empty_scene();
    add_awning(sheet);
    EXPECT_TRUE(points_of(sheet).empty());
}

TEST(DripPoints, ABoardDripsFromItsFootAndABeamFromBothSides)
{
    Scene scene = on_ground();
    add_box(scene, {-2, 2.0f, -0.05f}, {2, 2.1f, 0.05f}, false);  // a beam 10 cm wide
    const std::vector<DripPoint> points = points_of(scene);
    ASSERT_GT(points.size(), 100u);
    for (const DripPoint& p : points) EXPECT_NEAR(p.from_m.y, 2.0f, 0.021f);
    const auto front = std::count_if(points.begin(), points.end(), [](const DripPoint& p) { return p.from_m.z > 0.05f; });
    EXPECT_NEAR(static_cast<double>(front) / static_cast<double>(points.size()), 0.5, 0.1);
    EXPECT_NEAR(drained_m2(points), 0.4f, 0.15f);
}

TEST(DripPoints, TheLongestEdgesWhenThereAreTooMany)
{
    Scene scene = on_ground();
    add_face(scene, {0, 4, -2}, {2, -1, 0}, {0, 0, -1});
    add_awning(scene);
    DripOptions few;
    few.most_points = 60;
    const std::vector<DripPoint> points = points_of(scene, few);
    EXPECT_EQ(points.size(), 60u);
    for (const DripPoint& p : points) EXPECT_GE(p.from_m.z, 0.0f);
}

TEST(DripPoints, LeavesLetNoneGoAndTheyAreAlikeEachTime)
{
    Scene scene = on_ground();
    add_awning(scene);
    const std::vector<DripPoint> first = points_of(scene), again = points_of(scene);
    ASSERT_EQ(first.size(), again.size());
    EXPECT_EQ(std::memcmp(first.data(), again.data(), first.size() * sizeof(DripPoint)), 0);
    const std::uint8_t leaves[] = {1};
    DripOptions options;
    options.left_out = leaves;
    EXPECT_TRUE(points_of(scene, options).empty());
}

}  // namespace
}  // namespace petrichor::scene
