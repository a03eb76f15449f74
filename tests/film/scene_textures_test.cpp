#include "film/scenes/scene_textures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "texproc/codecs/files/io.h"
#include "texproc/material/pack.h"

namespace petrichor::film {
namespace {

using Kind = TextureRecipe::Kind;

scene::EncodedImage image_of(int size, const std::vector<std::uint8_t>& even,
                             const std::vector<std::uint8_t>& odd)
{
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < size * size; ++i) {
        const auto& color = (i % size + i / size) % 2 == 0 ? even : odd;
        pixels.insert(pixels.end(), color.begin(), color.end());
    }
    scene::EncodedImage image;
    image.name = "image";
    image.bytes = texproc::encode_png8(size, size, 3, pixels);
    return image;
}

// Color, bumpy normals, packed occlusion-roughness-metal.
scene::Scene scene_with_maps()
{
    scene::Scene scene;
    scene.textures = {image_of(8, {255, 255, 255}, {0, 0, 0}),
                      image_of(8, {147, 128, 254}, {109, 128, 254}),
                      image_of(8, {200, 160, 255}, {200, 160, 255})};
    scene::Material material;
    material.base_color_texture.texture = 0;
    material.normal_texture.texture = 1;
    material.metallic_roughness_texture.texture = 2;
    material.occlusion_texture.texture = 2;
    material.roughness = 0.5f;
    scene.materials = {material};
    return scene;
}

TEST(PlanTextures, PairsNormalAndRoughness)
{
    scene::Scene scene = scene_with_maps();
    const auto recipes = plan_textures(scene);
    ASSERT_EQ(recipes.size(), 3u);
    EXPECT_EQ(recipes[0].kind, Kind::Color);
    EXPECT_EQ(recipes[1].kind, Kind::Normal);
    EXPECT_EQ(recipes[2].kind, Kind::Surface);
    EXPECT_EQ(recipes[2].normal_image, 1);
    EXPECT_FLOAT_EQ(recipes[2].roughness_factor, 0.5f);
    EXPECT_FLOAT_EQ(scene.materials[0].roughness, 1.0f) << "moved into the texture";
    EXPECT_EQ(scene.materials[0].occlusion_texture.texture, 2) << "read once";
}

// Lux's combined map: each use takes its channel; red of a packed file still is read with it.
TEST(PlanTextures, OcclusionMayLieInAnotherChannelOfAFile)
{
    scene::Scene scene = scene_with_maps();
    scene.materials[0].occlusion_texture.channel = scene::Channel::G;
    scene.materials[0].maps.translucency.texture = 2;
    scene.materials[0].maps.translucency.channel = scene::Channel::B;
    const auto recipes = plan_textures(scene);
    ASSERT_EQ(recipes.size(), 5u);
    const auto& material = scene.materials[0];
    const auto& occlusion = recipes[static_cast<std::size_t>(material.occlusion_texture.texture)];
    const auto& translucency = recipes[static_cast<std::size_t>(material.maps.translucency.texture)];
    EXPECT_EQ(occlusion.kind, Kind::Scalar);
    EXPECT_EQ(occlusion.channel, 1);
    EXPECT_EQ(occlusion.image, 2);
    EXPECT_EQ(material.occlusion_texture.channel, scene::Channel::R) << "the only one that is left";
    EXPECT_EQ(translucency.channel, 2);
}

// The default of `texture build`, joint, for 8-bit files: the same function with the same options.
TEST(PrepareTextures, FiltersAsTextureBuildDoes)
{
    scene::Scene scene = scene_with_maps();
    scene.materials[0].roughness = 1.0f;
    const auto raw = [&](int image) {
        return texproc::decode_raw(scene.textures[static_cast<std::size_t>(image)].bytes, "map");
    };
    texproc::PrefilterOptions options =
        texproc::prefilter_options({}, {.joint = true, .bits = 8, .threads = 1});
    EXPECT_EQ(options.rule, "picture");
    options.rebuild_z = true;
    const auto wanted = texproc::prefilter_raw(raw(1), texproc::channel_of(raw(2), 1), options);
    const auto textures = prepare_textures(scene);
    for (std::size_t level = 1; level < 4; ++level) {
        const auto rough = texproc::to_raw(wanted.roughness[level], texproc::PixelType::U8);
        const auto normal = texproc::to_raw(wanted.normal[level], texproc::PixelType::U8);
        for (std::size_t i = 0; i < rough.bytes.size(); ++i) {
            EXPECT_EQ(textures[2].mips[level][4 * i + 1], rough.bytes[i]);
            EXPECT_EQ(textures[1].mips[level][2 * i], normal.bytes[3 * i]);
            EXPECT_EQ(textures[1].mips[level][2 * i + 1], normal.bytes[3 * i + 1]);
        }
    }
}

// Far away fine detail leaves the colour below as it is: sRGB 0.5, whatever its own mean.
TEST(PrepareTextures, DetailFadesToGreyInSmallLevels)
{
    scene::Scene scene;
    scene.textures = {image_of(64, {250, 250, 250}, {200, 120, 40})};
    scene::Material material;
    material.second.use = scene::SecondSetUse::Detail;
    material.second.base_color_texture.texture = 0;
    scene.materials = {material};
    const auto levels = prepare_textures(scene)[0].mips;
    ASSERT_EQ(levels.size(), 7u);
    const auto red_and_blue_apart = [&](std::size_t level) {
        return std::abs(static_cast<int>(levels[level][0]) - static_cast<int>(levels[level][2]));
    };
    EXPECT_EQ(levels[0][0], std::byte{250}) << "the first level is as it was";
    for (std::size_t level = 2; level < levels.size(); ++level)
        EXPECT_LE(red_and_blue_apart(level), red_and_blue_apart(level - 1));
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(static_cast<int>(levels[4][static_cast<std::size_t>(c)]), 128, 1);
    scene.textures = {image_of(64, {250, 250, 250}, {200, 120, 40})};
    scene.materials[0].second.use = scene::SecondSetUse::Mix;
    EXPECT_GT(static_cast<int>(prepare_textures(scene)[0].mips[4][0]), 200) << "of detail alone";
}

// A control map of a terrain: four weights in every level, not coloured light.
TEST(PrepareTextures, WeightsOfLayersKeepFourChannels)
{
    scene::Scene scene;
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < 64; ++i) {
        for (const int c : {i % 2 == 0 ? 255 : 0, 64, 0, i % 2 == 0 ? 0 : 191}) pixels.push_back(static_cast<std::uint8_t>(c));
    }
    scene.textures.resize(1);
    scene.textures[0].name = "weights";
    scene.textures[0].bytes = texproc::encode_png8(8, 8, 4, pixels);
    scene::Material material;
    material.second.use = scene::SecondSetUse::Layers;
    material.second.mix_mask.texture = 0;
    scene.materials = {material};
    const auto textures = prepare_textures(scene);
    ASSERT_EQ(textures.size(), 1u);
    const auto code = [&](std::size_t mip, std::size_t i) { return static_cast<int>(textures[0].mips[mip][i]); };
    ASSERT_GT(textures[0].mips.size(), 2u);
    // Without alpha there is no fourth layer.
    scene::Scene bare;
    bare.textures = {image_of(8, {200, 40, 10}, {200, 40, 10})};
    bare.materials = {material};
    const auto three = prepare_textures(bare);
    EXPECT_EQ(static_cast<int>(three[0].mips[0][0]), 200);
    EXPECT_EQ(static_cast<int>(three[0].mips[0][3]), 0);
    const int first[] = {255, 64, 0, 0}, mean[] = {128, 64, 0, 96};
    for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_EQ(code(0, c), first[c]);
        EXPECT_NEAR(code(2, c), mean[c], 2) << c;
    }
}

