#include "film/scenario/material_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "film/jobs/scene_source.h"
#include "film/scenes/texture_plan.h"
#include "tests/support/program.h"

namespace petrichor::film {
namespace {

using testing::HasSubstr;
using testing_program::Workplace;

std::string message_of(const std::string& toml)
{
    try {
        parse_scenario(toml, "s.toml");
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

scene::Scene two_materials()
{
    scene::Scene scene;
    scene.materials.resize(2);
    scene.materials[0].name = "stone";
    scene.materials[1].name = "brick";
    return scene;
}

TEST(MaterialOverrides, MatchByGlobAndTheLaterOneWins)
{
    const Scenario scenario = parse_scenario(
        "[materials.\"z*\"]\nporosity = 0.1\n[materials.\"*stone\"]\nporosity = 0.9\n"
        "snow_accumulation = [0.5, 2]\n[materials.\"nothing\"]\nsheltered = true\n",
        "s.toml");
    std::vector<scene::Material> materials(2);
    materials[0].name = "z_stone";
    materials[1].name = "brick";
    scene::Scene scene;
    scene.materials = materials;
    const auto unmatched = apply_material_overrides(scenario.materials, {}, scene).unmatched;
    materials = scene.materials;
    EXPECT_FLOAT_EQ(materials[0].weather.porosity, 0.9f);
    EXPECT_FLOAT_EQ(materials[0].weather.snow_accumulation.y, 2.0f);
    EXPECT_LT(materials[1].weather.porosity, 0.0f);
    ASSERT_EQ(unmatched.size(), 1u);
    EXPECT_THAT(unmatched[0], HasSubstr("s.toml:6"));
    EXPECT_THAT(unmatched[0], HasSubstr("z_stone, brick"));
}

TEST(MaterialOverrides, NumbersMayHaveKeysOverTime)
{
    const Scenario scenario = parse_scenario(
        "[materials.\"s*\"]\nroughness_factor = [[0, 0.8], [10, 0.2]]\n"
        "water_color = [[2, [0, 0, 0, 0]], [4, [1, 0.5, 0, 1]]]\nmetallic_factor = 0.25\n",
        "s.toml");
    scene::Scene scene = two_materials();
    apply_material_overrides(scenario.materials, {}, scene);
    EXPECT_FLOAT_EQ(scene.materials[0].roughness, 0.8f);  // the first key
    EXPECT_FLOAT_EQ(scene.materials[0].metallic, 0.25f);
    const auto at = [&](double time_s) {
        return material_changes(scenario.materials, scene.materials, time_s);
    };
    ASSERT_EQ(at(3.0).size(), 2u);
    EXPECT_EQ(at(0.0)[0], (scene::MaterialChange{0, "roughness_factor", {0.8f, 0, 0, 0}}));
    EXPECT_EQ(at(5.0)[0], (scene::MaterialChange{0, "roughness_factor", {0.5f, 0, 0, 0}}));
    EXPECT_EQ(at(99.0)[0], (scene::MaterialChange{0, "roughness_factor", {0.2f, 0, 0, 0}}));
    EXPECT_EQ(at(3.0)[1], (scene::MaterialChange{0, "water_color", {0.5f, 0.25f, 0.0f, 0.5f}}));
}

TEST(MaterialOverrides, ALaterConstantEndsTheKeys)
{
    const Scenario scenario = parse_scenario(
        "[materials.\"*\"]\nemissive_strength = [[0, 0], [1, 5]]\n"
        "[materials.\"brick\"]\nemissive_strength = 2\n",
        "s.toml");
    scene::Scene scene = two_materials();
    apply_material_overrides(scenario.materials, {}, scene);
    const auto changes = material_changes(scenario.materials, scene.materials, 1.0);
    ASSERT_EQ(changes.size(), 1u);
    EXPECT_EQ(changes[0], (scene::MaterialChange{0, "emissive_strength", {5.0f, 0, 0, 0}}));
    EXPECT_FLOAT_EQ(scene.materials[1].emissive_strength, 2.0f);
}

TEST(MaterialOverrides, KeysAreCheckedAsValuesAre)
{
    const std::string table = "[materials.\"*\"]\n";
    EXPECT_THAT(message_of(table + "roughness_factor = [[0, 0.5], [1, 1.5]]\n"),
                HasSubstr("a number from 0 to 1"));
    EXPECT_THAT(message_of(table + "roughness_factor = [[1, 0.5], [1, 0.6]]\n"),
                HasSubstr("later than the key before it"));
    EXPECT_THAT(message_of(table + "water_accumulation = [[0, [0, 1, 3, 1]], [1, [0, 1, 0, 1]]]\n"),
                HasSubstr("a number from 0 to 2"));
    EXPECT_THAT(message_of(table + "water_accumulation = [0, 1, 3, 1]\n"), HasSubstr("[2]"));
    EXPECT_THAT(message_of(table + "double_sided = [[0, true]]\n"), HasSubstr("true or false"));
}

// Under keys the roughness stays a factor of the picture's: no texture holds it.
TEST(MaterialOverrides, ARoughnessThatMovesIsNotFilteredIn)
{
    scene::Scene scene = two_materials();
    scene.textures.resize(2);
    for (scene::Material& material : scene.materials) {
        material.normal_texture.texture = 0;
        material.metallic_roughness_texture.texture = 1;
        material.roughness = 0.5f;
    }
    const auto recipes = plan_textures(scene, {true, false});
    EXPECT_FLOAT_EQ(scene.materials[0].roughness, 0.5f);
    EXPECT_FLOAT_EQ(scene.materials[1].roughness, 1.0f);
    const auto& still = scene.materials[1].metallic_roughness_texture;
    const auto& moving = scene.materials[0].metallic_roughness_texture;
    ASSERT_NE(still.texture, moving.texture);
    EXPECT_FLOAT_EQ(recipes[static_cast<std::size_t>(still.texture)].roughness_factor, 0.5f);
    EXPECT_FLOAT_EQ(recipes[static_cast<std::size_t>(moving.texture)].roughness_factor, 1.0f);
}

TEST(MaterialOverrides, TexturesAreFilesBesideTheScenario)
{
    const Workplace place("material-textures");
    testing_program::write_file(place / "moss.png", "first");
    scene::Scene scene = two_materials();
    scene.textures.resize(1);
    scene.textures[0].wrap_u = scene::Wrap::Mirror;
    scene.materials[0].base_color_texture = {.texture = 0, .texcoord = 1, .scale = {3.0f, 3.0f}};
    scene.materials[0].normal_texture.texture = 0;
    const Scenario scenario = parse_scenario(
        "[materials.\"stone\"]\nbase_color_texture = \"moss.png\"\nnormal_texture = \"\"\n"
        "[materials.\"brick\"]\nbase_color_texture = \"moss.png\"\n"
        "height_texture = \"moss.png\"\n",
        "s.toml");
    const auto applied = apply_material_overrides(scenario.materials, place.path(), scene);
    EXPECT_FALSE(scene.materials[0].normal_texture.present());
    ASSERT_EQ(scene.textures.size(), 3u);  // once mirrored, once repeated
    const scene::TextureUse& use = scene.materials[0].base_color_texture;
    EXPECT_EQ(use.texture, 1);
    EXPECT_EQ(use.texcoord, 1);
    EXPECT_EQ(use.scale, glm::vec2(3.0f));
    EXPECT_EQ(scene.textures[1].wrap_u, scene::Wrap::Mirror);
    EXPECT_EQ(scene.textures[1].bytes.size(), 5u);
    EXPECT_EQ(scene.materials[1].base_color_texture.texture, 2);
    EXPECT_EQ(scene.materials[1].weather.height.texture, 2);
    EXPECT_EQ(scene.textures[2].wrap_u, scene::Wrap::Repeat);

    testing_program::write_file(place / "moss.png", "other");
    scene::Scene again = two_materials();
    EXPECT_NE(apply_material_overrides(scenario.materials, place.path(), again).textures,
              applied.textures);
}

TEST(MaterialOverrides, AMissingTextureIsAnError)
{
    const Scenario scenario =
        parse_scenario("[materials.\"*\"]\nemissive_texture = \"no.png\"\n", "s.toml");
    scene::Scene scene = two_materials();
    try {
        apply_material_overrides(scenario.materials, "/nowhere", scene);
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("s.toml:1"));
        EXPECT_THAT(error.what(), HasSubstr("no.png"));
    }
}

}  // namespace
}  // namespace petrichor::film
