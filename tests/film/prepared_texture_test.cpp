#include "film/scenes/prepared_texture.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "film/scenes/scene_textures.h"
#include "gpu/upload/emissive_lights.h"
#include "tests/gpu/gpu_fixture.h"
#include "texproc/codecs/files/texture.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;
using gpu::TexelFormat;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Color = std::array<std::uint8_t, 4>;

// Levels of one colour each, as nobody's filter would make them.
std::vector<texproc::RawImage> plain_levels(int size, const std::vector<Color>& colors)
{
    std::vector<texproc::RawImage> levels;
    for (std::size_t k = 0; k < colors.size(); ++k) {
        const int side = std::max(1, size >> k);
        texproc::RawImage level{side, side, 4, texproc::PixelType::U8, {}, {}};
        for (int i = 0; i < side * side; ++i) {
            for (const std::uint8_t v : colors[k]) level.bytes.push_back(std::byte{v});
        }
        levels.push_back(std::move(level));
    }
    return levels;
}

const std::vector<Color> kColors{
    {255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {255, 255, 0, 255}, {0, 255, 255, 255}};

scene::EncodedImage file_of(const std::string& extension,
                            const std::vector<texproc::RawImage>& levels,
                            const texproc::TextureWriteOptions& options)
{
    const fs::path path =
        fs::path(testing::TempDir()) / ("prepared_" + std::to_string(::getpid()) + extension);
    texproc::write_mip_chain(path, levels, options);
    std::ifstream in(path, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(in), {});
    fs::remove(path);
    scene::EncodedImage image;
    image.name = "wall" + extension;
    image.bytes.resize(text.size());
    std::memcpy(image.bytes.data(), text.data(), text.size());
    return image;
}

scene::Scene scene_with(scene::EncodedImage image, scene::TextureUse scene::Material::*use)
{
    scene::Scene scene;
    scene.textures.push_back(std::move(image));
    scene.materials.emplace_back();
    (scene.materials[0].*use).texture = 0;
    return scene;
}

struct FormatCase {
    const char* name;
    bool srgb;
    scene::TextureUse scene::Material::*use;
    TexelFormat wanted;       // on a device that reads all blocks
    TexelFormat wanted_cpu;   // on one that is slow with BC7
    TexelFormat wanted_none;  // on one without blocks
};
void PrintTo(const FormatCase& c, std::ostream* out)
{
    *out << c.name;
}

constexpr auto kColorUse = &scene::Material::base_color_texture;
constexpr auto kNormalUse = &scene::Material::normal_texture;
constexpr auto kSurfaceUse = &scene::Material::metallic_roughness_texture;
constexpr auto kScalarUse = &scene::Material::occlusion_texture;

class PreparedFormats : public testing::TestWithParam<FormatCase> {};

// The bytes of the file are the bytes of the texture, level for level, in DDS and in KTX2; where
// the device does not read the format, what a reader decodes.
TEST_P(PreparedFormats, AreLoadedAsTheyAre)
{
    const FormatCase& c = GetParam();
    const auto levels = plain_levels(16, kColors);
    const texproc::TextureWriteOptions options{.format = c.name, .srgb = c.srgb};
    const texproc::MipTexture file = texproc::make_texture(levels, options);
    for (const char* extension : {".dds", ".ktx2"}) {
        for (const BlockSupport blocks :
             {BlockSupport::All, BlockSupport::Fast, BlockSupport::None}) {
            scene::Scene scene = scene_with(file_of(extension, levels, options), c.use);
            TextureOptions preparing;
            preparing.blocks = blocks;
            const auto textures = prepare_textures(scene, preparing);
            ASSERT_EQ(textures.size(), 1u);
            const gpu::Texture& texture = textures[0];
            EXPECT_EQ(texture.format, blocks == BlockSupport::All    ? c.wanted
                                      : blocks == BlockSupport::Fast ? c.wanted_cpu
                                                                     : c.wanted_none);
            EXPECT_EQ(texture.width, 16);
            ASSERT_EQ(texture.mips.size(), levels.size());
            for (std::size_t k = 0; k < levels.size(); ++k) {
                if (texture.format == c.wanted) {
                    EXPECT_TRUE(texture.mips[k] == file.levels[k]) << extension << k;
                } else {
                    EXPECT_TRUE(texture.mips[k] ==
                                texproc::decode_level(file, static_cast<int>(k)).bytes)
                        << extension << k;
                }
            }
            if (blocks != BlockSupport::None) {
                EXPECT_THAT(scene.warnings, IsEmpty());
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Table, PreparedFormats,
    testing::Values(FormatCase{"bc1a", true, kColorUse, TexelFormat::Bc1Srgb, TexelFormat::Bc1Srgb,
                               TexelFormat::Rgba8Srgb},
                    FormatCase{"bc3", true, kColorUse, TexelFormat::Bc3Srgb, TexelFormat::Bc3Srgb,
                               TexelFormat::Rgba8Srgb},
                    FormatCase{"bc7", true, kColorUse, TexelFormat::Bc7Srgb, TexelFormat::Rgba8Srgb,
                               TexelFormat::Rgba8Srgb},
                    FormatCase{"rgba8", true, kColorUse, TexelFormat::Rgba8Srgb,
                               TexelFormat::Rgba8Srgb, TexelFormat::Rgba8Srgb},
                    FormatCase{"rgba16f", false, kColorUse, TexelFormat::Rgba16Float,
                               TexelFormat::Rgba16Float, TexelFormat::Rgba16Float},
                    FormatCase{"bc5", false, kNormalUse, TexelFormat::Bc5Unorm,
                               TexelFormat::Bc5Unorm, TexelFormat::Rg8Unorm},
                    FormatCase{"rg8", false, kNormalUse, TexelFormat::Rg8Unorm,
                               TexelFormat::Rg8Unorm, TexelFormat::Rg8Unorm},
                    FormatCase{"bc7", false, kSurfaceUse, TexelFormat::Bc7Unorm,
                               TexelFormat::Rgba8Unorm, TexelFormat::Rgba8Unorm},
                    FormatCase{"bc4", false, kScalarUse, TexelFormat::Bc4Unorm,
                               TexelFormat::Bc4Unorm, TexelFormat::R8Unorm},
                    FormatCase{"r8", false, kScalarUse, TexelFormat::R8Unorm, TexelFormat::R8Unorm,
                               TexelFormat::R8Unorm}));

TEST(PreparedTextures, OneLevelIsAPictureLikeAnyOther)
{
    const auto levels = plain_levels(16, {kColors[0]});
    scene::Scene scene =
        scene_with(file_of(".dds", levels, {.format = "rgba8", .srgb = true}), kColorUse);
    EXPECT_EQ(prepare_textures(scene)[0].mips.size(), 5u) << "its levels are made";
}

TEST(PreparedTextures, ALabelThatDiffersIsSaidOnce)
{
    const auto levels = plain_levels(16, kColors);
    scene::Scene scene = scene_with(file_of(".ktx2", levels, {.format = "rgba8"}), kColorUse);
    scene.materials.push_back(scene.materials[0]);
    EXPECT_EQ(prepare_textures(scene)[0].format, TexelFormat::Rgba8Srgb);
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("wall.ktx2 is labelled linear")));
    scene = scene_with(file_of(".dds", levels, {.format = "bc7", .srgb = true}), kSurfaceUse);
    EXPECT_EQ(prepare_textures(scene)[0].format, TexelFormat::Rgba8Unorm);
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("wall.dds is labelled sRGB")));
}

