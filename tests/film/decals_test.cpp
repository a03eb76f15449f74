#include "film/scenes/decals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "film/scenario/node_keys.h"

namespace petrichor::film {
namespace {

using testing::HasSubstr;

scene::Scene two_things()
{
    scene::Scene scene;
    scene.materials.resize(1);
    scene.materials[0].name = "brick";
    scene.instances.resize(1);
    scene.instances[0].name = "cart";
    scene.instances[0].to_world[3] = glm::vec4(5, 0, 0, 1);
    return scene;
}

scene::Scene with(const std::string& toml)
{
    scene::Scene scene = two_things();
    const Scenario scenario = parse_scenario(toml, "s.toml");
    add_decals(scenario.decals, scenario.materials, scene);
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

TEST(DecalKeys, PlaceABox)
{
    const scene::Scene scene = with(
        "[decals.brick]\ncenter_m = [1, 2, 3]\nsize_m = [4, 2, 0.5]\ndirection = [0, 0, -2]\n"
        "fade_degrees = [30, 60]\nedge_fade = 0.25\n");
    ASSERT_EQ(scene.decals.size(), 1u);
    const scene::ProjectedDecal& box = scene.decals[0];
    EXPECT_EQ(box.material, 0u);
    EXPECT_NEAR(box.to_world[0].x, 4.0f, 1e-5f);
    EXPECT_NEAR(box.to_world[1].y, 2.0f, 1e-5f);
    EXPECT_NEAR(box.to_world[2].z, 0.5f, 1e-5f);
    EXPECT_EQ(glm::vec3(box.to_world[3]), glm::vec3(1, 2, 3));
    EXPECT_NEAR(box.none_angle_rad, 1.0472f, 1e-4f);
    EXPECT_EQ(box.edge_fade, 0.25f);
    EXPECT_EQ(scene.materials.size(), 1u);
}

TEST(DecalKeys, LieOnTheGroundByThemselvesAndTurn)
{
    const scene::Scene scene = with("[decals.brick]\nturn_degrees = 90\n");
    const glm::mat4& m = scene.decals[0].to_world;
    // Looked at from above, its x has turned from east to north.
    EXPECT_NEAR(m[0].z, -1.0f, 1e-5f);
    EXPECT_NEAR(m[2].y, 0.5f, 1e-5f);
    EXPECT_GT(glm::determinant(glm::mat3(m)), 0.0f);
}

TEST(DecalKeys, MakeAMaterialForTheScenarioToDescribe)
{
    const scene::Scene scene =
        with("[decals.sign]\nmaterial = \"poster\"\n[materials.\"post*\"]\nroughness_factor = 0.3\n");
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.materials[1].name, "poster");
    EXPECT_TRUE(scene.materials[1].decal.on);
    EXPECT_EQ(scene.decals[0].material, 1u);
    EXPECT_THAT(said("[decals.sign]\nmaterial = \"poster\"\n"), HasSubstr("neither the scene has"));
}

TEST(DecalKeys, HangOnANode)
{
    const scene::Scene scene = with("[decals.brick]\nnode = \"cart\"\ncenter_m = [0, 1, 0]\n");
    EXPECT_EQ(glm::vec3(scene.decals[0].to_world[3]), glm::vec3(5, 1, 0));
    EXPECT_THAT(said("[decals.brick]\nnode = \"card\"\n"), HasSubstr("cart"));
}

TEST(DecalKeys, RefuseWhatCannotBe)
{
    EXPECT_THAT(said("[decals.brick]\nsize_m = [1, 0, 1]\n"), HasSubstr("size_m"));
    EXPECT_THAT(said("[decals.brick]\ndirection = [0, 0, 0]\n"), HasSubstr("a direction"));
    EXPECT_THAT(said("[decals.brick]\nfade_degrees = [60, 30]\n"), HasSubstr("the second larger"));
    EXPECT_THAT(said("[decals.brick]\ncentre_m = [1, 1, 1]\n"), HasSubstr("center_m"));
}

TEST(DecalKeys, HaveNoSurfaceOfTheirOwn)
{
    scene::Scene scene = with("[decals.sign]\nmaterial = \"poster\"\n[materials.poster]\nroughness_factor = 0.3\n");
    EXPECT_NO_THROW(check_decals(scene));
    scene.materials[1].lighting_model = "lambert";
    check_decals(scene);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0], HasSubstr("\"lambert\", which is left out"));
    scene.materials[1].surface = "moss.glsl";
    try {
        check_decals(scene);
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("the decal \"sign\" shows the material \"poster\""));
        EXPECT_THAT(error.what(), HasSubstr("moss.glsl"));
    }
}

TEST(NodeKeys, GiveThingsValuesOfTheirOwn)
{
    scene::Scene scene = two_things();
    scene.instances.push_back(scene.instances[0]);
    scene.instances[1].name = "cart 2";
    const Scenario scenario = parse_scenario(
        "[nodes.\"cart*\"]\ncolor = [1, 0.5, 0]\nroughness = 0.25\n"
        "[nodes.\"*2\"]\nroughness = 0.75\nemission = 3\nmetallic = 1\n"
        "[nodes.\"wheel\"]\nmetallic = 1\n",
        "s.toml");
    const auto unmatched = apply_node_overrides(scenario.nodes, scene);
    EXPECT_EQ(scene.instances[0].look.color, glm::vec3(1, 0.5f, 0));
    EXPECT_EQ(scene.instances[0].look.roughness, 0.25f);
    EXPECT_FALSE(scene.instances[0].look.metallic.has_value());
    EXPECT_EQ(scene.instances[1].look.color, glm::vec3(1, 0.5f, 0));
    EXPECT_EQ(scene.instances[1].look.roughness, 0.75f);
    EXPECT_EQ(scene.instances[1].look.emission, 3.0f);
    ASSERT_EQ(unmatched.size(), 1u);
    EXPECT_THAT(unmatched[0], HasSubstr("cart, cart 2"));
    EXPECT_THROW(parse_scenario("[nodes.a]\ncolor = [2, 0, 0]\n", "s.toml"), Error);
}

}  // namespace
}  // namespace petrichor::film
