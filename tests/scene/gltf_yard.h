// A small scene with a bit of everything, as JSON that a test may edit before it is loaded.
#ifndef PETRICHOR_TESTS_SCENE_GLTF_YARD_H
#define PETRICHOR_TESTS_SCENE_GLTF_YARD_H

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/scene/gltf_helpers.h"

namespace petrichor::scene::yard {

using nlohmann::json;
using scene_files::expect_answer;
using scene_files::expect_sound;
using scene_files::to_bytes;
using Pointer = json::json_pointer;

// The bytes behind the scene below, at the offsets of its buffer views.
inline std::string scene_bin()
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
inline json scene_json()
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

inline std::string little_endian(std::size_t value)
{
    std::string out;
    for (int i = 0; i < 4; ++i) out += static_cast<char>(value >> (8 * i) & 0xff);
    return out;
}

inline std::vector<std::byte> glb(std::string text, std::string bin = scene_bin())
{
    while (text.size() % 4 != 0) text += ' ';
    while (bin.size() % 4 != 0) bin += '\0';
    std::string chunks = little_endian(text.size()) + "JSON" + text;
    if (!bin.empty()) chunks += little_endian(bin.size()) + std::string("BIN\0", 4) + bin;
    return to_bytes("glTF" + little_endian(2) + little_endian(12 + chunks.size()) + chunks);
}

inline Scene load(const json& document, const std::string& bin = scene_bin())
{
    Scene scene = load_gltf(glb(document.dump(), bin), "yard.glb", nullptr);
    expect_sound(scene);
    return scene;
}

inline json edited(std::initializer_list<std::pair<const char*, json>> edits)
{
    json document = scene_json();
    for (const auto& [where, value] : edits) document[Pointer(where)] = value;
    return document;
}

inline std::string refusal(const std::vector<std::byte>& asset,
                           const ResourceReader& reader = nullptr)
{
    try {
        load_gltf(asset, "yard.glb", reader);
    } catch (const Error& problem) {
        EXPECT_FALSE(problem.fix().empty());
        return problem.what();
    }
    return "loaded";
}

inline void expect_near(const glm::vec3& a, const glm::vec3& b)
{
    EXPECT_LT(glm::distance(a, b), 1e-5f)
        << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

}  // namespace petrichor::scene::yard

#endif
