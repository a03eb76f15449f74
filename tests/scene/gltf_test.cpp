#include "scene/gltf/gltf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/scene/gltf_yard.h"

namespace petrichor::scene {
namespace {

using nlohmann::json;
using scene_files::expect_sound;
using scene_files::to_bytes;
using testing::ElementsAre;
using testing::HasSubstr;
using yard::edited;
using yard::expect_near;
using yard::glb;
using yard::load;
using yard::refusal;
using yard::scene_bin;
using yard::scene_json;

TEST(Gltf, ReadsAScene)
{
    const Scene scene = load(scene_json());
    EXPECT_EQ(scene.name, "yard");
    EXPECT_THAT(scene.warnings, ElementsAre());

    ASSERT_EQ(scene.meshes.size(), 1u);
    const Primitive& quad = scene.meshes[0].primitives.at(0);
    EXPECT_THAT(quad.indices, ElementsAre(0, 1, 2, 0, 2, 3));
    EXPECT_EQ(quad.positions[2], glm::vec3(1, 1, 0)) << "the sparse part replaces (9, 9, 9)";
    EXPECT_EQ(quad.normals[1], glm::vec3(0, 0, 1)) << "made unit";
    EXPECT_EQ(quad.uv0[3], glm::vec2(0, 0));
    EXPECT_EQ(quad.tangents[0], glm::vec4(1, 0, 0, 1));
    expect_near(glm::vec3(quad.colors[0]), {1.0f, 0.0f, 128.0f / 255.0f});
    EXPECT_FLOAT_EQ(quad.colors[3].a, 1.0f / 255.0f);
    EXPECT_EQ(quad.material, 0u);

    // A quarter turn about y takes +z to +x: the wall stands at (10, 0, 0) + 2 * (1, 0, 0).
    ASSERT_EQ(scene.instances.size(), 4u);
    EXPECT_EQ(scene.instances[0].name, "wall");
    expect_near(glm::vec3(scene.instances[0].to_world[3]), {12, 0, 0});
    expect_near(glm::vec3(scene.instances[0].to_world * glm::vec4(0, 1, 0, 1)), {12, 2, 0});
    EXPECT_EQ(scene.instances[2].name, "crowd");
    expect_near(glm::vec3(scene.instances[2].to_world[3]), {5, 0, 0});
    expect_near(glm::vec3(scene.instances[3].to_world[3]), {0, 0, 7});

    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_FLOAT_EQ(scene.cameras[0].vertical_fov_rad, 0.7f);
    EXPECT_FLOAT_EQ(scene.cameras[0].near_m, 0.1f);
    expect_near(glm::vec3(scene.cameras[0].to_world[2]),
                {1, 0, 0});  // looks along -x, unit: no scale
    expect_near(glm::vec3(scene.cameras[0].to_world[1]), {0, 1, 0});

    ASSERT_EQ(scene.lights.size(), 1u);
    const Light& lamp = scene.lights[0];
    EXPECT_EQ(lamp.kind, LightKind::Spot);
    expect_near(lamp.position_m, {10, 6, 0});
    expect_near(lamp.direction, {-1, 0, 0});
    EXPECT_EQ(lamp.intensity, 5.0f);
    EXPECT_EQ(lamp.range_m, 8.0f);
    EXPECT_EQ(lamp.inner_cone_rad, 0.25f);
    EXPECT_EQ(lamp.outer_cone_rad, 0.5f);

    ASSERT_EQ(scene.materials.size(), 1u);
    const Material& stone = scene.materials[0];
    EXPECT_EQ(stone.base_color, glm::vec4(0.5f, 0.25f, 0.125f, 1.0f));
    EXPECT_EQ(stone.metallic, 0.0f);
    EXPECT_EQ(stone.roughness, 0.75f);
    EXPECT_EQ(stone.emissive, glm::vec3(1, 0.5f, 0));
    EXPECT_EQ(stone.emissive_strength, 10.0f);
    EXPECT_EQ(stone.alpha_mode, AlphaMode::Mask);
    EXPECT_EQ(stone.alpha_cutoff, 0.4f);
    EXPECT_TRUE(stone.double_sided);
    EXPECT_EQ(stone.base_color_texture.offset, glm::vec2(0.1f, 0.2f));
    EXPECT_EQ(stone.base_color_texture.scale, glm::vec2(3, 4));
    EXPECT_EQ(stone.base_color_texture.rotation_rad, 0.5f);
    EXPECT_EQ(stone.weather.height_scale_m, 0.05f);
    EXPECT_EQ(stone.weather.porosity, 0.6f);
    EXPECT_EQ(stone.weather.water_accumulation, glm::vec4(0.1f, 1, 0.2f, 2));
    EXPECT_EQ(stone.weather.flow_speed, 0.05f) << "absent: the default";
    EXPECT_TRUE(stone.weather.sheltered);

    // Both uses name the same texture; its bytes stay as they are in the file.
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(stone.base_color_texture.texture, 0);
    EXPECT_EQ(stone.weather.height.texture, 0);
    EXPECT_EQ(scene.textures[0].bytes, to_bytes("\x89PNGfake"));
    EXPECT_EQ(scene.textures[0].name, "image 0 (bricks)");
    EXPECT_EQ(scene.textures[0].wrap_u, Wrap::Clamp);
    EXPECT_EQ(scene.textures[0].wrap_v, Wrap::Mirror);
    EXPECT_TRUE(scene.textures[0].nearest);
}

TEST(Gltf, TextAndBinaryGiveTheSameScene)
{
    json text = scene_json();
    text["buffers"][0]["uri"] = "my%20data/yard.bin";
    const Scene a = load_gltf(to_bytes(text.dump(2)), "yard.gltf", [](const std::string& uri) {
        EXPECT_EQ(uri, "my data/yard.bin");
        return to_bytes(scene_bin());
    });
    const Scene b = load(scene_json());
    EXPECT_EQ(a.meshes[0].primitives[0].positions, b.meshes[0].primitives[0].positions);
    EXPECT_EQ(a.meshes[0].primitives[0].tangents, b.meshes[0].primitives[0].tangents);
    EXPECT_EQ(a.instances.size(), b.instances.size());
}

TEST(Gltf, ReadsDataUris)
{
    // One triangle: 36 bytes of positions in base64.
    const json document = json::parse(R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}],
      "bufferViews": [{"buffer": 0, "byteLength": 36}],
      "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    const Scene scene = load_gltf(to_bytes(document.dump()), "triangle.gltf", nullptr);
    expect_sound(scene);
    const Primitive& triangle = scene.meshes.at(0).primitives.at(0);
    EXPECT_THAT(triangle.positions,
                ElementsAre(glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)));
    EXPECT_EQ(triangle.normals[0], glm::vec3(0, 0, 1)) << "flat normals where there are none";
    ASSERT_EQ(scene.materials.size(), 1u) << "the default material";
    EXPECT_EQ(scene.materials[0].name, "default");
}

