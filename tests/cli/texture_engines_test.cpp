// What `petrichor texture build` leaves beside textures for the importers of engines, and sets that
// do not lie as one picture: maps of several sizes, tiles, images inside scenes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/assets.h"
#include "tests/support/program.h"
#include "texproc/codecs/files/io.h"
#include "texproc/codecs/files/texture.h"

namespace petrichor::cli {
namespace {

using testing::HasSubstr;
using testing::Not;
using namespace testing_program;
namespace fs = std::filesystem;
using nlohmann::json;

// Waves, so that levels differ.
Image waves(int width, int height, int channels, float high)
{
    Image image(width, height, channels, ColorSpace::Data);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < channels; ++c)
                image.at(x, y, c) = ((x / 2 + y / 4 + c) % 2) != 0 ? high : 0.4f;
        }
    }
    return image;
}

Image flat_normals(int size)
{
    Image normal(size, size, 3, ColorSpace::Data, 0.5f);
    for (std::size_t i = 2; i < normal.pixels.size(); i += 3) normal.pixels[i] = 1.0f;
    return normal;
}

void write_wall(const fs::path& folder, const std::string& tail = "")
{
    texproc::write_image(folder / ("Wall_albedo" + tail + ".png"), waves(16, 16, 3, 0.8f));
    texproc::write_image(folder / ("Wall_normal_gl" + tail + ".png"), flat_normals(16));
    texproc::write_image(folder / ("Wall_roughness" + tail + ".png"), waves(16, 16, 1, 0.9f));
}

std::string line_of(const std::string& text, const std::string& start)
{
    const std::size_t at = text.find(start);
    return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

TEST(TextureEngines, UnrealGetsBlueFirstAndAScript)
{
    const Workplace place("engine_unreal");
    write_wall(place / "in");
    const Outcome made =
        run({"texture", "build", "in", "--engine", "unreal", "--no-score", "--rule", "median", "-o", "out"}, place);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    for (const auto& [name, dxgi] :
         {std::pair("T_Wall_BC", 91u), std::pair("T_Wall_N", 87u), std::pair("T_Wall_ORM", 87u)}) {
        const std::string bytes = read_file(place / ("out/" + std::string(name) + ".dds"));
        std::uint32_t code = 0;
        std::memcpy(&code, &bytes[128], 4);
        EXPECT_EQ(bytes.substr(84, 4), "DX10") << name;
        EXPECT_EQ(code, dxgi) << name;
    }
    // Green down: 255 - 128; x and z stay where they were.
    const texproc::MipTexture normal = texproc::read_texture(place / "out/T_Wall_N.dds");
    EXPECT_EQ(static_cast<int>(normal.levels[0][0]), 128);
    EXPECT_EQ(static_cast<int>(normal.levels[0][1]), 127);
    EXPECT_EQ(static_cast<int>(normal.levels[0][2]), 255);
    EXPECT_EQ(normal.levels.size(), 5u);
    EXPECT_THAT(read_file(place / "out/import_unreal.py"), HasSubstr("TMGS_LEAVE_EXISTING_MIPS"));
    std::map<std::string, std::string> uses;
    const json manifest = json::parse(read_file(place / "out/manifest.json"));
    for (const json& output : manifest["sets"][0]["outputs"])
        uses[output["files"][0]["file"].get<std::string>()] = output["use"].get<std::string>();
    EXPECT_EQ(uses, (std::map<std::string, std::string>{{"T_Wall_BC.dds", "color"},
                                                        {"T_Wall_N.dds", "normal"},
                                                        {"T_Wall_ORM.dds", "mask"}}));
}

// As a file is read that was cut and filled up, in a format without a checksum.
TEST(TextureEngines, MapsWithEmptyRowsAreTold)
{
    const Workplace place("engine_zero_rows");
    write_wall(place / "in");
    Image rough = waves(16, 16, 1, 0.9f);
    std::fill(rough.pixels.begin() + 16 * 10, rough.pixels.end(), 0.0f);
    texproc::write_image(place / "in/Wall_roughness.png", rough);
    const Outcome made =
        run({"texture", "build", "in", "--engine", "gltf", "--no-score", "--rule", "median", "-o", "out"}, place);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.out,
                HasSubstr("Wall_roughness.png as roughness: rows 10 to 15 of 16 are zero"));
    EXPECT_THAT(made.out, Not(HasSubstr("as albedo")));
}

