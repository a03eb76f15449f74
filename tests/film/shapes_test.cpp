#include "film/scenes/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "film/scenario/shape_keys.h"
#include "formulas/geometry/shapes.h"
#include "scene/shapes.h"

namespace petrichor::film {
namespace {

using testing::HasSubstr;

scene::Scene with(const std::string& toml, double time_s = -1.0, std::vector<scene::ShapeMoment>* moments = nullptr)
{
    scene::Scene scene;
    scene.materials.resize(1);
    scene.materials[0].name = "brick";
    const Scenario scenario = parse_scenario(toml, "s.toml");
    add_shapes(scenario.shapes, scenario.materials, scene);
    check_shapes(scene);
    if (moments) *moments = shape_moments(scenario.shapes, scene, time_s);
    return scene;
}

std::string said(const std::string& toml)
{
    try {
        with(toml);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(ShapeKeys, PlaceASponge)
{
    const scene::Scene scene = with(
        "[shapes.brick]\nkind = \"menger\"\ncenter_m = [1, 2, 3]\nsize_m = 3\nturn_degrees = [0, 90, 0]\niterations = 4\n");
    ASSERT_EQ(scene.shapes.size(), 1u);
    const scene::MarchedShape& s = scene.shapes[0];
    EXPECT_EQ(s.kind, SHAPE_MENGER);
    EXPECT_EQ(s.material, 0u);
    EXPECT_EQ(s.iterations, 4);
    // An edge of 3 m, its x turned to the north.
    EXPECT_NEAR(s.rest.to_world[0].z, -1.5f, 1e-5f);
    EXPECT_EQ(glm::vec3(s.rest.to_world[3]), glm::vec3(1, 2, 3));
    const scene::Bounds bounds = scene::scene_bounds(scene);
    EXPECT_NEAR(bounds.low.x, -0.5f, 1e-5f);
    EXPECT_NEAR(bounds.high.z, 4.5f, 1e-5f);
    EXPECT_EQ(scene.materials.size(), 1u);
}

TEST(ShapeKeys, HaveTheSizesTheySay)
{
    const auto height = [](const std::string& rest) {
        const scene::Scene scene = with("[shapes.brick]\n" + rest);
        const scene::Bounds bounds = scene::scene_bounds(scene);
        return bounds.high - bounds.low;
    };
    EXPECT_NEAR(height("kind = \"sphere\"\nsize_m = 3\n").y, 3.0f, 1e-5f);
    EXPECT_NEAR(height("kind = \"box\"\nsize_m = 2\nsides = [1, 0.5, 2]\n").z, 4.0f, 1e-5f);
    EXPECT_NEAR(height("kind = \"torus\"\nsize_m = 2\ntube = 0.25\n").x, 2.0f, 1e-5f);
    EXPECT_NEAR(height("kind = \"torus\"\nsize_m = 2\ntube = 0.25\n").y, 0.5f, 1e-5f);
}

TEST(ShapeKeys, ATetrahedronStandsOnAFace)
{
    const scene::Scene scene = with("[shapes.brick]\nkind = \"sierpinski\"\nsize_m = 2\n");
    const glm::mat4& m = scene.shapes[0].rest.to_world;
    const glm::vec3 corners[] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    EXPECT_NEAR((m * glm::vec4(corners[0], 1)).y, 1.2247449f, 1e-5f) << "one above, sqrt(3/8) edges";
    for (int i = 1; i < 4; ++i) EXPECT_NEAR((m * glm::vec4(corners[i], 1)).y, -0.4082483f, 1e-5f);
    EXPECT_NEAR(glm::length(glm::vec3(m * glm::vec4(corners[0] - corners[1], 0))), 2.0f, 1e-5f);
    EXPECT_GT(glm::determinant(glm::mat3(m)), 0.0f);
}

TEST(ShapeKeys, ChangeOverTime)
{
    const std::string toml =
        "[shapes.brick]\nkind = \"mandelbulb\"\npower = [[0, 2], [10, 8]]\ncenter_m = [[0, [0, 1, 0]], [10, [4, 1, 0]]]\n"
        "size_m = [[0, 1], [10, 2]]\n";
    std::vector<scene::ShapeMoment> moments;
    const scene::Scene scene = with(toml, 10.0, &moments);
    ASSERT_EQ(moments.size(), 1u);
    EXPECT_EQ(moments[0].power, 8.0f);
    EXPECT_EQ(moments[0].to_world[3].x, 4.0f);
    EXPECT_NEAR(moments[0].to_world[0].x, 1.0f, 1e-6f);
    EXPECT_EQ(scene.shapes[0].rest.power, 2.0f);
    // All its moments lie in its reach.
    ASSERT_TRUE(scene.shapes[0].reach.has_value());
    const scene::Bounds& reach = *scene.shapes[0].reach;
    for (double t = -1.0; t <= 11.0; t += 0.5) {
        with(toml, t, &moments);
        const scene::Bounds now = scene::shape_bounds(scene.shapes[0], moments[0]);
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(now.low[c], reach.low[c] - 1e-5f) << t;
            EXPECT_LE(now.high[c], reach.high[c] + 1e-5f) << t;
        }
    }
    with("[shapes.brick]\nkind = \"mandelbulb\"\n", 3.0, &moments);
    EXPECT_TRUE(moments.empty()) << "it rests";
}

TEST(ShapeKeys, MakeAMaterialForTheScenarioToDescribe)
{
    const scene::Scene scene = with("[shapes.moon]\nkind = \"sphere\"\n[materials.\"mo*\"]\nroughness_factor = 0.3\n");
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.materials[1].name, "moon");
    EXPECT_EQ(scene.materials[1].metallic, 0.0f);
}

TEST(ShapeKeys, RefuseWhatCannotBe)
{
    EXPECT_THAT(said("[shapes.brick]\nkind = \"mengr\"\n"), HasSubstr("menger"));
    EXPECT_THAT(said("[shapes.brick]\nkid = \"menger\"\n"), HasSubstr("Did you mean \"kind\""));
    EXPECT_THAT(said("[shapes.brick]\nsize_m = 2\n"), HasSubstr("s.toml:1: the shape \"brick\" has no kind"));
    EXPECT_THAT(said("[shapes.brick]\nkind = \"menger\"\nsize_m = 0\n"), HasSubstr("size_m"));
    EXPECT_THAT(said("[shapes.brick]\nkind = \"mandelbulb\"\npower = nan\n"), HasSubstr("power"));
    EXPECT_THAT(said("[shapes.brick]\nkind = \"mandelbulb\"\npower = 40\n"), HasSubstr("power"));
    EXPECT_THAT(said("[shapes.brick]\nkind = \"menger\"\niterations = 1000000\n"), HasSubstr("iterations"));
    EXPECT_THAT(said("[shapes.brick]\nkind = \"menger\"\niterations = 12\n"), HasSubstr("1 to 10"));
    EXPECT_THAT(said("[shapes.brick]\nkind = \"menger\"\npower = 3\n"), HasSubstr("which has no power"));
    EXPECT_THAT(said("[shapes.brick]\nkind = \"sphere\"\niterations = 3\n"), HasSubstr("which has no iterations"));
    EXPECT_THAT(said("[shapes.stone]\nkind = \"menger\"\nmaterial = \"brik\"\n"), HasSubstr("Did you mean \"brick\""));
    EXPECT_EQ(said("[shapes.brick]\nkind = \"menger\"\n"), "");
}

}  // namespace
}  // namespace petrichor::film
