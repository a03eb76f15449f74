// Loads scenes from the real world and the official conformance cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iostream>
#include <set>

#include "tests/gpu/gltf_assets.h"

namespace petrichor::gpu {
namespace {

namespace fs = std::filesystem;
using testing_files::assets;
using testing_files::load_file;

#define NEED_ASSETS() \
    if (!assets()) GTEST_SKIP() << "PETRICHOR_ASSETS does not name the folder of test data"

// What the header of scene.h promises about every loaded scene.
void expect_sound(const Scene& scene)
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

struct Counts {
    std::size_t triangles = 0, vertices = 0;
};
Counts count(const Scene& scene)
{
    Counts counts;
    for (const Instance& instance : scene.instances) {
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            counts.triangles += primitive.indices.size() / 3;
            counts.vertices += primitive.positions.size();
        }
    }
    return counts;
}

TEST(GltfModels, EveryModelLoads)
{
    NEED_ASSETS();
    std::size_t models = 0;
    for (const auto& entry : fs::recursive_directory_iterator(*assets() / "models")) {
        const std::string extension = entry.path().extension();
        if (extension != ".gltf" && extension != ".glb") continue;
        SCOPED_TRACE(entry.path().filename().string());
        const std::clock_t start = std::clock();
        const Scene scene = load_file(entry.path());
        const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        expect_sound(scene);
        const Counts counts = count(scene);
        EXPECT_GT(counts.triangles, 0u);
        std::cout << entry.path().filename().string() << ": " << counts.triangles
                  << " triangles, " << counts.vertices << " vertices, " << scene.textures.size()
                  << " textures, " << seconds << " CPU-s\n";
        for (const std::string& line : scene.warnings) std::cout << "    " << line << "\n";
        ++models;
    }
    EXPECT_GE(models, 12u);
}

}  // namespace
}  // namespace petrichor::gpu