TEST(Gltf, TurnsStripsAndFansIntoTriangles)
{
    json strip = scene_json();
    strip["accessors"][3]["count"] = 4;
    strip["meshes"][0]["primitives"][0]["mode"] = 5;
    std::string bin = scene_bin();
    const std::uint16_t corners[4] = {0, 1, 3, 2};
    bin.replace(128, 8, reinterpret_cast<const char*>(corners), 8);
    EXPECT_THAT(load(strip, bin).meshes[0].primitives[0].indices, ElementsAre(0, 1, 3, 1, 2, 3));

    json fan = strip;
    fan["meshes"][0]["primitives"][0]["mode"] = 6;
    const std::uint16_t around[4] = {0, 1, 2, 3};
    bin.replace(128, 8, reinterpret_cast<const char*>(around), 8);
    EXPECT_THAT(load(fan, bin).meshes[0].primitives[0].indices, ElementsAre(1, 2, 0, 2, 3, 0));
}

TEST(Gltf, LeavesOutPointsAndLinesWithAWarning)
{
    for (int mode = 0; mode < 4; ++mode) {
        const Scene scene = load(edited({{"/meshes/0/primitives/0/mode", mode}}));
        EXPECT_TRUE(scene.meshes.empty());
        EXPECT_TRUE(scene.instances.empty());
        ASSERT_EQ(scene.warnings.size(), 1u);
        EXPECT_THAT(scene.warnings[0], HasSubstr("meshes[0].primitives[0].mode"));
    }
}

