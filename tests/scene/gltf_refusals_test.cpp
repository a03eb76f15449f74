// What the glTF reader refuses, and in which words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "scene/gltf/gltf.h"
#include "tests/scene/gltf_yard.h"

namespace petrichor::scene {
namespace {

using nlohmann::json;
using scene_files::to_bytes;
using testing::HasSubstr;
using yard::edited;
using yard::glb;
using yard::load;
using yard::refusal;
using yard::scene_bin;
using yard::scene_json;

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
        BadCase{"light_overflow", "/extensions/KHR_lights_punctual/lights/0/intensity", 1e39,
                "extensions.KHR_lights_punctual.lights[0].intensity: must be at most"},
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
    EXPECT_THAT(fix_for("x"), HasSubstr("the keys are lightingModel surface lightMapTexture heightTexture"));
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

}  // namespace
}  // namespace petrichor::scene