TEST(TextureEngines, PhonesGetAstc)
{
    if (!texproc::has_astc()) GTEST_SKIP() << "built without Arm's library for ASTC (libastcenc-dev)";
    const Workplace place("engine_mobile");
    write_wall(place / "in");
    const Outcome made = run({"texture", "build", "in", "--engine", "mobile", "--no-score", "--rule", "median", "-o", "out"}, place);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const texproc::MipTexture color = texproc::read_texture(place / "out/Wall_baseColor.ktx2");
    EXPECT_EQ(texproc::name_of(color.format), "astc-6x6");
    EXPECT_TRUE(color.srgb);
    EXPECT_EQ(color.levels.size(), 5u);
    const texproc::MipTexture normal = texproc::read_texture(place / "out/Wall_normal.ktx2");
    EXPECT_EQ(texproc::name_of(normal.format), "astc-5x5");
    EXPECT_FALSE(normal.srgb);
    const texproc::RawImage flat = texproc::decode_level(normal, 0);
    EXPECT_NEAR(std::to_integer<int>(flat.bytes[2]), 255, 1) << "z of a flat wall";
    // There is no DDS of it: that is written without blocks.
    EXPECT_EQ(run({"texture", "build", "in", "--engine", "mobile", "--format", "dds", "--no-score", "--rule", "median", "-o", "dds"}, place).exit_code, 0);
    EXPECT_FALSE(texproc::read_texture(place / "dds/Wall_orm.dds").format.block.has_value());
}

// Nearly flat: blocks cost more than the filter gains there.
TEST(TextureEngines, BlocksAreNeverWorseThanPlainMipsInThem)
{
    NEED_ASSETS(assets);
    const Workplace place("engine_guard");
    const std::string scene = (assets / "models/NormalTangentTest.glb").string();
    const Outcome made = run(
        {"texture", "build", scene, "--engine", "unity-urp", "--size", "128", "-o", "out"}, place);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const json manifest = json::parse(read_file(place / "out/manifest.json"));
    const json& error = manifest["sets"][0]["picture_error"];
    EXPECT_LE(error["shipped"]["rmse"].get<double>(), error["plain"]["rmse"].get<double>());
    EXPECT_LE(error["shipped"]["flicker"].get<double>(), error["plain"]["flicker"].get<double>());
}

TEST(TextureEngines, UnityGetsMetaFilesWithLastingGuids)
{
    const Workplace place("engine_unity");
    write_wall(place / "in");
    const auto built = [&](const std::vector<std::string>& more) {
        std::vector<std::string> command{"texture",   "build",      "in", "--engine",
                                         "unity-urp", "--no-score", "--rule", "median", "-o", "out"};
        command.insert(command.end(), more.begin(), more.end());
        const Outcome made = run(command, place);
        EXPECT_EQ(made.exit_code, 0) << made.err;
        return read_file(place / "out/Wall_BaseMap.dds.meta");
    };
    const std::string color = built({});
    const std::string normal = read_file(place / "out/Wall_Normal.dds.meta");
    EXPECT_THAT(color, HasSubstr("\nIHVImageFormatImporter:\n"));
    EXPECT_THAT(color, HasSubstr("\n  sRGBTexture: 1\n"));
    EXPECT_THAT(normal, HasSubstr("\n  sRGBTexture: 0\n"));
    EXPECT_THAT(color, HasSubstr("\n    wrapU: 0\n"));
    const std::string guid = line_of(color, "guid: ");
    EXPECT_EQ(guid.size(), std::strlen("guid: ") + 32);
    EXPECT_NE(guid, line_of(normal, "guid: "));

    // Another content and other edges: the same asset.
    texproc::write_image(place / "in/Wall_albedo.png", waves(16, 16, 3, 0.6f));
    const std::string clamped = built({"--wrap", "clamp"});
    EXPECT_EQ(line_of(clamped, "guid: "), guid);
    EXPECT_THAT(clamped, HasSubstr("\n    wrapU: 1\n"));

    // What Unity compresses itself has the type of normals, and z.
    built({"--format", "png"});
    EXPECT_THAT(read_file(place / "out/Wall_Normal.png.meta"), HasSubstr("\n  textureType: 1\n"));
    EXPECT_THAT(read_file(place / "out/Wall_BaseMap.png.meta"),
                HasSubstr("\n    sRGBTexture: 1\n"));
    EXPECT_EQ(texproc::read_raw(place / "out/Wall_Normal.png").channels, 3);
}

