// For the tests of the loader: real files (only there when PETRICHOR_ASSETS names their folder),
// what every loaded scene must hold, and damage.
#ifndef PETRICHOR_TESTS_SCENE_GLTF_HELPERS_H
#define PETRICHOR_TESTS_SCENE_GLTF_HELPERS_H

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/gltf/gltf.h"
#include "tests/support/assets.h"

namespace petrichor::scene::scene_files {

inline std::vector<std::byte> to_bytes(const std::string& text)
{
    std::vector<std::byte> bytes(text.size());
    if (!text.empty()) std::memcpy(bytes.data(), text.data(), text.size());
    return bytes;
}

inline std::vector<std::byte> read_file(const std::filesystem::path& path)
{
    std::ifstream in(path, std::ios::binary);
    if (!in) throw Error("no file " + path.string(), "Put it there.");
    return to_bytes(std::string(std::istreambuf_iterator<char>(in), {}));
}

inline Scene load_file(const std::filesystem::path& path)
{
    return load_gltf(read_file(path), path.filename().string(),
                     [&](const std::string& uri) { return read_file(path.parent_path() / uri); });
}

/// A deterministic stream of numbers; the library's distributions differ between platforms.
struct Random {
    std::uint64_t state;
    std::uint32_t next()
    {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        return static_cast<std::uint32_t>(state >> 33);
    }
    std::size_t below(std::size_t limit) { return next() % limit; }
    float unit() { return static_cast<float>(next() % 65536) / 65536.0f; }
};

// What the header of scene.h promises about every loaded scene.
inline void expect_sound(const Scene& scene)
{
    ASSERT_FALSE(scene.materials.empty());
    for (const Instance& instance : scene.instances) {
        ASSERT_LT(instance.mesh, scene.meshes.size());
    }
    for (const EncodedImage& image : scene.textures) EXPECT_FALSE(image.bytes.empty());
    for (const Material& material : scene.materials) {
        EXPECT_LT(material.base_color_texture.texture,
                  static_cast<TextureIndex>(scene.textures.size()));
        EXPECT_LT(material.normal_texture.texture,
                  static_cast<TextureIndex>(scene.textures.size()));
    }
    for (const Mesh& mesh : scene.meshes) {
        for (const Primitive& primitive : mesh.primitives) {
            const std::size_t count = primitive.positions.size();
            ASSERT_LT(primitive.material, scene.materials.size());
            ASSERT_EQ(primitive.normals.size(), count);
            ASSERT_EQ(primitive.tangents.size(), count);
            ASSERT_EQ(primitive.uv0.size(), count);
            EXPECT_TRUE(primitive.uv1.empty() || primitive.uv1.size() == count);
            EXPECT_TRUE(primitive.colors.empty() || primitive.colors.size() == count);
            EXPECT_TRUE(primitive.weather.empty() || primitive.weather.size() == count);
            ASSERT_GT(primitive.indices.size(), 0u);
            ASSERT_EQ(primitive.indices.size() % 3, 0u);
            ASSERT_LT(*std::max_element(primitive.indices.begin(), primitive.indices.end()), count);
            std::size_t bad = 0;
            for (std::size_t v = 0; v < count; ++v) {
                const glm::vec4 tangent = primitive.tangents[v];
                const bool good = std::abs(glm::length(primitive.normals[v]) - 1.0f) < 1e-4f &&
                                  std::abs(glm::length(glm::vec3(tangent)) - 1.0f) < 1e-4f &&
                                  std::abs(tangent.w) == 1.0f;
                if (!good) ++bad;
            }
            EXPECT_EQ(bad, 0u) << mesh.name;
        }
    }
}

/// Whatever the bytes: an Error with a message and a fix, or a sound scene.
inline bool expect_answer(const std::vector<std::byte>& asset, const std::string& what)
{
    SCOPED_TRACE(what);
    try {
        expect_sound(load_gltf(asset, "damaged.glb", nullptr));
        return true;
    } catch (const Error& problem) {
        EXPECT_FALSE(problem.fix().empty()) << problem.what();
        return false;
    } catch (const std::exception& problem) {
        ADD_FAILURE() << "not an Error: " << problem.what();
        return false;
    }
}

}  // namespace petrichor::scene::scene_files

#endif