// TGA has no checksum: what was cut and filled up is told, at every start. A black PNG is as its author made it.
TEST(PrepareTextures, RowsThatAreEmptyAreTold)
{
    const std::vector<std::uint8_t> black(static_cast<std::size_t>(3 * 32 * 32), 0);
    std::vector<std::byte> tga{std::byte{0}, std::byte{0}, std::byte{2}};
    tga.resize(18);
    tga[12] = tga[14] = std::byte{32};
    tga[16] = std::byte{24};
    tga[17] = std::byte{0x20};  // the first row is the top one
    for (int i = 0; i < 3 * 32 * 32; ++i) tga.push_back(static_cast<std::byte>(i < 3 * 32 * 20 ? 90 : 0));
    for (const bool png : {false, true}) {
        scene::Scene scene;
        scene.textures.resize(2);
        for (scene::EncodedImage& image : scene.textures) {
            image.name = png ? "wall.png" : "wall.tga";
            image.bytes = png ? texproc::encode_png8(32, 32, 3, black) : tga;
        }
        scene::Material material;
        material.base_color_texture.texture = 0;
        material.normal_texture.texture = 1;
        scene.materials = {material};
        prepare_textures(scene);
        // The colour and the normals are one file: said once.
        ASSERT_EQ(scene.warnings.size(), png ? 0u : 1u);
        if (png) continue;
        EXPECT_EQ(scene.warnings[0], "texture wall.tga: rows 20 to 31 of 32 are zero; look whether the file is damaged");
    }
}

TEST(PlanTextures, AnImageUsedInTwoWaysBecomesTwo)
{
    scene::Scene scene = scene_with_maps();
    scene.materials[0].emissive_texture.texture = 2;  // colour
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].normal_texture = {};  // the same roughness without its bumps
    const auto recipes = plan_textures(scene);
    ASSERT_EQ(recipes.size(), scene.textures.size());
    ASSERT_EQ(recipes.size(), 6u);
    const auto& first = scene.materials[0];
    const auto& second = scene.materials[1];
    EXPECT_NE(first.emissive_texture.texture, first.metallic_roughness_texture.texture);
    EXPECT_NE(first.metallic_roughness_texture.texture, second.metallic_roughness_texture.texture);
    EXPECT_NE(first.base_color_texture.texture, second.base_color_texture.texture)
        << "from afar bumps are darker than a plane";
    for (const TextureRecipe& recipe : recipes) EXPECT_LT(recipe.image, 3);
}