TEST(PreparedTextures, ANormalMapWithOneChannelIsRefused)
{
    const auto levels = plain_levels(16, kColors);
    scene::Scene scene = scene_with(file_of(".dds", levels, {.format = "bc4"}), kNormalUse);
    try {
        prepare_textures(scene);
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("wall.dds"));
        EXPECT_THAT(error.what(), HasSubstr("one channel"));
    }
}

TEST(PreparedTextures, LargeOnesStartAtTheLevelThatFits)
{
    const auto levels = plain_levels(16, kColors);
    scene::Scene scene =
        scene_with(file_of(".dds", levels, {.format = "bc1", .srgb = true}), kColorUse);
    const auto textures = prepare_textures(scene, {.max_size = 4});
    EXPECT_EQ(textures[0].width, 4);
    EXPECT_EQ(textures[0].mips.size(), 3u);
}

// A roughness map that brings its levels keeps them, and the material its factor.
TEST(PreparedTextures, AreNotPairedWithNormals)
{
    const auto levels = plain_levels(16, kColors);
    scene::Scene scene = scene_with(file_of(".dds", levels, {.format = "bc1"}), kSurfaceUse);
    scene.textures.push_back(file_of(".dds", levels, {.format = "bc5"}));
    scene.materials[0].normal_texture.texture = 1;
    scene.materials[0].roughness = 0.25f;
    const auto recipes = plan_textures(scene);
    EXPECT_TRUE(recipes[0].prepared);
    EXPECT_EQ(recipes[0].normal_image, -1);
    EXPECT_FLOAT_EQ(scene.materials[0].roughness, 0.25f);
}

// Two panes, 5 m apart: one shows the dark left half of its texture, the other the bright right half.
scene::Scene panes_with(scene::EncodedImage image)
{
    scene::Primitive two = gpu::quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const scene::Primitive other = gpu::quad({5, 0, 0}, {1, 0, 0}, {0, 1, 0});
    for (glm::vec2& uv : two.uv0) uv = {0.25f, 0.5f};
    for (std::size_t i = 0; i < 4; ++i) {
        two.positions.push_back(other.positions[i]);
        two.uv0.emplace_back(0.75f, 0.5f);
    }
    for (const std::uint32_t k : other.indices) two.indices.push_back(4 + k);
    scene::Material glow = gpu::plain_material(glm::vec3(0.0f));
    glow.emissive = glm::vec3(100.0f);
    glow.emissive_texture.texture = 0;
    scene::Scene scene = gpu::scene_of({two}, {glow});
    scene.textures.push_back(std::move(image));
    return scene;
}

