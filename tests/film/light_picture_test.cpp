// Pictures of light, of the sky and of reflection probes: every way in which their numbers are kept.
#include "film/scenes/light_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "film/scenes/scene_probes.h"
#include "film/scenes/transport.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;

fs::path folder()
{
    const fs::path at = fs::temp_directory_path() / "petrichor_light_picture_test";
    fs::create_directories(at);
    return at;
}

// 8 x 4, all of one colour.
fs::path png(const char* name, const std::vector<std::uint8_t>& color)
{
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < 32; ++i) pixels.insert(pixels.end(), color.begin(), color.end());
    const fs::path file = folder() / name;
    texproc::write_png8(file, 8, 4, static_cast<int>(color.size()), pixels);
    return file;
}
fs::path exr(const char* name, glm::vec3 color)
{
    const fs::path file = folder() / name;
    std::vector<texproc::ExrChannel> channels;
    for (int c = 0; c < 3; ++c)
        channels.push_back({std::string(1, "RGB"[c]), {}, std::vector<float>(32, color[c])});
    texproc::write_exr(file, 8, 4, channels, {});
    return file;
}

double linear(int byte)
{
    const double s = byte / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

TEST(LightPicture, FloatIsAsItIs)
{
    const fs::path file = exr("float.exr", {1234.5f, 0.25f, 3.0f});
    for (const LightCode code : {LightCode::Auto, LightCode::Float}) {
        const gpu::EnvironmentMap map = read_light_picture(file, code);
        ASSERT_EQ(map.rgb.size(), 96u);
        EXPECT_EQ(map.rgb[0], 1234.5f);
        EXPECT_EQ(map.rgb[94], 0.25f);
        EXPECT_EQ(map.rgb[95], 3.0f);
    }
}

TEST(LightPicture, EightBitsAreDecodedAsTold)
{
    const fs::path file = png("coded.png", {200, 100, 50, 128});
    const gpu::EnvironmentMap plain = read_light_picture(file);
    const gpu::EnvironmentMap rgbm = read_light_picture(file, LightCode::Rgbm);
    const gpu::EnvironmentMap dldr = read_light_picture(file, LightCode::Dldr);
    const int bytes[3] = {200, 100, 50};
    for (std::size_t c = 0; c < 3; ++c) {
        const double v = linear(bytes[c]);
        EXPECT_NEAR(plain.rgb[c], v, 1e-3 * v);
        // (5 a)^2.2 and 2^2.2 times.
        EXPECT_NEAR(rgbm.rgb[c], std::pow(5.0 * 128.0 / 255.0, 2.2) * v, 5e-4 * v + 2e-3 * std::pow(5.0 * 128.0 / 255.0, 2.2) * v);
        EXPECT_NEAR(dldr.rgb[c], std::pow(2.0, 2.2) * v, 1e-2 * v);
    }
    EXPECT_EQ(read_light_picture(png("black.png", {9, 9, 9, 0}), LightCode::Rgbm).rgb[0], 0.0f);
}

TEST(LightPicture, WhatCannotBeMeantIsRefused)
{
    const auto problem = [](const fs::path& file, LightCode code) -> std::string {
        try {
            read_light_picture(file, code);
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_THAT(problem(png("no_alpha.png", {1, 2, 3}), LightCode::Rgbm), HasSubstr("has no alpha"));
    EXPECT_THAT(problem(png("whole.png", {1, 2, 3}), LightCode::Float), HasSubstr("whole numbers"));
    EXPECT_THAT(problem(exr("light.exr", glm::vec3(1.0f)), LightCode::Dldr), HasSubstr("float"));
    EXPECT_NE(problem(folder() / "none.exr", LightCode::Auto), "");
}

TEST(LightPicture, KeysNameItsCode)
{
    const Scenario s = parse_scenario(
        "[sky]\nenvironment = \"sky.png\"\nenvironment_decode = \"dldr\"\n[render]\nprobes = [{ "
        "position_m = [0, 1, 0], picture = \"room.png\", decode = \"rgbm\", intensity = 5000 }, { "
        "position_m = [1, 1, 1] }]\n",
        "s.toml");
    EXPECT_EQ(s.sky.environment_decode, LightCode::Dldr);
    ASSERT_EQ(s.render.probes.pictures.size(), 2u);
    EXPECT_EQ(s.render.probes.pictures[0].file, "room.png");
    EXPECT_EQ(s.render.probes.pictures[0].decode, LightCode::Rgbm);
    EXPECT_EQ(s.render.probes.places[0].intensity, 5000.0f);
    EXPECT_EQ(s.render.probes.pictures[1].file, "");
    EXPECT_THROW(parse_scenario("[sky]\nenvironment_decode = \"logluv\"\n", "s.toml"), Error);
    EXPECT_THROW(
        parse_scenario("[render]\nprobes = [{ position_m = [0, 1, 0], decode = \"rgbm\" }]\n", "s.toml"),
        Error);
}

// North is the middle of the picture, as it is of the sky's.
TEST(LightPicture, AProbeTakesItInPlaceOfWhatItWouldTrace)
{
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 32; ++x) {
            const bool north = x >= 8 && x < 24;
            pixels.insert(pixels.end(), {std::uint8_t(north ? 255 : 0), 0, std::uint8_t(y < 8 ? 255 : 0)});
        }
    }
    texproc::write_png8(folder() / "room.png", 32, 16, 3, pixels);
    scene::Scene scene;
    scene.materials.resize(1);
    scene.meshes.resize(1);
    scene::Primitive ground;
    ground.positions = {{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}};
    ground.normals.assign(4, {0, 1, 0});
    ground.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes[0].primitives.push_back(ground);
    scene.instances.push_back({"ground", 0, glm::mat4(1.0f)});
    std::vector<std::string> notes;
    const auto made = prepare_patch_scene(scene, {}, notes);
    ScenarioProbes wanted;
    wanted.automatic = false;
    wanted.places.resize(2);
    wanted.places[0].position_m = wanted.places[1].position_m = {0, 1, 0};
    wanted.pictures = {{"room.png", LightCode::Auto}, {}};
    const auto probes = prepare_probes(scene, *made, wanted, folder(), {}, notes);
    ASSERT_EQ(probes.size(), 2u);
    EXPECT_TRUE(probes[1].picture.empty());
    ASSERT_EQ(probes[0].picture.size(), probes[0].texels.size());
    const int side = static_cast<int>(std::lround(std::sqrt(probes[0].picture.size())));
    const auto towards = [&](glm::vec2 octahedral) {
        const glm::ivec2 at((octahedral * 0.5f + 0.5f) * static_cast<float>(side));
        return probes[0].picture[static_cast<std::size_t>(at.y * side + at.x)];
    };
    EXPECT_EQ(towards({0.0f, -0.5f}), glm::vec3(1, 0, 1)) << "north and up";
    EXPECT_EQ(towards({0.0f, 0.5f}), glm::vec3(0, 0, 1)) << "south and up";
    EXPECT_EQ(towards({0.1f, -0.95f}).b, 0.0f) << "down";
    wanted.pictures[0].file = "none.png";
    EXPECT_THROW(prepare_probes(scene, *made, wanted, folder(), {}, notes), Error);
}

}  // namespace
}  // namespace petrichor::film