TEST(TextureEngines, GodotIsToldWhatItCompresses)
{
    const Workplace place("engine_godot");
    write_wall(place / "in");
    ASSERT_EQ(run({"texture", "build", "in", "--engine", "godot", "--no-score", "--rule", "median", "-o", "dds"}, place)
                  .exit_code,
              0);
    EXPECT_FALSE(fs::exists(place / "dds/Wall_albedo.dds.import")) << "loaded as it is";
    ASSERT_EQ(run({"texture", "build", "in", "--engine", "godot", "--no-score", "--rule", "median", "--format", "png",
                   "-o", "png"},
                  place)
                  .exit_code,
              0);
    EXPECT_THAT(read_file(place / "png/Wall_normal.png.import"),
                HasSubstr("compress/normal_map=1\n"));
    EXPECT_THAT(read_file(place / "png/Wall_albedo.png.import"),
                HasSubstr("compress/normal_map=2\n"));
}

TEST(TextureEngines, TilesOfASetStayTiles)
{
    const Workplace place("engine_udim");
    write_wall(place / "in", ".1001");
    write_wall(place / "in", ".1012");
    const Outcome made =
        run({"texture", "build", "in", "--engine", "unity-urp", "--no-score", "--rule", "median", "-o", "out"}, place);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr("2 built"));
    for (const char* tile : {"1001", "1012"}) {
        const std::string file = std::string("out/Wall_BaseMap.") + tile + ".dds";
        ASSERT_TRUE(fs::exists(place / file)) << file;
        EXPECT_THAT(read_file(place / (file + ".meta")), HasSubstr("\n    wrapU: 1\n"))
            << "past its edge lies another tile";
    }
    write_file(place / "wall.toml",
               "engines = [\"unity-urp\"]\n[inputs]\nalbedo = \"in/Wall_albedo.<UDIM>.png\"\n");
    const Outcome recipe = run({"texture", "build", "wall.toml", "-o", "own"}, place);
    ASSERT_EQ(recipe.exit_code, 0) << recipe.err;
    EXPECT_TRUE(fs::exists(place / "own/wall_BaseMap.1012.dds"));
    write_file(place / "none.toml",
               "engines = [\"unity-urp\"]\n[inputs]\nalbedo = \"in/None.<UDIM>.png\"\n");
    const Outcome none = run({"texture", "build", "none.toml", "-o", "own"}, place);
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_THAT(none.err, HasSubstr("None.<UDIM>.png"));
}

TEST(TextureEngines, MapsThatMeetAreBroughtToOneSize)
{
    const Workplace place("engine_sizes");
    write_wall(place / "in");
    texproc::write_image(place / "in/Wall_ao.png", Image(8, 16, 1, ColorSpace::Data, 0.5f));
    texproc::write_image(place / "in/Wall_height.png", waves(32, 32, 1, 0.9f));
    const Outcome made =
        run({"texture", "build", "in", "--engine", "unreal", "--no-score", "--rule", "median", "-o", "out"}, place);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr("note: Wall: occlusion: 8 x 16 resampled to 16 x 16\n"));
    EXPECT_THAT(made.out, Not(HasSubstr("height:"))) << "it meets no other map in a file";
    const texproc::RawImage orm = texproc::read_raw(place / "out/T_Wall_ORM.dds");
    EXPECT_EQ(orm.width, 16);
    EXPECT_EQ(static_cast<int>(orm.bytes[0]), 128) << "a level field stays level";
    EXPECT_EQ(texproc::read_raw(place / "out/T_Wall_H.png").width, 32);
}

TEST(TextureEngines, AScenesMapsBecomeTexturesOfAnEngine)
{
    const Workplace place("engine_scene");
    write_file(place / "scene.glb", tiny_scene_glb());
    const Outcome made =
        run({"texture", "build", "scene.glb", "--engine", "unity-hdrp", "--no-score", "--rule", "median", "-o", "out"},
            place);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    std::set<std::string> kinds;
    for (const auto& entry : fs::directory_iterator(place / "out")) {
        const std::string name = entry.path().filename().string();
        EXPECT_EQ(name.find("image_"), std::string::npos) << "images of the scene are not left";
        EXPECT_FALSE(entry.is_directory()) << name;
        if (entry.path().extension() == ".dds") kinds.insert(name.substr(name.rfind('_')));
    }
    EXPECT_TRUE(kinds.count("_BaseMap.dds")) << made.out;
    EXPECT_THAT(made.out, HasSubstr("materials built"));
}

}  // namespace
}  // namespace petrichor::cli
