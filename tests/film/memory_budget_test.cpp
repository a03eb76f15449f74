#include "film/scenes/memory_budget.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "base/error.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

constexpr int kSide = 1024;
constexpr std::uint64_t kTexels = static_cast<std::uint64_t>(kSide) * kSide;

// `images` colours of kSide x kSide, a material each, and a mesh of `triangles`.
scene::Scene scene_of(int images, int triangles)
{
    scene::EncodedImage image;
    image.bytes = texproc::encode_png8(kSide, kSide, 3, std::vector<std::uint8_t>(kTexels * 3));
    scene::Scene scene;
    for (int i = 0; i < images; ++i) {
        image.name = "image " + std::to_string(i);
        scene.textures.push_back(image);
        scene::Material material;
        material.base_color_texture.texture = i;
        scene.materials.push_back(material);
    }
    scene::Primitive primitive;
    primitive.positions.resize(3);
    primitive.indices.resize(static_cast<std::size_t>(triangles) * 3);
    scene.meshes = {{"mesh", {primitive}}};
    return scene;
}

// By hand: four bytes a texel, a third more for the levels, twice for the copy that is uploaded.
TEST(MemoryBudget, CountsTexelsAndTriangles)
{
    const MemoryNeed none = memory_need(scene_of(0, 0), {}, 100, 100);
    EXPECT_EQ(none.textures, 0u);
    EXPECT_GE(none.frame, 100u * 100u * (8u + 4u)) << "half floats and what the PNG shows";
    const MemoryNeed three = memory_need(scene_of(3, 0), {}, 100, 100);
    EXPECT_EQ(three.textures, 3 * (kTexels * 4 * 4 / 3 * 2));
    const MemoryNeed small = memory_need(scene_of(3, 0), {.max_size = kSide / 4}, 100, 100);
    EXPECT_NEAR(static_cast<double>(small.textures), static_cast<double>(three.textures) / 16.0,
                16.0);
    EXPECT_LT(small.making, three.making);
    const MemoryNeed million = memory_need(scene_of(0, 1000000), {}, 100, 100);
    EXPECT_GE(million.geometry, 1000000u * 3u * sizeof(std::uint32_t) * 2u);
}

TEST(MemoryBudget, SaysWhatToLower)
{
    const scene::Scene scene = scene_of(4, 10);
    const TextureOptions options{.threads = 1};
    EXPECT_NO_THROW(check_memory(scene, options, 64, 64, 1ull << 30));
    try {
        check_memory(scene, options, 64, 64, 40ull << 20);
        ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("the budget is 40 MiB"));
        EXPECT_THAT(error.fix(), testing::HasSubstr("max_texture = 512"));
        EXPECT_THAT(error.fix(), testing::HasSubstr("--memory"));
    }
    // No texture size helps where the frame alone is too large.
    try {
        check_memory(scene, options, 8192, 8192, 64ull << 20);
        ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
        EXPECT_THAT(error.fix(), testing::Not(testing::HasSubstr("max_texture")));
    }
    EXPECT_GT(default_memory_budget(), 64ull << 20);
}

}  // namespace
}  // namespace petrichor::film