TEST(Gltf, KeepsOnlyTheVerticesThatTrianglesUse)
{
    json document = scene_json();
    document["accessors"][3]["count"] = 3;
    std::string bin = scene_bin();
    const std::uint16_t corners[3] = {3, 0, 2};
    bin.replace(128, 6, reinterpret_cast<const char*>(corners), 6);
    const Scene scene = load(document, bin);
    const Primitive& triangle = scene.meshes[0].primitives[0];
    EXPECT_THAT(triangle.indices, ElementsAre(2, 0, 1));
    EXPECT_THAT(triangle.positions,
                ElementsAre(glm::vec3(0, 0, 0), glm::vec3(1, 1, 0), glm::vec3(0, 1, 0)));
    EXPECT_EQ(triangle.uv0[1], glm::vec2(1, 0));
}

TEST(Gltf, ReadsQuantizedMeshes)
{
    json document = scene_json();
    document["extensionsRequired"] = {"KHR_mesh_quantization"};
    std::string bin = scene_bin();
    const std::int16_t positions[16] = {0,     0,      0, 0, 32767, 0,   0, 0,
                                        16384, -32768, 0, 0, 0,     100, 0, 0};
    bin.replace(0, 32, reinterpret_cast<const char*>(positions), 32);
    document["accessors"][0] = {{"bufferView", 0},
                                {"componentType", 5122},
                                {"normalized", true},
                                {"type", "VEC3"},
                                {"count", 4}};
    document["bufferViews"][0]["byteStride"] = 8;
    const Primitive quad = load(document, bin).meshes[0].primitives[0];
    EXPECT_EQ(quad.positions[1], glm::vec3(1, 0, 0));
    expect_near(quad.positions[2], {16384.0f / 32767.0f, -1.0f, 0.0f});  // -32768 counts as -1

    document["accessors"][0]["normalized"] = false;
    EXPECT_EQ(load(document, bin).meshes[0].primitives[0].positions[1], glm::vec3(32767, 0, 0));
    document.erase("extensionsRequired");
    EXPECT_THAT(
        refusal(glb(document.dump(), bin)),
        HasSubstr("meshes[0].primitives[0].attributes.POSITION: accessor 0 has component type "
                  "5122"));
}

TEST(Gltf, ReadsTheWeatherMasksOfVertices)
{
    json document = scene_json();
    json& attributes = document["meshes"][0]["primitives"][0]["attributes"];
    attributes["_WEATHER"] = 5;
    attributes.erase("COLOR_0");
    const Primitive quad = load(document).meshes[0].primitives[0];
    EXPECT_TRUE(quad.colors.empty());
    EXPECT_THAT(quad.weather, ElementsAre(glm::vec4(1, 0, 128.0f / 255.0f, 1), glm::vec4(1),
                                          glm::vec4(0), glm::vec4(4, 3, 2, 1) / 255.0f));
    attributes["_WEATHER"] = 0;
    EXPECT_THAT(refusal(glb(document.dump())), HasSubstr("attributes._WEATHER: accessor 0 has 3"));
}

