#include "gpu/gltf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/gpu/gltf_helpers.h"

namespace petrichor::gpu {
namespace {

using nlohmann::json;
using scene_files::expect_answer;
using scene_files::expect_sound;
using scene_files::to_bytes;
using testing::ElementsAre;
using testing::HasSubstr;
using Pointer = json::json_pointer;

// The bytes behind the scene below, at the offsets of its buffer views.
std::string scene_bin()
{
    std::string bin;
    const auto add = [&bin](const auto&... values) {
        const auto one = [&bin](auto value) {
            bin.append(reinterpret_cast<const char*>(&value), sizeof value);
        };
        (one(values), ...);
    };
    add(0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 9.f, 9.f, 9.f, 0.f, 1.f, 0.f);  // 0: positions
    add(0.f, 0.f, 1.f, 0.f, 0.f, 2.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f);  // 48: normals
    add(0.f, 1.f, 1.f, 1.f, 1.f, 0.f, 0.f, 0.f);                      // 96: uv
    const std::uint16_t i0 = 0, i1 = 1, i2 = 2, i3 = 3;
    add(i0, i1, i2, i0, i2, i3);                       // 128: indices
    add(std::uint32_t{2});                             // 140: sparse index
    add(1.f, 1.f, 0.f);                                // 144: sparse position
    add(0.f, 0.f, 0.f, 5.f, 0.f, 0.f, 0.f, 0.f, 7.f);  // 156: translations
    bin += "\x89PNGfake";                              // 192: image
    add(std::uint32_t{0xff8000ffu}, std::uint32_t{0xffffffffu}, std::uint32_t{0},
        std::uint32_t{0x01020304u});  // 200: colours
    return bin;
}

// A small scene with a bit of everything.
json scene_json()
{
    return json::parse(R"({
      "asset": {"version": "2.0"},
      "scene": 0,
      "extensionsUsed": ["KHR_lights_punctual", "EXT_mesh_gpu_instancing", "KHR_texture_transform",
                         "KHR_materials_emissive_strength", "PETRICHOR_materials_weather"],
      "extensions": {"KHR_lights_punctual": {"lights": [
        {"type": "spot", "name": "lamp", "intensity": 5, "color": [1, 0.5, 0.25], "range": 8,
         "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}}]}},
      "scenes": [{"name": "yard", "nodes": [0, 4]}],
      "nodes": [
        {"name": "root", "translation": [10, 0, 0], "rotation": [0, 0.7071067811865476, 0, 0.7071067811865476],
         "scale": [2, 2, 2], "children": [1, 2, 3]},
        {"name": "wall", "mesh": 0, "translation": [0, 0, 1]},
        {"name": "eye", "camera": 0},
        {"name": "post", "translation": [0, 3, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
        {"name": "crowd", "mesh": 0, "extensions": {"EXT_mesh_gpu_instancing":
          {"attributes": {"TRANSLATION": 4}}}}],
      "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}],
      "meshes": [{"name": "quad", "primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1,
        "TEXCOORD_0": 2, "COLOR_0": 5}, "indices": 3, "material": 0}]}],
      "materials": [{"name": "stone", "doubleSided": true, "alphaMode": "MASK", "alphaCutoff": 0.4,
        "emissiveFactor": [1, 0.5, 0],
        "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 1], "metallicFactor": 0,
          "roughnessFactor": 0.75, "baseColorTexture": {"index": 0, "extensions":
            {"KHR_texture_transform": {"offset": [0.1, 0.2], "scale": [3, 4], "rotation": 0.5}}}},
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 10},
          "PETRICHOR_materials_weather": {"heightTexture": {"index": 0}, "heightScale": 0.05,
            "porosity": 0.6, "waterAccumulation": [0.1, 1, 0.2, 2], "sheltered": true}}}],
      "textures": [{"source": 0, "sampler": 0}],
      "samplers": [{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}],
      "images": [{"name": "bricks", "bufferView": 7, "mimeType": "image/png"}],
      "accessors": [
        {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4, "sparse": {"count": 1,
          "indices": {"bufferView": 4, "componentType": 5125}, "values": {"bufferView": 5}}},
        {"bufferView": 1, "componentType": 5126, "type": "VEC3", "count": 4},
        {"bufferView": 2, "componentType": 5126, "type": "VEC2", "count": 4},
        {"bufferView": 3, "componentType": 5123, "type": "SCALAR", "count": 6},
        {"bufferView": 6, "componentType": 5126, "type": "VEC3", "count": 3},
        {"bufferView": 8, "componentType": 5121, "normalized": true, "type": "VEC4", "count": 4}],
      "bufferViews": [
        {"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 48},
        {"buffer": 0, "byteOffset": 96, "byteLength": 32}, {"buffer": 0, "byteOffset": 128, "byteLength": 12},
        {"buffer": 0, "byteOffset": 140, "byteLength": 4}, {"buffer": 0, "byteOffset": 144, "byteLength": 12},
        {"buffer": 0, "byteOffset": 156, "byteLength": 36}, {"buffer": 0, "byteOffset": 192, "byteLength": 8},
        {"buffer": 0, "byteOffset": 200, "byteLength": 16, "byteStride": 4}],
      "buffers": [{"byteLength": 216}]
    })");
}

std::string little_endian(std::size_t value)
{
    std::string out;
    for (int i = 0; i < 4; ++i) out += static_cast<char>(value >> (8 * i) & 0xff);
    return out;
}

std::vector<std::byte> glb(std::string text, std::string bin = scene_bin())
{
    while (text.size() % 4 != 0) text += ' ';
    while (bin.size() % 4 != 0) bin += '\0';
    std::string chunks = little_endian(text.size()) + "JSON" + text;
    if (!bin.empty()) chunks += little_endian(bin.size()) + std::string("BIN\0", 4) + bin;
    return to_bytes("glTF" + little_endian(2) + little_endian(12 + chunks.size()) + chunks);
}

Scene load(const json& document, const std::string& bin = scene_bin())
{
    Scene scene = load_gltf(glb(document.dump(), bin), "yard.glb", nullptr);
    expect_sound(scene);
    return scene;
}

json edited(std::initializer_list<std::pair<const char*, json>> edits)
{
    json document = scene_json();
    for (const auto& [where, value] : edits) document[Pointer(where)] = value;
    return document;
}

std::string refusal(const std::vector<std::byte>& asset, const ResourceReader& reader = nullptr)
{
    try {
        load_gltf(asset, "yard.glb", reader);
    } catch (const Error& problem) {
        EXPECT_FALSE(problem.fix().empty());
        return problem.what();
    }
    return "loaded";
}

void expect_near(const glm::vec3& a, const glm::vec3& b)
{
    EXPECT_LT(glm::distance(a, b), 1e-5f)
        << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

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
    EXPECT_EQ(stone.emissive, glm::vec3(10, 5, 0));
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
    document["textures"][0] =
        json::parse(R"({"extensions": {"KHR_texture_basisu": {"source": 1}}})");
    EXPECT_FALSE(loaded().materials[0].base_color_texture.present());
    EXPECT_THAT(loaded().warnings, ElementsAre(HasSubstr("without an image")));
}

TEST(Gltf, SaysWhatItIgnores)
{
    const Scene scene = load(edited({
        {"/extensionsUsed", {"KHR_materials_variants", "VENDOR_thing"}},
        {"/extensionsRequired", {"KHR_materials_variants"}},
        {"/meshes/0/primitives/0/targets", json::array({{{"POSITION", 0}}})},
        {"/meshes/0/primitives/0/attributes/JOINTS_0", 5},
        {"/nodes/1/skin", 0},
        {"/nodes/4/skin", 0},
        {"/materials/0/pbrMetallicRoughness/metallicFactor", 1.5},
    }));
    EXPECT_EQ(scene.materials[0].metallic, 1.0f);
    EXPECT_THAT(
        scene.warnings,
        testing::UnorderedElementsAre(
            HasSubstr("\"KHR_materials_variants\" is ignored"),
            HasSubstr("\"VENDOR_thing\" is ignored"), HasSubstr("meshes[0].primitives[0].targets"),
            HasSubstr("attributes.JOINTS_0: skins are not applied: the mesh is shown at "
                      "rest (and 2 more like it)"),
            HasSubstr("metallicFactor: the value is out of range")));
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

struct BadCase {
    const char* name;
    const char* where;  ///< JSON pointer
    json value;
    const char* message;  ///< part of what the refusal must say
};
void PrintTo(const BadCase& c, std::ostream* out)
{
    *out << c.name;
}

class GltfRefuses : public testing::TestWithParam<BadCase> {};
TEST_P(GltfRefuses, WithTheWayToTheValue)
{
    const BadCase& c = GetParam();
    const std::string said = refusal(glb(edited({{c.where, c.value}}).dump()));
    EXPECT_THAT(said, HasSubstr(std::string("yard.glb: ") + c.message));
}

const float kNan = std::numeric_limits<float>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Values, GltfRefuses,
    testing::Values(
        BadCase{"accessor_index", "/meshes/0/primitives/0/indices", 17,
                "meshes[0].primitives[0].indices: accessor 17 does not exist (0..5)"},
        BadCase{"negative_index", "/meshes/0/primitives/0/indices", -1,
                "meshes[0].primitives[0].indices: must be a whole number, the index of some "
                "accessor, got -1"},
        BadCase{"text_for_an_index", "/nodes/1/mesh", "0", "nodes[1].mesh: must be a whole number"},
        BadCase{"huge_index", "/nodes/1/mesh", 1e300, "nodes[1].mesh: must be a whole number"},
        BadCase{"mesh_index", "/nodes/1/mesh", 1, "nodes[1].mesh: mesh 1 does not exist (0..0)"},
        BadCase{"camera_index", "/nodes/2/camera", 4, "nodes[2].camera: camera 4 does not exist"},
        BadCase{"light_index", "/nodes/3/extensions/KHR_lights_punctual/light", 1,
                "nodes[3].extensions.KHR_lights_punctual.light: light 1 does not exist"},
        BadCase{"material_index", "/meshes/0/primitives/0/material", 1,
                "meshes[0].primitives[0].material: material 1 does not exist"},
        BadCase{"texture_index",
                "/materials/0/normalTexture",
                {{"index", 9}},
                "materials[0].normalTexture.index: texture 9 does not exist"},
        BadCase{"image_index", "/textures/0/source", 1, "textures[0].source: image 1 does not"},
        BadCase{"sampler_index", "/textures/0/sampler", 1, "textures[0].sampler: sampler 1"},
        BadCase{"view_index", "/accessors/0/bufferView", 9,
                "accessors[0].bufferView: buffer view 9 does not exist (0..8)"},
        BadCase{"buffer_index", "/bufferViews/0/buffer", 1, "bufferViews[0].buffer: buffer 1"},
        BadCase{"scene_index", "/scene", 1, "scene: scene 1 does not exist"},
        BadCase{"count_beyond_view", "/accessors/1/count", 5, "accessors[1].count: 5 elements"},
        BadCase{"count_overflow", "/accessors/1/count", 4294967295u, "accessors[1].count: 42949"},
        BadCase{"count_zero", "/accessors/1/count", 0, "accessors[1].count: must be in [1, "},
        BadCase{"count_differs", "/accessors/1/count", 3,
                "meshes[0].primitives[0].attributes.NORMAL: has 3 elements, POSITION has 4"},
        BadCase{"accessor_offset", "/accessors/1/byteOffset", 4, "accessors[1].count: 4 elements"},
        BadCase{"accessor_offset_overflow", "/accessors/1/byteOffset", 9007199254740991u,
                "accessors[1].count: 4 elements"},
        BadCase{"view_length", "/bufferViews/8/byteLength", 17, "bufferViews[8].byteLength: bytes"},
        BadCase{"view_offset", "/bufferViews/8/byteOffset", 9007199254740991u,
                "bufferViews[8].byteLength: bytes"},
        BadCase{"buffer_length", "/buffers/0/byteLength", 217,
                "buffers[0].byteLength: is 217, but the BIN chunk has 216"},
        BadCase{"stride_small", "/bufferViews/0/byteStride", 4,
                "bufferViews[0].byteStride: must be"},
        BadCase{"stride_zero", "/bufferViews/0/byteStride", 0,
                "bufferViews[0].byteStride: must be"},
        BadCase{"stride_large", "/bufferViews/0/byteStride", 256,
                "bufferViews[0].byteStride: must"},
        BadCase{"component_type", "/accessors/1/componentType", 5124,
                "accessors[1].componentType: must be 5120"},
        BadCase{"integer_normals", "/accessors/1/componentType", 5123,
                "meshes[0].primitives[0].attributes.NORMAL: accessor 1 has component type 5123"},
        BadCase{"type", "/accessors/1/type", "MAT3", "accessors[1].type: must be SCALAR"},
        BadCase{"two_component_normals", "/accessors/1/type", "VEC2",
                "meshes[0].primitives[0].attributes.NORMAL: accessor 1 has 2 components, 3 are"},
        BadCase{"float_indices", "/accessors/3/componentType", 5126, "accessors[3].count: 6 elem"},
        BadCase{"signed_indices", "/accessors/3/componentType", 5122,
                "meshes[0].primitives[0].indices: must be a SCALAR accessor of an unsigned"},
        BadCase{"index_beyond_vertices",
                "/meshes/0/primitives/0/attributes",
                {{"POSITION", 4}},
                "meshes[0].primitives[0].indices: index 5 is 3, but there are only 3 vertices"},
        BadCase{"mode", "/meshes/0/primitives/0/mode", 7, "meshes[0].primitives[0].mode: must be"},
        BadCase{"sparse_count", "/accessors/0/sparse/count", 5,
                "accessors[0].sparse.count: must be in [1, 4], got 5"},
        BadCase{"sparse_values", "/accessors/0/sparse/values/byteOffset", 1,
                "accessors[0].sparse.values.byteOffset: 1 elements of 12 bytes from offset 1"},
        BadCase{"sparse_type", "/accessors/0/sparse/indices/componentType", 5126,
                "accessors[0].sparse.indices.componentType: must be an unsigned"},
        BadCase{"sparse_index", "/accessors/0/sparse/indices/bufferView", 8,
                "accessors[0].sparse.indices.bufferView: sparse index 0 is 4286578943"},
        BadCase{"zeros_without_end",
                "/accessors/5",
                {{"componentType", 5126}, {"type", "VEC4"}, {"count", 1000000000}},
                "meshes[0].primitives[0].attributes.COLOR_0: has 1000000000 elements"},
        BadCase{"vertices_from_nothing",
                "/meshes/0/primitives/0",
                {{"attributes", {{"POSITION", 6}}}},
                "meshes[0].primitives[0].attributes.POSITION: "
                "accessor 6 does not exist"},
        BadCase{"two_parents",
                "/nodes/4/children",
                {1},
                "nodes[4].children[0]: node 1 is already a child of node 0"},
        BadCase{"own_child", "/nodes/4/children", {4}, "nodes[4].children: is part of a cycle"},
        BadCase{"cycle", "/nodes/1/children", {0}, "nodes[0].children: is part of a cycle"},
        BadCase{"child_index", "/nodes/1/children", {5}, "nodes[1].children[0]: node 5 does not"},
        BadCase{"scene_lists_child",
                "/scenes/0/nodes",
                {1},
                "scenes[0].nodes[0]: node 1 is not a root"},
        BadCase{"scene_lists_twice",
                "/scenes/0/nodes",
                {0, 0},
                "scenes[0].nodes[1]: node 0 is listed twice"},
        BadCase{
            "rotation", "/nodes/0/rotation", {0, 0, 0, 0}, "nodes[0].rotation: is a quaternion"},
        BadCase{"rotation_of_three",
                "/nodes/0/rotation",
                {0, 0, 0},
                "nodes[0].rotation: must be 4 numbers, got an array of 3"},
        BadCase{"scale_overflow", "/nodes/0/scale", {1e300, 1, 1}, "nodes[0].scale[0]: must be a"},
        BadCase{
            "place_overflow", "/nodes/0/scale", {1e30, 1, 1}, "nodes[0]: its place in the world"},
        BadCase{"matrix_row",
                "/nodes/0/matrix",
                {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                "nodes[0].matrix: the last row"},
        BadCase{"fov", "/cameras/0/perspective/yfov", 4, "cameras[0].perspective.yfov: must be"},
        BadCase{"near", "/cameras/0/perspective/znear", 0, "cameras[0].perspective.znear: must be"},
        BadCase{"camera_type", "/cameras/0/type", "fisheye",
                "cameras[0].type: must be perspective"},
        BadCase{"cone", "/extensions/KHR_lights_punctual/lights/0/spot/innerConeAngle", 0.6,
                "extensions.KHR_lights_punctual.lights[0].spot.innerConeAngle: must be less"},
        BadCase{"instances_differ", "/nodes/4/extensions/EXT_mesh_gpu_instancing/attributes/SCALE",
                1, "nodes[4].extensions.EXT_mesh_gpu_instancing.attributes.SCALE: needs 3"},
        BadCase{"version", "/asset/version", "1.0", "asset.version: must be 2.0, got \"1.0\""},
        BadCase{"version_number", "/asset/version", 2.0, "asset.version: must be a text, got 2"},
        BadCase{"array_for_object", "/asset", json::array(), "asset: must be an object, got an"},
        BadCase{"object_for_array", "/nodes", json::object(), "nodes: must be an array, got an"},
        BadCase{"required_extension",
                "/extensionsRequired",
                {"VENDOR_magic"},
                "extensionsRequired[0]: cannot read the required extension \"VENDOR_magic\""},
        BadCase{"required_draco",
                "/extensionsRequired",
                {"KHR_draco_mesh_compression"},
                "extensionsRequired[0]: cannot read the required extension \"KHR_draco"},
        BadCase{"required_basisu",
                "/extensionsRequired",
                {"KHR_texture_basisu"},
                "extensionsRequired[0]: cannot read the required extension \"KHR_texture_basisu"},
        BadCase{"weather_key", "/materials/0/extensions/PETRICHOR_materials_weather/porocity", 1,
                "materials[0].extensions.PETRICHOR_materials_weather: unknown key \"porocity\""},
        BadCase{"weather_range", "/materials/0/extensions/PETRICHOR_materials_weather/porosity", 2,
                "materials[0].extensions.PETRICHOR_materials_weather.porosity: must be in [0, 1], "
                "got 2"},
        BadCase{
            "weather_vector",
            "/materials/0/extensions/PETRICHOR_materials_weather/snowAccumulation",
            {0, 5},
            "materials[0].extensions.PETRICHOR_materials_weather.snowAccumulation: number 1 must "
            "be in [0, 4], got 5"},
        BadCase{"weather_flag", "/materials/0/extensions/PETRICHOR_materials_weather/sheltered", 1,
                "materials[0].extensions.PETRICHOR_materials_weather.sheltered: must be true or"}),
    [](const auto& test) { return test.param.name; });

TEST(Gltf, SuggestsTheNearestWeatherKey)
{
    const auto fix_for = [](const char* key) {
        try {
            load(edited({{"/materials/0/extensions/PETRICHOR_materials_weather", {{key, 1}}}}));
        } catch (const Error& problem) {
            return problem.fix();
        }
        return std::string("loaded");
    };
    EXPECT_EQ(fix_for("porocity"), "Did you mean porosity?");
    EXPECT_EQ(fix_for("flow_speed"), "Did you mean flowSpeed?");
    EXPECT_EQ(fix_for("heightmap"), "Did you mean heightScale?");
    EXPECT_THAT(fix_for("x"), HasSubstr("the keys are heightTexture heightScale"));
}

TEST(Gltf, RefusesGeometryThatIsNotANumber)
{
    std::string bin = scene_bin();
    bin.replace(4, 4, reinterpret_cast<const char*>(&kNan), 4);
    EXPECT_THAT(
        refusal(glb(scene_json().dump(), bin)),
        HasSubstr("meshes[0].primitives[0].attributes.POSITION: element 0 is not a finite"));
    const float huge = 1e30f;
    bin.replace(4, 4, reinterpret_cast<const char*>(&huge), 4);
    EXPECT_THAT(refusal(glb(scene_json().dump(), bin)), HasSubstr("POSITION: element 0 is not a"));
    // Exporters write such normals and coordinates for triangles without area; they can be mended.
    bin = scene_bin();
    bin.replace(52, 4, reinterpret_cast<const char*>(&kNan), 4);
    bin.replace(48, 4, std::string(4, '\0'));
    bin.replace(56, 4, std::string(4, '\0'));
    bin.replace(96, 4, reinterpret_cast<const char*>(&kNan), 4);
    const Scene scene = load(scene_json(), bin);
    EXPECT_EQ(scene.meshes[0].primitives[0].normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(scene.meshes[0].primitives[0].uv0[0], glm::vec2(0, 1));
    EXPECT_EQ(scene.warnings.size(), 2u);
}

// A count that no bytes stand behind: zeros, as the format allows, but not a thousand million.
TEST(Gltf, RefusesToAllocateWithoutBound)
{
    json document = scene_json();
    document["accessors"].push_back(
        {{"componentType", 5126}, {"type", "VEC3"}, {"count", 1000000000}});
    json primitive = {{"attributes", {{"POSITION", 6}}}};
    document["meshes"][0]["primitives"][0] = primitive;
    EXPECT_THAT(refusal(glb(document.dump())), HasSubstr("asks for 1000000000 x 4096 bytes"));
    document["accessors"][6]["sparse"] = document["accessors"][0]["sparse"];
    EXPECT_THAT(refusal(glb(document.dump())), HasSubstr("asks for 1000000000 x 4096 bytes"));

    document = scene_json();
    document["accessors"].push_back(
        {{"componentType", 5126}, {"type", "VEC3"}, {"count", 1000000000}});
    document["nodes"][4]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 6;
    EXPECT_THAT(refusal(glb(document.dump())), HasSubstr("nodes[4].extensions.EXT_mesh_gpu"));

    // Small pieces add up: honest bytes, but millions of triangles shared among thousands of
    // meshes.
    std::string bin = scene_bin();
    const std::size_t indices_at = bin.size();
    for (std::uint32_t i = 0; i < 30000; ++i) bin += static_cast<char>(i % 3);
    document = scene_json();
    document["buffers"][0]["byteLength"] = bin.size();
    document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", indices_at}, {"byteLength", 30000}});
    document["accessors"].push_back(
        {{"bufferView", 9}, {"componentType", 5121}, {"type", "SCALAR"}, {"count", 30000}});
    document["meshes"][0]["primitives"][0]["indices"] = 6;
    const json shared = document["meshes"][0]["primitives"][0];
    document["meshes"][0]["primitives"] = std::vector<json>(50, shared);
    EXPECT_EQ(load(document, bin).meshes[0].primitives.size(), 50u);
    document["meshes"][0]["primitives"] = std::vector<json>(3000, shared);
    EXPECT_THAT(refusal(glb(document.dump(), bin)), HasSubstr("indices: asks for 30000 x 64"));
}

TEST(Gltf, RefusesUrisThatLeaveTheFolder)
{
    const auto reader = [](const std::string& uri) {
        ADD_FAILURE() << "must not be read: " << uri;
        return std::vector<std::byte>();
    };
    for (const char* uri : {"/etc/passwd",
                            "../up.bin",
                            "a/../../up.bin",
                            "a/..",
                            "%2e%2e/up.bin",
                            "..%2Fup.bin",
                            "..\\up.bin",
                            "a%5C..%5C..%5Cup",
                            "%2Fetc",
                            "\\\\host\\share",
                            "file:///etc/passwd",
                            "http://example.com/a.bin",
                            "https:a",
                            "C:\\a.bin",
                            "C%3A/a.bin",
                            "%zz",
                            "a%4",
                            "a%00b",
                            "line\nbreak",
                            "",
                            ".",
                            "./",
                            "%66ile:///etc/passwd"}) {
        SCOPED_TRACE(uri);
        EXPECT_THAT(refusal(glb(edited({{"/buffers/0/uri", uri}}).dump()), reader),
                    HasSubstr("yard.glb: buffers[0].uri: "));
    }
    EXPECT_THAT(refusal(glb(edited({{"/images/0", {{"uri", "../x.png"}}}}).dump()), reader),
                HasSubstr("yard.glb: images[0].uri: "));
}

TEST(Gltf, RefusesBrokenDataUris)
{
    for (const char* uri : {"data:", "data:;base64", "data:text/plain,abc", "data:;base64,ab!d",
                            "data:;base64,abcde"}) {
        SCOPED_TRACE(uri);
        EXPECT_THAT(refusal(glb(edited({{"/buffers/0/uri", uri}}).dump())),
                    HasSubstr("yard.glb: buffers[0].uri: "));
    }
    EXPECT_THAT(refusal(glb(edited({{"/buffers/0/uri", "data:;base64,abcd"}}).dump())),
                HasSubstr("buffers[0].byteLength: is 216, but its URI gives 3 bytes"));
}

TEST(Gltf, PassesOnWhatTheReaderSays)
{
    const ResourceReader reader = [](const std::string& uri) -> std::vector<std::byte> {
        throw Error("there is no " + uri, "Put it there.");
    };
    EXPECT_EQ(refusal(glb(edited({{"/images/0", {{"uri", "a%20b/./c.png"}}}}).dump()), reader),
              "yard.glb: images[0].uri: there is no a b/c.png");
}

TEST(Gltf, RefusesWhatIsNoScene)
{
    for (const char* text : {"", " ", "hello", "[1, 2]", "glTF", "\x89PNG", "{"}) {
        SCOPED_TRACE(text);
        EXPECT_THAT(refusal(to_bytes(text)), HasSubstr("yard.glb: "));
    }
    EXPECT_THAT(refusal(to_bytes("{\n \"asset\": nonsense}")), HasSubstr("line 2, column 12"));
    EXPECT_THAT(refusal(to_bytes("{\"asset\": 1e999}")), HasSubstr("too large"));
    EXPECT_THAT(refusal(to_bytes("{\"a\":" + std::string(100000, '['))),
                HasSubstr("nested deeper"));
    EXPECT_THAT(refusal(to_bytes("{}")), HasSubstr("asset: is missing"));
}

// Messages repeat what the file says, but neither all of it nor its control characters.
TEST(Gltf, KeepsMessagesShort)
{
    const std::string said =
        refusal(glb(edited({{"/asset/version", "\x1b[31m" + std::string(100000, 'x')}}).dump()));
    EXPECT_LT(said.size(), 200u);
    EXPECT_EQ(said.find('\x1b'), std::string::npos);
}

// Whatever happens to the bytes, there is an answer. Seeded, so a failure can be repeated.
TEST(GltfMutations, EveryTruncationIsRefused)
{
    const std::vector<std::byte> whole = glb(scene_json().dump());
    ASSERT_TRUE(expect_answer(whole, "whole"));
    for (std::size_t size = 0; size < whole.size(); ++size) {
        std::vector<std::byte> part(whole.begin(),
                                    whole.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_FALSE(expect_answer(part, "first " + std::to_string(size) + " bytes"));
    }
}

TEST(GltfMutations, FlippedBytesAreAnswered)
{
    const std::vector<std::byte> whole = glb(scene_json().dump());
    scene_files::Random random{1};
    int loaded = 0;
    for (int round = 0; round < 4000; ++round) {
        std::vector<std::byte> damaged = whole;
        const std::size_t flips = 1 + random.below(3);
        for (std::size_t i = 0; i < flips; ++i) {
            damaged[random.below(whole.size())] = static_cast<std::byte>(random.below(256));
        }
        loaded += expect_answer(damaged, "round " + std::to_string(round));
    }
    EXPECT_GT(loaded, 100) << "some damage is harmless";
    EXPECT_LT(loaded, 3900);
}

// Damage that keeps the JSON valid gets further: numbers and keys of other places.
TEST(GltfMutations, WrongValuesAreAnswered)
{
    const json whole = scene_json();
    std::vector<std::string> places;
    const json flat = whole.flatten();
    for (const auto& item : flat.items()) places.push_back(item.key());
    const std::vector<json> values{
        0,     1,           2,     3,  7,      -1,   0.5,     1e9,           1e18,
        1e300, 4294967295u, 65536, "", "VEC4", true, nullptr, json::array(), json::object(),
        5121,  5126};
    scene_files::Random random{5};
    int loaded = 0;
    for (int round = 0; round < 4000; ++round) {
        json damaged = whole;
        const std::size_t edits = 1 + random.below(2);
        std::string what = "round " + std::to_string(round);
        for (std::size_t i = 0; i < edits; ++i) {
            const std::string& place = places[random.below(places.size())];
            const json& value = values[random.below(values.size())];
            if (!damaged.contains(Pointer(place))) continue;
            damaged[Pointer(place)] = value;
            what += " " + place + " = " + value.dump();
        }
        loaded += expect_answer(glb(damaged.dump()), what);
    }
    EXPECT_GT(loaded, 100);
    EXPECT_LT(loaded, 3900);
}

}  // namespace
}  // namespace petrichor::gpu
