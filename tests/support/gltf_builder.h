// glTF scenes that tests put together: JSON to edit, and numbers that become accessors of one buffer.
#ifndef PETRICHOR_TESTS_SUPPORT_GLTF_BUILDER_H
#define PETRICHOR_TESTS_SUPPORT_GLTF_BUILDER_H

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace petrichor::testing_gltf {

using nlohmann::json;

class GltfBuilder {
public:
    json document = json::parse(
        R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}],
            "nodes": [], "meshes": [], "accessors": [], "bufferViews": []})");

    /// Accessors of floats, shorts and whole numbers; `type` as glTF names it. Gives the index.
    int floats(const std::string& type, const std::vector<float>& values)
    {
        return add(type, 5126, values);
    }
    int shorts(const std::string& type, const std::vector<std::uint16_t>& values)
    {
        return add(type, 5123, values);
    }
    int wholes(const std::vector<std::uint32_t>& values) { return add("SCALAR", 5125, values); }

    /// A node of the scene; gives its number.
    int node(json node, bool root = true)
    {
        document["nodes"].push_back(std::move(node));
        const int number = static_cast<int>(document["nodes"].size()) - 1;
        if (root) document["scenes"][0]["nodes"].push_back(number);
        return number;
    }
    int mesh(json primitive, const json& others = json::object())
    {
        json mesh = others;
        mesh["primitives"] = json::array({std::move(primitive)});
        document["meshes"].push_back(mesh);
        return static_cast<int>(document["meshes"].size()) - 1;
    }
    /// An animation of one channel.
    void animate(const std::string& name, int node, const std::string& path,
                 const std::vector<float>& times_s, const std::string& type,
                 const std::vector<float>& values, const std::string& blend = "LINEAR")
    {
        const int input = floats("SCALAR", times_s);
        const int output = floats(type, values);
        document["animations"].push_back(
            {{"name", name},
             {"samplers", {{{"input", input}, {"output", output}, {"interpolation", blend}}}},
             {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}}});
    }

    std::vector<std::byte> glb() const
    {
        json whole = document;
        std::string bin = bin_;
        whole["buffers"] = json::array({{{"byteLength", bin.size()}}});
        while (bin.size() % 4 != 0) bin += '\0';
        std::string text = whole.dump();
        while (text.size() % 4 != 0) text += ' ';
        std::string out;
        const auto word = [&out](std::uint32_t value) {
            out.append(reinterpret_cast<const char*>(&value), 4);
        };
        word(0x46546C67), word(2);
        word(static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + bin.size()));
        word(static_cast<std::uint32_t>(text.size())), word(0x4E4F534A);
        out += text;
        word(static_cast<std::uint32_t>(bin.size())), word(0x004E4942);
        out += bin;
        std::vector<std::byte> bytes(out.size());
        std::memcpy(bytes.data(), out.data(), out.size());
        return bytes;
    }

private:
    template <class T>
    int add(const std::string& type, int component, const std::vector<T>& values)
    {
        const std::size_t each = type == "SCALAR" ? 1
                                 : type == "VEC2" ? 2
                                 : type == "VEC3" ? 3
                                 : type == "VEC4" ? 4
                                                  : 16;
        while (bin_.size() % 4 != 0) bin_ += '\0';
        document["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", bin_.size()}, {"byteLength", values.size() * sizeof(T)}});
        document["accessors"].push_back(
            {{"bufferView", document["bufferViews"].size() - 1},
             {"componentType", component},
             {"count", values.size() / each},
             {"type", type}});
        bin_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        return static_cast<int>(document["accessors"].size()) - 1;
    }

    std::string bin_;
};

/// A quad of 1 m in the plane z = 0, its middle at the origin, front towards +z.
inline json quad_of(GltfBuilder& b)
{
    json attributes;
    attributes["POSITION"] = b.floats(
        "VEC3", {-0.5f, -0.5f, 0, 0.5f, -0.5f, 0, 0.5f, 0.5f, 0, -0.5f, 0.5f, 0});
    attributes["NORMAL"] = b.floats("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    return {{"attributes", attributes}, {"indices", b.wholes({0, 1, 2, 0, 2, 3})}};
}

/// A quad that turns by 90 degrees about +y in a second: "turn", node 0.
inline GltfBuilder turning_quad()
{
    GltfBuilder b;
    const int mesh = b.mesh(quad_of(b));
    b.node({{"mesh", mesh}, {"translation", {2, 0, 0}}});
    b.animate("turn", 0, "rotation", {0, 1}, "VEC4", {0, 0, 0, 1, 0, 0.70710678f, 0, 0.70710678f});
    return b;
}

/// A strip of four quads along +y, 0 to 2 m, on two joints: the upper one, at 1 m, bends by 90
/// degrees about +z in a second. Node 0 carries the mesh and is moved aside, which changes nothing.
inline GltfBuilder bending_bar(bool animated = true)
{
    GltfBuilder b;
    std::vector<float> positions, normals, weights;
    std::vector<std::uint16_t> joints;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t row = 0; row <= 4; ++row) {
        const float y = 0.5f * static_cast<float>(row);
        for (const float x : {-0.1f, 0.1f}) {
            positions.insert(positions.end(), {x, y, 0});
            normals.insert(normals.end(), {0, 0, 1});
            const float upper = y > 1.0f ? 1.0f : y < 1.0f ? 0.0f : 0.5f;
            joints.insert(joints.end(), {0, 1, 0, 0});
            weights.insert(weights.end(), {2.0f * (1.0f - upper), 2.0f * upper, 0, 0});
        }
        const std::uint32_t i = 2 * row;
        if (row < 4) indices.insert(indices.end(), {i, i + 1, i + 3, i, i + 3, i + 2});
    }
    json attributes;
    attributes["POSITION"] = b.floats("VEC3", positions);
    attributes["NORMAL"] = b.floats("VEC3", normals);
    attributes["JOINTS_0"] = b.shorts("VEC4", joints);
    attributes["WEIGHTS_0"] = b.floats("VEC4", weights);
    const int mesh = b.mesh({{"attributes", attributes}, {"indices", b.wholes(indices)}});
    b.node({{"mesh", mesh}, {"skin", 0}, {"translation", {50, 0, 0}}});
    b.node({{"children", {2}}});
    json upper = {{"translation", {0, 1, 0}}};
    if (!animated) upper["rotation"] = {0, 0, 0.70710678f, 0.70710678f};
    b.node(upper, false);
    const int inverse = b.floats("MAT4", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                                          1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1});
    b.document["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", inverse}}};
    if (animated) {
        b.animate("bend", 2, "rotation", {0, 1}, "VEC4",
                  {0, 0, 0, 1, 0, 0, 0.70710678f, 0.70710678f});
    }
    return b;
}

/// A quad whose right side moves 1 m along +x by its first morph target and 1 m towards +z by its
/// second; the first is at weight 1 after a second, by cubic keys with level tangents.
inline GltfBuilder morphing_quad()
{
    GltfBuilder b;
    json primitive = quad_of(b);
    const int wide = b.floats("VEC3", {0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0});
    const int turned = b.floats("VEC3", {0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0});
    primitive["targets"] = {{{"POSITION", wide}}, {{"POSITION", turned}}};
    const int mesh = b.mesh(primitive, {{"weights", {0.0f, 0.25f}}});
    b.node({{"mesh", mesh}});
    b.animate("grow", 0, "weights", {0, 1}, "SCALAR", {0, 0, 0, 0.25f, 0, 0, 0, 0, 1, 0.25f, 0, 0},
              "CUBICSPLINE");
    return b;
}

}  // namespace petrichor::testing_gltf

#endif