TEST(Gltf, ChoosesTheSceneToShow)
{
    json document = scene_json();
    document["scenes"] = json::parse(R"([{"nodes": [0]}, {"nodes": [4]}])");
    document["scene"] = 1;
    EXPECT_EQ(load(document).instances.size(), 3u);
    document.erase("scene");
    EXPECT_EQ(load(document).instances.size(), 1u) << "the first";
    document.erase("scenes");
    EXPECT_EQ(load(document).instances.size(), 4u) << "all roots";
    document = json::parse(R"({"asset": {"version": "2.0"}})");
    const Scene empty = load(document);
    EXPECT_TRUE(empty.instances.empty());
    EXPECT_EQ(empty.materials.size(), 1u);
}

TEST(Gltf, KeepsMirroredAndSkewedTransforms)
{
    const Scene scene =
        load(edited({{"/nodes/4/scale", {1, -2, 3}}, {"/nodes/4/rotation", {0, 0, 2, 0}}}));
    const glm::mat4 m = scene.instances[1].to_world;  // half a turn about z, quaternion made unit
    expect_near(glm::vec3(m * glm::vec4(1, 1, 1, 0)), {-1, 2, 3});
    EXPECT_LT(glm::determinant(m), 0.0f);
}

TEST(Gltf, FramesOfCamerasAreProper)
{
    const Scene scene = load(edited({{"/nodes/0/scale", {-2, 3, 0.5}}}));
    const glm::mat3 m(scene.cameras[0].to_world);
    EXPECT_NEAR(glm::determinant(m), 1.0f, 1e-5f);
    expect_near(m[2], {1, 0, 0});
    expect_near(m[1], {0, 1, 0});
}

TEST(Gltf, PrefersTheImageThatEveryoneReads)
{
    json document = scene_json();
    document["images"].push_back({{"uri", "stone.webp"}});
    document["textures"][0] = json::parse(R"({"extensions": {"EXT_texture_webp": {"source": 1}}})");
    const auto reader = [](const std::string& uri) { return to_bytes("bytes of " + uri); };
    const auto loaded = [&] { return load_gltf(glb(document.dump()), "yard.glb", reader); };
    EXPECT_EQ(loaded().textures[0].name, "stone.webp");
    EXPECT_EQ(loaded().textures[0].bytes, to_bytes("bytes of stone.webp"));
    EXPECT_EQ(loaded().textures[0].wrap_u, Wrap::Repeat);
    document["textures"][0]["source"] = 0;
    EXPECT_EQ(loaded().textures[0].name, "image 0 (bricks)");
    document["textures"][0] = json::parse(R"({"extensions": {"VENDOR_image": {"source": 1}}})");
    EXPECT_FALSE(loaded().materials[0].base_color_texture.present());
    EXPECT_THAT(loaded().warnings, ElementsAre(HasSubstr("without an image")));
}

// Files that bring their own levels win over the plain copy.
TEST(Gltf, TakesPreparedTexturesFirst)
{
    json document = scene_json();
    document["images"].push_back({{"uri", "stone.dds"}});
    document["images"].push_back({{"uri", "stone.ktx2"}});
    std::string ktx2("\xabKTX 20\xbb\r\n\x1a\n", 12);
    ktx2 += std::string("\x91\0\0\0", 4) + std::string(64, '\0');  // BC7
    std::string basis = ktx2;
    basis[12] = '\0';
    const std::string uastc = basis;
    basis[44] = '\1';
    std::string stored = ktx2;
    const auto reader = [&](const std::string& uri) {
        return to_bytes(uri == "stone.ktx2" ? stored : "bytes of " + uri);
    };
    const auto loaded = [&] { return load_gltf(glb(document.dump()), "yard.glb", reader); };
    const auto name = [&] { return loaded().textures[0].name; };
    const char* both = R"({"source": 0, "extensions": {"KHR_texture_basisu": {"source": 2}}})";
    document["textures"][0] = json::parse(both);
    document["extensionsRequired"] = {"KHR_texture_basisu"};
    EXPECT_EQ(name(), "stone.ktx2");
    EXPECT_THAT(loaded().warnings, testing::IsEmpty());
    stored = uastc;
    EXPECT_EQ(name(), "stone.ktx2");
    stored = basis;  // ETC1S
    EXPECT_EQ(name(), "stone.ktx2");
    EXPECT_THAT(loaded().warnings, testing::IsEmpty());
    document["textures"][0] =
        json::parse(R"({"source": 0, "extensions": {"MSFT_texture_dds": {"source": 1}}})");
    document["extensionsRequired"] = {"MSFT_texture_dds"};
    EXPECT_EQ(name(), "stone.dds");
    EXPECT_THAT(loaded().warnings, testing::IsEmpty());
}