// Of 256 texels down to 1; the halves of the two largest levels lie the other way around: they are not read.
std::vector<texproc::RawImage> half_bright_levels(texproc::PixelType type)
{
    std::vector<texproc::RawImage> levels;
    for (int side = 256; side >= 1; side /= 2) {
        Image level(side, side, 4, ColorSpace::Data, 1.0f);
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const bool bright = (2 * x >= side) == (side <= 64);
                const float color[3] = {bright ? 0.8f : 0.0f, bright ? 0.5f : 0.0f, bright ? 0.2f : 0.0f};
                for (int c = 0; c < 3; ++c) level.at(x, y, c) = color[c];
            }
        }
        levels.push_back(texproc::to_raw(level, type));
    }
    return levels;
}

TEST(PreparedTextures, WhatGlowsInBlocksLightsAsInPlainTexels)
{
    struct Case {
        const char* format;
        TexelFormat wanted;
        bool srgb;
    };
    for (const Case& c : {Case{"bc1a", TexelFormat::Bc1Srgb, true},
                          Case{"bc3", TexelFormat::Bc3Srgb, true}, Case{"bc7", TexelFormat::Bc7Srgb, true},
                          Case{"bc6h", TexelFormat::Bc6hUfloat, false}, Case{"rgba8", TexelFormat::Rgba8Srgb, true}}) {
        const auto levels = half_bright_levels(c.srgb ? texproc::PixelType::U8 : texproc::PixelType::F16);
        for (const char* extension : {".dds", ".ktx2"}) {
            scene::Scene scene = panes_with(file_of(extension, levels, {.format = c.format, .srgb = c.srgb}));
            const auto textures = prepare_textures(scene, {.blocks = BlockSupport::All});
            ASSERT_EQ(textures[0].format, c.wanted) << c.format;
            const auto lights = gpu::emissive_lights(scene, textures);
            ASSERT_EQ(lights.size(), 1u) << c.format << extension;
            EXPECT_NEAR(lights[0].position_m.x, 5.5f, 1e-4f) << c.format;
            // Codes are of sRGB, halves of light.
            const glm::vec3 codes(0.8f, 0.5f, 0.2f);
            const glm::vec3 light = c.srgb ? glm::vec3(0.6038f, 0.2140f, 0.0331f) : codes;
            for (int i = 0; i < 3; ++i) {
                EXPECT_NEAR(lights[0].intensity * lights[0].color[i], 100.0f * light[i], 1.5f) << c.format << i;
            }
        }
    }
}

// The levels of the file are those of the picture: a wall seen at 1, 2, 4, 8 texels a pixel is red,
// green, blue, yellow.
class PreparedPicture : public gpu::GpuTest {};

TEST_F(PreparedPicture, ShowsTheLevelsOfTheFile)
{
    constexpr int kSize = 64;
    const std::vector<Color> colors{{255, 0, 0, 255},   {0, 255, 0, 255},   {0, 0, 255, 255},
                                    {255, 255, 0, 255}, {0, 255, 255, 255}, {255, 0, 255, 255},
                                    {9, 9, 9, 255}};
    for (const char* format : {"bc1", "bc3", "bc7", "rgba8"}) {
        const scene::EncodedImage file =
            file_of(".dds", plain_levels(kSize, colors), {.format = format, .srgb = true});
        for (int level = 0; level < 4; ++level) {
            scene::Scene scene = gpu::scene_of(
                {gpu::quad({-0.5f, -0.5f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f})},
                {gpu::plain_material({1.0f, 1.0f, 1.0f})});
            scene.textures.push_back(file);
            scene.materials[0].base_color_texture.texture = 0;
            scene.materials[0].base_color_texture.scale = glm::vec2(static_cast<float>(1 << level));
            TextureOptions options;
            options.blocks = block_support(renderer->device());
            renderer->load(scene, prepare_textures(scene, options));
            gpu::Frame frame;
            frame.camera = gpu::look({0.0f, 0.0f, 2.0f}, {0.0f, 0.0f, 0.0f});
            frame.camera.orthographic_height_m = 1.0f;
            frame.settings.width = frame.settings.height = kSize;
            frame.settings.samples = 1;  // more would share finer levels
            frame.settings.aovs = {"base_color"};
            const gpu::RenderResult result = renderer->render(frame);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(
                    gpu::aov(result, "base_color", 21, 30, c),
                    static_cast<float>(
                        colors[static_cast<std::size_t>(level)][static_cast<std::size_t>(c)]) /
                        255.0f,
                    0.05f)
                    << format << " level " << level << " channel " << c;
            }
        }
    }
}

}  // namespace
}  // namespace petrichor::film
