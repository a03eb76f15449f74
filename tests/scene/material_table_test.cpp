// The table of material properties: every row is kept by glTF, and says what it is.
#include "scene/material_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <span>
#include <string>

#include "base/error.h"
#include "scene/gltf/glb_writer.h"
#include "scene/gltf/gltf.h"

namespace petrichor::scene {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

// A value in range that is not the default.
glm::vec4 another_value(const MaterialProperty& property)
{
    glm::vec4 value = default_value(property);
    if (property.kind != PropertyKind::Number) {
        value.x = value.x == property.high.x ? property.low.x : property.high.x;
        return value;
    }
    for (int i = 0; i < property.count; ++i) {
        const float low = std::max(property.low[i], -2.0f);
        const float high = std::min(property.high[i], std::max(2.0f, low + 1.0f));
        const float step = 0.0625f * static_cast<float>(i + 1);
        value[i] = low + (high - low) * (0.25f + step);
        if (value[i] == default_value(property)[i]) value[i] = low + (high - low) * 0.125f;
    }
    return value;
}

Scene scene_with(const Material& material)
{
    Scene scene;
    const unsigned char png[] = {0x89, 'P', 'N', 'G', 1, 2, 3, 4};
    const auto* bytes = reinterpret_cast<const std::byte*>(png);
    scene.textures.push_back({.name = "image", .bytes = {bytes, bytes + sizeof(png)}});
    scene.materials.push_back(material);
    Primitive triangle;
    triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    triangle.normals.assign(3, {0, 0, 1});
    triangle.uv0 = {{0, 0}, {1, 0}, {0, 1}};
    triangle.uv1 = triangle.uv0;
    triangle.indices = {0, 1, 2};
    scene.meshes.push_back({"triangle", {triangle}});
    scene.instances.push_back({"one", 0, glm::mat4(1.0f)});
    return scene;
}

Material through_gltf(const Material& material)
{
    const Scene scene = load_gltf(write_glb(scene_with(material)), "scene.glb", nullptr);
    EXPECT_THAT(scene.warnings, IsEmpty());
    return scene.materials.front();
}

class Property : public testing::TestWithParam<const MaterialProperty*> {};

TEST_P(Property, IsKeptByGltf)
{
    const MaterialProperty& property = *GetParam();
    Material material;
    for (const MaterialTexture& texture : material_textures()) texture.edit(material).texture = 0;
    const glm::vec4 wanted = another_value(property);
    property.set(material, wanted);
    const Material read = through_gltf(material);
    for (const MaterialProperty& other : material_table()) {
        const glm::vec4 expected = &other == &property ? wanted : default_value(other);
        for (int i = 0; i < other.count; ++i) {
            EXPECT_FLOAT_EQ(other.get(read)[i], expected[i]) << other.name;
        }
    }
}

TEST_P(Property, SaysWhatItIs)
{
    const MaterialProperty& property = *GetParam();
    EXPECT_FALSE(property.help.empty());
    EXPECT_FALSE(property.help.ends_with("."));
    EXPECT_GE(property.count, 1);
    const glm::vec4 usual = default_value(property);
    for (int i = 0; i < property.count; ++i) {
        EXPECT_TRUE(property.accepts(i, usual[i]));
        EXPECT_FALSE(property.accepts(i, NAN));
        EXPECT_FALSE(property.range_text(i).empty());
    }
}

INSTANTIATE_TEST_SUITE_P(Table, Property, testing::ValuesIn([] {
                             std::vector<const MaterialProperty*> rows;
                             for (const auto& row : material_table()) rows.push_back(&row);
                             return rows;
                         }()),
                         [](const auto& test) { return std::string(test.param->name); });

TEST(MaterialTable, NamesAndPlacesAreUnique)
{
    std::set<std::string> names;
    std::set<std::string> places;
    const auto place = [](const GltfPlace& p) {
        return std::string(p.extension) + "/" + std::string(p.parent) + "/" + std::string(p.member);
    };
    for (const MaterialProperty& p : material_table()) {
        EXPECT_TRUE(names.insert(std::string(p.name)).second) << p.name;
        EXPECT_TRUE(places.insert(place(p.gltf)).second) << p.name;
    }
    for (const MaterialTexture& t : material_textures()) {
        EXPECT_TRUE(names.insert(std::string(t.name)).second) << t.name;
        EXPECT_TRUE(places.insert(place(t.gltf)).second) << t.name;
    }
}

TEST(MaterialTable, EveryTextureIsKeptByGltf)
{
    for (const MaterialTexture& texture : material_textures()) {
        Material material;
        texture.edit(material) = {.texture = 0, .texcoord = 1, .offset = {0.5f, 0.25f}};
        const Material read = through_gltf(material);
        for (const MaterialTexture& other : material_textures()) {
            const TextureUse& use = other.get(read);
            EXPECT_EQ(use.present(), &other == &texture) << other.name;
            if (use.present()) {
                EXPECT_EQ(use.texcoord, 1) << other.name;
                EXPECT_EQ(use.offset, glm::vec2(0.5f, 0.25f)) << other.name;
            }
        }
    }
}

TEST(MaterialTable, EmissionBeyondOneGoesIntoTheStrength)
{
    Material material;
    material.emissive = {20.0f, 10.0f, 5.0f};
    material.emissive_strength = 3.0f;
    const Material read = through_gltf(material);
    EXPECT_FLOAT_EQ(read.emissive.x, 1.0f);
    EXPECT_FLOAT_EQ(read.emissive.y, 0.5f);
    EXPECT_FLOAT_EQ(read.emissive_strength, 60.0f);
}

TEST(MaterialTable, WhatIsNotShadedIsSaidOnceForAScene)
{
    Scene scene = scene_with({});
    EXPECT_THAT(unshaded_properties(scene), IsEmpty());
    scene.meshes[0].primitives[0].weather.assign(3, {0.5f, 1, 1, 1});
    ASSERT_EQ(unshaded_properties(scene).size(), 1u);
    EXPECT_THAT(unshaded_properties(scene)[0], HasSubstr("1 mesh (triangle)"));
}

// The archived extension: its diffuse colour is the base colour, whatever stands beside it.
TEST(SpecularWorkflow, ReadsDiffuseAndSpecularInsteadOfMetal)
{
    const std::string gltf =
        R"({"asset":{"version":"2.0"},"materials":[{"name":"m","pbrMetallicRoughness":)"
        R"({"baseColorFactor":[1,0,0,1]},"extensions":{"KHR_materials_pbrSpecularGlossiness":)"
        R"({"diffuseFactor":[0.1,0.2,0.3,1],"specularFactor":[0.5,0.4,0.3],"glossinessFactor":0.7}}},)"
        R"({"name":"bare","extensions":{"KHR_materials_pbrSpecularGlossiness":{}}}]})";
    const Scene scene = load_gltf(std::as_bytes(std::span(gltf)), "scene.gltf", nullptr);
    EXPECT_THAT(scene.warnings, IsEmpty());
    const Material& m = scene.materials[0];
    EXPECT_TRUE(m.specular_workflow);
    EXPECT_EQ(m.base_color, glm::vec4(0.1f, 0.2f, 0.3f, 1.0f));
    EXPECT_EQ(m.workflow_specular, glm::vec3(0.5f, 0.4f, 0.3f));
    EXPECT_FLOAT_EQ(m.glossiness, 0.7f);
    EXPECT_EQ(scene.materials[1].base_color, glm::vec4(1.0f));
    EXPECT_EQ(scene.materials[1].workflow_specular, glm::vec3(1.0f));
    const Material again = through_gltf(m);
    EXPECT_TRUE(again.specular_workflow);
    EXPECT_EQ(again.base_color, m.base_color);
}

TEST(LayerTextures, MoreThanFitAreSaid)
{
    Scene scene = scene_with({});
    int given = 0;
    for (const MaterialTexture& texture : material_textures()) {
        const bool layer = texture.gltf.extension.starts_with("KHR_materials");
        if (layer && given < 7) {
            texture.edit(scene.materials[0]).texture = 0;
            ++given;
        }
    }
    ASSERT_EQ(unshaded_properties(scene).size(), 1u);
    EXPECT_THAT(unshaded_properties(scene)[0], HasSubstr("7 textures of layers; 6 are shown"));
    scene.materials[0] = {};
    scene.materials[0].maps.clearcoat.texture = 0;
    EXPECT_THAT(unshaded_properties(scene), IsEmpty());
    scene.materials[0].alpha_mode = AlphaMode::Blend;
    ASSERT_EQ(unshaded_properties(scene).size(), 1u);
    EXPECT_THAT(unshaded_properties(scene)[0], HasSubstr("lets light through"));
}

TEST(LayerTextures, AGroundWithoutWeightsIsSaid)
{
    Scene scene = scene_with({});
    scene.materials[0].second.use = SecondSetUse::Layers;
    ASSERT_EQ(unshaded_properties(scene).size(), 1u);
    EXPECT_THAT(unshaded_properties(scene)[0], HasSubstr("mix_mask_texture"));
    scene.materials[0].second.mix_mask.texture = 0;
    EXPECT_THAT(unshaded_properties(scene), IsEmpty());
}

TEST(LightingModel, IsKeptByGltf)
{
    Material material;
    material.lighting_model = "lambert";
    EXPECT_EQ(through_gltf(material).lighting_model, "lambert");
    material.lighting_model = "/somewhere/else/velvet.glsl";  // a file lies beside the scene
    EXPECT_EQ(through_gltf(material).lighting_model, "velvet.glsl");
    EXPECT_EQ(through_gltf(Material{}).lighting_model, "");
}

TEST(LightingModel, OfASceneNeverLeavesItsFolder)
{
    for (const char* name : {"../velvet.glsl", "/etc/velvet.glsl", "a/%2e%2e/velvet.glsl"}) {
        const std::string gltf =
            R"({"asset":{"version":"2.0"},"materials":[{"name":"m","extensions":{)"
            R"("PETRICHOR_materials_weather":{"lightingModel":")" +
            std::string(name) + R"("}}}]})";
        try {
            load_gltf(std::as_bytes(std::span(gltf)), "scene.gltf", nullptr);
            ADD_FAILURE() << name;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("lightingModel")) << name;
        }
    }
}

}  // namespace
}  // namespace petrichor::scene