// Two lobes of a texel take the place of the material's one, where the lighting knows them.
TEST(Gltf, TwoLobesTakeThePlaceOfOne)
{
    json document = scene_json();
    document["textures"] = json::array();
    document["images"] = json::array();
    for (const char* name : {"n", "s", "n1", "s1", "second"}) {
        document["textures"].push_back({{"source", document["images"].size()}});
        document["images"].push_back({{"uri", std::string(name) + ".png"}});
    }
    document["materials"] = json::array({json::parse(R"({
        "normalTexture": {"index": 0, "scale": 0.5}, "occlusionTexture": {"index": 1},
        "pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 1}},
        "extensions": {"PETRICHOR_materials_two_lobes": {"normalTexture": {"index": 2, "scale": 0.5},
            "metallicRoughnessTexture": {"index": 3}, "secondLobeTexture": {"index": 4}}}})")});
    for (auto& mesh : document["meshes"])
        for (auto& primitive : mesh["primitives"]) primitive["material"] = 0;
    const auto reader = [](const std::string& uri) { return to_bytes("bytes of " + uri); };
    const auto name = [](const Scene& scene, const TextureUse& use) {
        return use.present() ? scene.textures[static_cast<std::size_t>(use.texture)].name : "";
    };
    const auto loaded = [&] { return load_gltf(glb(document.dump()), "yard.glb", reader); };
    const Scene scene = loaded();
    const Material& m = scene.materials[0];
    EXPECT_EQ(name(scene, m.normal_texture), "n1.png");
    EXPECT_EQ(name(scene, m.metallic_roughness_texture), "s1.png");
    EXPECT_EQ(name(scene, m.occlusion_texture), "s1.png") << "one image, one read";
    EXPECT_EQ(name(scene, m.maps.second_lobe), "second.png");
    EXPECT_EQ(m.normal_scale, 0.5f);
    EXPECT_EQ(scene.textures.size(), 3u) << "those of one lobe are not read";
    document["materials"][0]["occlusionTexture"]["index"] = 0;
    EXPECT_EQ(name(loaded(), loaded().materials[0].occlusion_texture), "n.png");

    document["materials"][0]["alphaMode"] = "BLEND";
    const Scene glass = loaded();
    EXPECT_EQ(name(glass, glass.materials[0].normal_texture), "n.png");
    EXPECT_EQ(name(glass, glass.materials[0].metallic_roughness_texture), "s.png");
    EXPECT_FALSE(glass.materials[0].maps.second_lobe.present());
}

TEST(Gltf, SaysWhatItIgnores)
{
    const Scene scene = load(edited({
        {"/extensionsUsed", {"KHR_materials_variants", "VENDOR_thing"}},
        {"/extensionsRequired", {"KHR_materials_variants"}},
        {"/materials/0/pbrMetallicRoughness/metallicFactor", 1.5},
    }));
    EXPECT_EQ(scene.materials[0].metallic, 1.0f);
    EXPECT_THAT(
        scene.warnings,
        testing::UnorderedElementsAre(
            HasSubstr("\"VENDOR_thing\" is ignored"),
            HasSubstr("metallicFactor: the value is out of range")));
}

TEST(Gltf, WhatComesThroughHasAColourOfItsOwn)
{
    const auto leaf = [](json told) { return load(edited({{"/materials/0/extensions/KHR_materials_diffuse_transmission", std::move(told)}})); };
    const Scene red = leaf({{"diffuseTransmissionFactor", 0.5}, {"diffuseTransmissionColorFactor", {1, 0.25, 0}}, {"diffuseTransmissionColorTexture", {{"index", 0}}}});
    EXPECT_EQ(red.materials[0].diffuse_transmission, 0.5f);
    EXPECT_EQ(red.materials[0].diffuse_transmission_color, glm::vec3(1.0f, 0.25f, 0.0f));
    EXPECT_TRUE(red.materials[0].maps.diffuse_transmission_color.present());
    EXPECT_FALSE(red.materials[0].diffuse_transmission_of_base);
    EXPECT_THAT(red.warnings, testing::IsEmpty());
    EXPECT_EQ(leaf({{"diffuseTransmissionFactor", 0.5}}).materials[0].diffuse_transmission_color, glm::vec3(1.0f)) << "as the extension has it";
}

TEST(Gltf, SaysThatALampTakesLightAway)
{
    const Scene scene = load(edited({{"/extensions/KHR_lights_punctual/lights/0/color", {-1, 0.5, 1}}}));
    EXPECT_EQ(scene.lights.at(0).color, glm::vec3(0.0f, 0.5f, 1.0f));
    EXPECT_THAT(scene.warnings, testing::ElementsAre(HasSubstr("lights[0].color: the value is out of range")));
}

TEST(Gltf, AVariantReplacesMaterials)
{
    const json document = edited({
        {"/extensionsUsed", {"KHR_materials_variants"}},
        {"/materials/1", {{"name", "moss"}}},
        {"/extensions/KHR_materials_variants/variants", {{{"name", "dry"}}, {{"name", "mossy"}}}},
        {"/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings",
         {{{"material", 1}, {"variants", {1}}}}},
    });
    const auto material = [&](const std::string& variant) {
        const Scene scene =
            load_gltf(glb(document.dump()), "yard.glb", nullptr, {.variant = variant});
        return scene.materials[scene.meshes[0].primitives[0].material].name;
    };
    EXPECT_NE(material(""), material("mossy"));
    EXPECT_EQ(material(""), material("dry"));
    EXPECT_THAT(load(document).warnings, ElementsAre(HasSubstr("dry, mossy")));
    try {
        material("mosy");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("Did you mean \"mossy\"?"));
    }
}