TEST(PlanTextures, OtherCoordinatesAreNotPaired)
{
    scene::Scene scene = scene_with_maps();
    scene.materials[0].normal_texture.scale = {2.0f, 2.0f};
    EXPECT_EQ(plan_textures(scene)[2].normal_image, -1);
    EXPECT_FLOAT_EQ(scene.materials[0].roughness, 0.5f);
}

// Bumps that lean every way: x and y from -0.25 to 0.25.
scene::EncodedImage random_bumps(int size)
{
    std::vector<std::uint8_t> pixels;
    std::uint32_t seed = 7;
    const auto component = [&] {
        seed = seed * 1664525u + 1013904223u;
        return static_cast<std::uint8_t>(96 + (seed >> 26));
    };
    for (int i = 0; i < size * size; ++i) {
        pixels.push_back(component());
        pixels.push_back(component());
        pixels.push_back(250);
    }
    scene::EncodedImage image;
    image.name = "bumps";
    image.bytes = texproc::encode_png8(size, size, 3, pixels);
    return image;
}

TEST(PrepareTextures, LostBumpsBecomeRoughness)
{
    scene::Scene scene = scene_with_maps();
    scene.textures[1] = random_bumps(8);
    const auto textures = prepare_textures(scene, {.threads = 2});
    ASSERT_EQ(textures.size(), 3u);
    for (const gpu::Texture& texture : textures) {
        EXPECT_EQ(texture.mips.size(), 4u);
        EXPECT_EQ(texture.width, 8);
    }
    EXPECT_EQ(textures[0].format, gpu::TexelFormat::Rgba8Srgb);
    EXPECT_EQ(textures[1].format, gpu::TexelFormat::Rg8Unorm);
    // Half black, half white is half the light, 188 in sRGB, not 128; metal of factor 1 stays so.
    EXPECT_NEAR(static_cast<int>(textures[0].mips[3][0]), 188, 1);
    // Level 0 is the file with the factor in it: 160 / 255 * 0.5; the last level is much rougher.
    EXPECT_NEAR(static_cast<int>(textures[2].mips[0][1]), 80, 1);
    EXPECT_GT(static_cast<int>(textures[2].mips[3][1]), 100);
    EXPECT_EQ(static_cast<int>(textures[2].mips[3][0]), 200) << "occlusion is a plain mean";
    // The normal of two bumps leans to one of them at most.
    EXPECT_NEAR(static_cast<int>(textures[1].mips[3][0]), 128, 18);
}

// A leaf: bright green where it is, black where it is not.
TEST(PrepareTextures, HolesDoNotDarkenTheColourOfALeaf)
{
    const auto mid_green = [](scene::AlphaMode mode) {
        std::vector<std::uint8_t> pixels;
        for (int i = 0; i < 64; ++i) {
            const bool leaf = (i + i / 8) % 2 == 0;
            for (const int v : {0, leaf ? 200 : 0, 0, leaf ? 255 : 0}) {
                pixels.push_back(static_cast<std::uint8_t>(v));
            }
        }
        scene::Scene scene;
        scene.textures.emplace_back();
        scene.textures[0].name = "leaf.png";
        scene.textures[0].bytes = texproc::encode_png8(8, 8, 4, pixels);
        scene.materials.emplace_back();
        scene.materials[0].alpha_mode = mode;
        scene.materials[0].base_color_texture.texture = 0;
        return static_cast<int>(prepare_textures(scene)[0].mips[1][1]);
    };
    EXPECT_EQ(mid_green(scene::AlphaMode::Mask), 200);
    EXPECT_EQ(mid_green(scene::AlphaMode::Blend), 200);
    EXPECT_NEAR(mid_green(scene::AlphaMode::Opaque), 146, 2) << "half of the light, whatever alpha";
}

TEST(PrepareTextures, SameBytesForAnyThreadCountAndLargeOnesAreReduced)
{
    scene::Scene one = scene_with_maps();
    scene::Scene four = scene_with_maps();
    const auto a = prepare_textures(one, {.max_size = 4, .threads = 1});
    const auto b = prepare_textures(four, {.max_size = 4, .threads = 4});
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].width, 4);
        EXPECT_EQ(a[i].mips.size(), 3u);
        EXPECT_TRUE(a[i].mips == b[i].mips);
    }
}

TEST(PrepareTextures, ADamagedImageIsNamed)
{
    scene::Scene scene = scene_with_maps();
    scene.textures[1].name = "bumps.png";
    scene.textures[1].bytes.resize(60);
    try {
        prepare_textures(scene);
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("bumps.png"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace petrichor::film