TEST(Gltf, MendsNormalsWithoutDirection)
{
    std::string bin = scene_bin();
    bin.replace(48, 12, std::string(12, '\0'));
    const Scene scene = load(scene_json(), bin);
    EXPECT_EQ(scene.meshes[0].primitives[0].normals[0], glm::vec3(0, 0, 1));
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("NORMAL")));
}

TEST(Gltf, BoundsCoverAllInstances)
{
    const Bounds bounds = scene_bounds(load(scene_json()));
    expect_near(bounds.low, {0, 0, -2});
    expect_near(bounds.high, {12, 2, 7});
    const Bounds nothing = scene_bounds(Scene{});
    EXPECT_EQ(nothing.low, nothing.high);
}

// Nodes nested so deep that recursion would overflow the stack.
TEST(Gltf, ReadsDeepTrees)
{
    json document = scene_json();
    const int depth = 100000;
    for (int i = 0; i < depth; ++i) {
        document["nodes"].push_back({{"children", {i + 6}}, {"translation", {0.0001, 0, 0}}});
    }
    document["nodes"].push_back({{"mesh", 0}});
    document["scenes"][0]["nodes"] = {5};
    const Scene scene = load(document);
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_NEAR(scene.instances[0].to_world[3].x, 10.0f, 1e-3f);
}

}  // namespace
}  // namespace petrichor::scene
