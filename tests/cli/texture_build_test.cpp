// `petrichor texture build` from outside, on a folder of small generated materials.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "cli/texture/build/sha256.h"
#include "tests/support/program.h"
#include "texproc/codecs/files/texture.h"
#include "texproc/generate/generate.h"
#include "texproc/material/material_names.h"
#include "texproc/material/pack.h"

namespace petrichor::cli {
namespace {

using testing::HasSubstr;
using namespace testing_program;
namespace fs = std::filesystem;
using nlohmann::json;

// brick and soil, 64 x 64, with the names of two different tools.
void write_materials(const fs::path& folder)
{
    const texproc::MaterialMaps brick =
        texproc::generate_material(texproc::MaterialKind::Brick, 64, 1, 1);
    texproc::write_image(folder / "Brick01_1K-PNG_Color.png", brick.albedo);
    texproc::write_image(folder / "Brick01_1K-PNG_NormalGL.png", brick.normal);
    texproc::write_image(folder / "Brick01_1K-PNG_Roughness.png", brick.roughness);
    texproc::write_image(folder / "Brick01_1K-PNG_Displacement.png", brick.height, {.bits = 16});
    const texproc::MaterialMaps soil =
        texproc::generate_material(texproc::MaterialKind::Soil, 64, 1, 1);
    texproc::write_image(folder / "wet/soil_diff_2k.png", soil.albedo);
    texproc::write_image(folder / "wet/soil_nor_gl_2k.png", soil.normal);
    texproc::write_raw(
        folder / "wet/soil_arm_2k.png",
        texproc::pack(texproc::pack_preset("gltf-orm"),
                      {{"roughness", texproc::to_raw(soil.roughness, texproc::PixelType::U8)},
                       {"occlusion", texproc::to_raw(soil.occlusion, texproc::PixelType::U8)}}));
}

// For what does not depend on how levels are filtered, nor on what they score.
std::vector<std::string> quickly(std::vector<std::string> command)
{
    command.insert(command.end(), {"--rule", "median", "--no-score"});
    return command;
}

// Every file below a folder but the build's own memory, with its content.
std::map<std::string, std::string> contents(const fs::path& folder)
{
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = fs::relative(entry.path(), folder).string();
        if (entry.is_regular_file() && name != ".petrichor-build.json")
            all[name] = read_file(entry.path());
    }
    return all;
}

TEST(Sha256, KnownValues)
{
    EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256(std::string(1000000, 'a')),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

struct NameCase {
    const char* stem;
    const char* material;
    const char* roles;  // "role=channels "
    texproc::Green green = texproc::Green::Auto;
};
void PrintTo(const NameCase& c, std::ostream* out)
{
    *out << c.stem;
}

class MapNames : public testing::TestWithParam<NameCase> {};
TEST_P(MapNames, SayWhatTheyAre)
{
    const texproc::NamedMaps named = texproc::maps_named(GetParam().stem);
    EXPECT_EQ(named.short_name, GetParam().material);
    std::string roles;
    for (const auto& [role, channels] : named.roles) roles += role + "=" + channels + " ";
    EXPECT_EQ(roles, GetParam().roles);
    EXPECT_EQ(named.green, GetParam().green);
}
INSTANTIATE_TEST_SUITE_P(
    Table, MapNames,
    testing::Values(NameCase{"Bricks102_1K-JPG_NormalDX", "Bricks102",
                             "normal= ", texproc::Green::Down},
                    NameCase{"Bricks102_1K-JPG_AmbientOcclusion", "Bricks102", "occlusion= "},
                    NameCase{"cobblestone_pavement_nor_gl_2k", "cobblestone_pavement",
                             "normal= ", texproc::Green::Up},
                    NameCase{"cobblestone_pavement_arm_2k", "cobblestone_pavement",
                             "metallic=b occlusion=r roughness=g "},
                    NameCase{"Old_Wall_LuxSPEC", "Old_Wall", "smoothness=a specular=rgb "},
                    NameCase{"Old_Wall_LuxNRM", "Old_Wall", "normal= "},
                    NameCase{"metal_plate_02_rough_4k", "metal_plate_02", "roughness= "},
                    NameCase{"ground037_nrm_rgh", "ground037", "normal=rgb roughness=a "},
                    NameCase{"WallBaseColor", "Wall", "albedo= "},
                    NameCase{"albedo", "", "albedo= "}, NameCase{"preview", "", ""},
                    NameCase{"T_Old_Wall_BC", "Old_Wall", "albedo= "},
                    NameCase{"T_Wall_N", "Wall", "normal= "}, NameCase{"Plan_N", "", ""},
                    NameCase{"Mauer_grün_normal", "Mauer_grün", "normal= "},
                    NameCase{"snow_water_Color", "snow_water", "albedo= "}));

TEST(TextureBuild, MakesEveryMaterialOfAFolderOnce)
{
    const Workplace place("build");
    write_materials(place / "in");
    const std::vector<std::string> command{"texture",  "build",    "in", "--engine", "gltf",
                                           "--engine", "filament", "-o", "out"};
    const Outcome outcome = run(command, place);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto first = contents(place / "out");
    EXPECT_TRUE(first.count("gltf/Brick01_baseColor.ktx2"));
    EXPECT_TRUE(first.count("gltf/wet/soil_occlusionRoughnessMetallic.ktx2"));
    EXPECT_TRUE(first.count("filament/wet/soil_orm_6.png")) << "one file a level";
    EXPECT_THAT(outcome.out, HasSubstr("2 built"));

    // The manifest names every file and its hash, and the error that was measured.
    const json manifest = json::parse(first.at("manifest.json"));
    std::set<std::string> named;
    for (const json& set : manifest["sets"]) {
        EXPECT_TRUE(set.contains("lobe_error")) << set["name"];
        const json& picture = set["picture_error"];
        EXPECT_LE(picture["shipped"]["rmse"].get<double>(),
                  picture["plain"]["rmse"].get<double>() + 1e-4);
        for (const json& output : set["outputs"]) {
            for (const json& file : output["files"]) {
                const std::string name = file["file"].get<std::string>();
                named.insert(name);
                EXPECT_EQ(file["sha256"].get<std::string>(), sha256(first.at(name))) << name;
            }
        }
    }
    EXPECT_EQ(named.size() + 1, first.size());

    // Level 0 keeps the codes of the source.
    const texproc::RawImage base = texproc::read_raw(place / "out/filament/Brick01_normal_0.png");
    EXPECT_EQ(base.bytes, texproc::read_raw(place / "in/Brick01_1K-PNG_NormalGL.png").bytes);

    const Outcome again = run(command, place);
    EXPECT_THAT(again.out, HasSubstr("0 built (0 files), 2 up to date"));
    EXPECT_EQ(contents(place / "out"), first);

    // A new time alone is nothing new; a new content is; a damaged output is mended.
    fs::last_write_time(place / "in/wet/soil_diff_2k.png", fs::file_time_type::clock::now());
    EXPECT_THAT(run(command, place).out, HasSubstr("2 up to date"));
    texproc::write_image(place / "in/wet/soil_diff_2k.png",
                         Image(64, 64, 3, ColorSpace::Linear, 0.3f));
    EXPECT_THAT(run(command, place).out, HasSubstr("1 built"));
    write_file(place / "out/gltf/Brick01_normal.ktx2", "scribble");
    EXPECT_THAT(run(command, place).out, HasSubstr("1 built"));
    EXPECT_EQ(contents(place / "out").at("gltf/Brick01_normal.ktx2"),
              first.at("gltf/Brick01_normal.ktx2"));
}

TEST(TextureBuild, BytesDoNotDependOnThreads)
{
    const Workplace place("build_threads");
    write_materials(place / "in");
    ASSERT_EQ(run({"texture", "build", "in", "--engine", "filament", "--threads", "1", "-o", "one"},
                  place)
                  .exit_code,
              0);
    ASSERT_EQ(
        run({"texture", "build", "in", "--engine", "filament", "--threads", "5", "-o", "five"},
            place)
            .exit_code,
        0);
    EXPECT_EQ(contents(place / "one"), contents(place / "five"));
}

TEST(TextureBuild, ARecipeSaysWhatGoesWhere)
{
    const Workplace place("build_recipe");
    write_materials(place / "in");
    write_file(place / "mine.toml", R"(
note = "turned green, smoothness, a baked mask"
[inputs]
normal = "in/Brick01_1K-PNG_NormalGL.png"
roughness = "in/Brick01_1K-PNG_Roughness.png"
height = "in/Brick01_1K-PNG_Displacement.png"
[prefilter]
rule = "median"
[[output]]
file = "T_{name}_N"
channels = ["normal.r", "1 - normal.g", "normal.b"]
[[output]]
file = "{name}_mask"
channels = ["porosity", "puddle", "1 - roughness"]
bits = 16
[[output]]
file = "{name}_small"
preset = "own.toml"
format = "tga"
size = 16
)");
    write_file(place / "own.toml", "channels = [\"roughness\", \"0.5\", \"0\"]\n");
    const Outcome outcome = run({"texture", "build", "mine.toml", "-o", "out"}, place);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const texproc::RawImage before = texproc::read_raw(place / "in/Brick01_1K-PNG_NormalGL.png");
    const texproc::RawImage after = texproc::read_raw(place / "out/T_mine_N.png");
    for (std::size_t i = 0; i < before.bytes.size(); i += 3) {
        ASSERT_EQ(static_cast<int>(after.bytes[i]), static_cast<int>(before.bytes[i]));
        ASSERT_EQ(static_cast<int>(after.bytes[i + 1]),
                  255 - static_cast<int>(before.bytes[i + 1]));
    }
    EXPECT_EQ(texproc::read_raw(place / "out/mine_mask.png").type, texproc::PixelType::U16);
    const texproc::RawImage small = texproc::read_raw(place / "out/mine_small.tga");
    EXPECT_EQ(small.width, 16);
    EXPECT_EQ(static_cast<int>(small.bytes[1]), 128);

    const Outcome dry = run({"texture", "build", "mine.toml", "--dry-run"}, place);
    EXPECT_EQ(dry.exit_code, 0) << dry.err;
    EXPECT_THAT(dry.out, HasSubstr("baked       porosity, puddle"));
}

// Level 0 of an image beside what a file holds of it.
double psnr_of(const fs::path& file, const texproc::RawImage& source)
{
    const texproc::RawImage read = texproc::decode_level(texproc::read_texture(file), 0);
    double sum = 0.0;
    const std::size_t texels = source.values() / 3;
    for (std::size_t i = 0; i < texels; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const auto code = [](const texproc::RawImage& of, std::size_t at) {
                return std::to_integer<int>(of.bytes[at]);
            };
            sum += std::pow(code(read, 4 * i + c) - code(source, 3 * i + c), 2);
        }
    return 10.0 * std::log10(65025.0 * 3.0 * static_cast<double>(texels) / sum);
}

// What zstd packs repeats blocks by default; a recipe and the command line say how much.
TEST(TextureBuild, BlocksRepeatForSmallerFilesWithinABound)
{
    const Workplace place("build_rdo");
    Image soft(128, 128, 3, ColorSpace::Data);
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x)
            for (int c = 0; c < 3; ++c)
                soft.at(x, y, c) =
                    0.5f + 0.3f * std::sin(0.04f * static_cast<float>(x + y * (c + 1))) +
                    0.004f * static_cast<float>((x * 7919 + y * 104729 + c * 31) % 3);
    texproc::write_image(place / "in/Wall_albedo.png", soft);
    const texproc::RawImage source = texproc::read_raw(place / "in/Wall_albedo.png");
    const auto built = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"texture", "build"});
        more.insert(more.end(), {"-o", "out", "--force"});
        const Outcome done = run(more, place);
        EXPECT_EQ(done.exit_code, 0) << done.err;
        return place / "out/Wall_baseColor.ktx2";
    };
    const auto error_of = [](double db) { return 65025.0 * std::pow(10.0, -0.1 * db); };
    std::uintmax_t size = 0;
    double psnr = 0.0;
    for (const char* rdo : {"0", "0.25", "1", "16"}) {  // each costs more and saves more
        const fs::path file = built({"in", "--engine", "gltf", "--rdo", rdo, "--rdo-most", "255"});
        if (size > 0) {
            EXPECT_LT(fs::file_size(file), size) << rdo;
            EXPECT_LT(psnr_of(file, source), psnr) << rdo;
        }
        size = fs::file_size(file);
        psnr = psnr_of(file, source);
    }
    // No block gets farther off than one code, root mean square.
    const double best = error_of(psnr_of(built({"in", "--engine", "gltf", "--rdo", "0"}), source));
    const fs::path bounded = built({"in", "--engine", "gltf", "--rdo", "16"});
    EXPECT_LE(error_of(psnr_of(bounded, source)), best + 1.0);
    EXPECT_GT(error_of(psnr_of(bounded, source)), best);
    const std::string most = read_file(bounded);
    const std::string one = read_file(built({"in", "--engine", "gltf", "--rdo", "1"}));
    EXPECT_EQ(read_file(built({"in", "--engine", "gltf"})), one) << "the default";
    EXPECT_LT(one.size(), read_file(built({"in", "--engine", "gltf", "--rdo", "0"})).size());
    EXPECT_LT(read_file(built({"in", "--engine", "gltf", "--rdo", "16", "--rdo-most", "4"})).size(), most.size());
    const auto recipe = [&](const std::string& lines) {
        write_file(place / "r.toml",
                   "name = \"Wall\"\n[inputs]\nalbedo = \"in/Wall_albedo.png\"\n[[output]]\n"
                   "file = \"{name}_baseColor\"\nchannels = [\"albedo.r\", \"albedo.g\", "
                   "\"albedo.b\", \"1\"]\nsrgb = true\nformat = \"ktx2\"\ncompression = \"uastc\"\n" +
                       lines);
        return read_file(built({"r.toml"}));
    };
    EXPECT_EQ(recipe("rdo = 16\n"), most);
    EXPECT_GT(recipe("rdo = 0\n").size(), one.size());
    EXPECT_LT(recipe("rdo = 16\nrdo_most = 4\n").size(), most.size());
    const Outcome none = run({"texture", "build", "in", "--engine", "unreal", "--rdo", "1", "-o", "out"}, place);
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_THAT(none.err, HasSubstr("no output is one for --rdo"));
}

TEST(TextureBuild, OneBadMaterialDoesNotStopTheOthers)
{
    const Workplace place("build_bad");
    write_materials(place / "in");
    const std::vector<std::string> command =
        quickly({"texture", "build", "in", "--engine", "gltf", "-o", "out"});
    ASSERT_EQ(run(command, place).exit_code, 0);
    const auto before = contents(place / "out");
    write_file(place / "in/wet/soil_arm_2k.png", "not a picture");
    texproc::write_image(place / "in/Brick01_1K-PNG_Color.png",
                         Image(64, 64, 3, ColorSpace::Linear, 0.2f));
    const Outcome outcome = run(command, place);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("soil_arm_2k.png"));
    EXPECT_THAT(outcome.out, HasSubstr("1 built"));
    const auto after = contents(place / "out");
    EXPECT_EQ(after.at("wet/soil_normal.ktx2"), before.at("wet/soil_normal.ktx2"))
        << "old outputs stay";
    EXPECT_NE(after.at("Brick01_baseColor.ktx2"), before.at("Brick01_baseColor.ktx2"));
    EXPECT_EQ(after.size(), before.size()) << "nothing half done is left";
}

TEST(TextureBuild, AFullDiskLeavesTheOldFilesWhole)
{
    const Workplace place("build_full");
    write_materials(place / "in");
    const std::vector<std::string> command =
        quickly({"texture", "build", "in", "--engine", "unreal", "--force", "-o", "out"});
    ASSERT_EQ(run(command, place).exit_code, 0);
    const auto before = contents(place / "out");
    // Room for what is decoded (three bytes a texel), but not for four and the mips.
    const Outcome outcome =
        run_petrichor({.arguments = command, .file_limit_bytes = 14000}, place.path());
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("cannot write out/"));
    EXPECT_EQ(outcome.err.find(".petrichor-"), std::string::npos) << "no folder of our own";
    EXPECT_EQ(contents(place / "out"), before);
}

TEST(TextureBuild, WatchBuildsAgainAndEndsWithCtrlC)
{
    const Workplace place("build_watch");
    write_materials(place / "in");
    // The change is made by the test while the program waits; the second file is the sign to stop.
    const fs::path sign = place / "out/wet/soil_emissive.ktx2";
    std::thread change([&] {
        for (int i = 0; i < 1000 && !fs::exists(place / "out/manifest.json"); ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        texproc::write_image(place / "in/wet/soil_emission_2k.png",
                             Image(64, 64, 3, ColorSpace::Linear, 0.5f));
    });
    const Outcome outcome = run_petrichor(
        {.arguments = quickly({"texture", "build", "in", "--engine", "gltf", "--watch", "-o", "out"}),
         .interrupt_when = sign},
        place.path());
    change.join();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(fs::exists(sign));
    EXPECT_THAT(outcome.out, HasSubstr("watching"));
}

struct Mistake {
    const char* name;
    const char* recipe;
    const char* message;
};
void PrintTo(const Mistake& m, std::ostream* out)
{
    *out << m.name;
}

class RecipeMistake : public testing::TestWithParam<Mistake> {};
TEST_P(RecipeMistake, IsNamedWithItsLine)
{
    const Workplace place(std::string("recipe_") + GetParam().name);
    write_materials(place / "in");
    write_file(place / "r.toml", GetParam().recipe);
    const Outcome outcome = run({"texture", "build", "r.toml", "-o", "out"}, place);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(GetParam().message));
    EXPECT_THAT(outcome.err, HasSubstr("\n  ")) << "says what to do";
}
INSTANTIATE_TEST_SUITE_P(
    Table, RecipeMistake,
    testing::Values(
        Mistake{"engine", "engines = [\"unity-hdrpp\"]\nfolder = \"in\"\n",
                "Did you mean \"unity-hdrp\"?"},
        Mistake{"nothing", "engines = [\"gltf\"]\n", "it names no maps"},
        Mistake{"role", "engines = [\"gltf\"]\n[inputs]\nnormale = \"a.png\"\n", "r.toml:3"},
        Mistake{"gone", "engines = [\"gltf\"]\n[inputs]\nalbedo = \"gone.png\"\n", "gone.png"},
        Mistake{"channel",
                "[inputs]\nnormal = \"in/Brick01_1K-PNG_NormalGL.png:a\"\n[[output]]\nfile = "
                "\"{name}_n\"\nchannels = [\"normal\"]\n",
                "'a' is not one of them"},
        Mistake{"no_outputs", "folder = \"in\"\n", "nothing says what to make"},
        Mistake{"no_name", "folder = \"in\"\n[[output]]\nfile = \"x\"\nchannels = [\"normal\"]\n",
                "{name}"},
        Mistake{"compression",
                "folder = \"in\"\n[[output]]\nfile = \"{name}\"\nchannels = "
                "[\"normal\"]\ncompression = \"bc7\"\n",
                "bc7 in a png"},
        Mistake{"rdo",
                "folder = \"in\"\n[[output]]\nfile = \"{name}\"\nchannels = "
                "[\"normal\"]\nformat = \"ktx2\"\nrdo = 1\n",
                "asks for rdo in ktx2"},
        Mistake{"rdo_loss",
                "folder = \"in\"\n[[output]]\nfile = \"{name}\"\nchannels = "
                "[\"normal\"]\nformat = \"dds\"\ncompression = \"bc4\"\nrdo_most = 1\n",
                "does not ask for"},
        Mistake{"syntax", "folder = in\n", "r.toml"},
        Mistake{"rule", "folder = \"in\"\nengines = [\"gltf\"]\n[prefilter]\nrule = \"best\"\n",
                "best"},
        Mistake{
            "sizes",
            "[inputs]\nroughness = \"in/Brick01_1K-PNG_Roughness.png\"\nocclusion = \"small.png\"\n"
            "[[output]]\nfile = \"{name}\"\npreset = \"gltf-orm\"\n",
            "small.png"}),
    [](const auto& test) { return test.param.name; });

TEST(TextureBuild, MapsOfDifferentSizesAreResampled)
{
    const Workplace place("build_sizes");
    write_materials(place / "in");
    texproc::write_image(place / "in/Brick01_1K-PNG_AmbientOcclusion.png",
                         Image(32, 64, 1, ColorSpace::Data, 0.5f));
    const Outcome outcome = run(quickly({"texture", "build", "in", "--engine", "gltf", "-o", "out"}), place);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("Brick01: occlusion: 32 x 64 resampled to 64 x 64"));
    EXPECT_TRUE(fs::exists(place / "out/Brick01_occlusionRoughnessMetallic.ktx2"));
}

// Several engines built one after the other into one folder: the manifest tells of all whose files
// are still there.
TEST(TextureBuild, TheManifestKeepsAnEntryForEachEngine)
{
    const Workplace place("build-engines");
    write_materials(place / "in");
    const auto build = [&](const std::string& engine) {
        return run(quickly({"texture", "build", "in", "--engine", engine, "-o", "out"}), place);
    };
    const auto entries = [&] {
        std::set<std::string> all;
        const json manifest = json::parse(read_file(place / "out/manifest.json"));
        for (const json& set : manifest["sets"]) {
            all.insert(set["name"].get<std::string>() + " " +
                       set["engines"].at(0).get<std::string>());
        }
        return all;
    };
    ASSERT_EQ(build("gltf").exit_code, 0);
    ASSERT_EQ(build("unity-hdrp").exit_code, 0);
    const std::set<std::string> both{"Brick01 gltf", "Brick01 unity-hdrp", "wet/soil gltf",
                                     "wet/soil unity-hdrp"};
    EXPECT_EQ(entries(), both);
    EXPECT_THAT(build("gltf").out, HasSubstr("0 built (0 files), 2 up to date"));
    EXPECT_EQ(entries(), both);

    // Both write Brick01_Normal.dds.
    ASSERT_EQ(build("unity-urp").exit_code, 0);
    EXPECT_EQ(entries(), (std::set<std::string>{"Brick01 gltf", "Brick01 unity-urp",
                                                "wet/soil gltf", "wet/soil unity-urp"}));
    // A material that is gone is forgotten, for the engine that was built.
    fs::remove_all(place / "in/wet");
    ASSERT_EQ(build("unity-urp").exit_code, 0);
    EXPECT_EQ(entries(),
              (std::set<std::string>{"Brick01 gltf", "Brick01 unity-urp", "wet/soil gltf"}));
}

// An output that a map is missing for is left out by name; the others are made.
TEST(TextureBuild, WhatCannotBeFilledIsLeftOut)
{
    const Workplace place("build-left-out");
    texproc::write_image(place / "in/Leaf_opacity.png", Image(8, 8, 1, ColorSpace::Data, 0.5f));
    texproc::write_image(place / "in/Leaf_normal.png", Image(8, 8, 3, ColorSpace::Data, 0.5f));
    const std::vector<std::string> command{"texture", "build", "in", "--engine",
                                           "gltf",    "-o",    "out"};
    std::vector<std::string> dry = command;
    dry.push_back("--dry-run");
    EXPECT_THAT(run(dry, place).out,
                HasSubstr("left out    Leaf_baseColor.ktx2: there is no albedo"));
    const Outcome made = run(command, place);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_TRUE(fs::exists(place / "out/Leaf_normal.ktx2"));
    EXPECT_FALSE(fs::exists(place / "out/Leaf_baseColor.ktx2"));
}

// People learn which images nothing was made of. Weather textures are no materials.
TEST(TextureBuild, DryRunNamesWhatItPassesOver)
{
    const Workplace place("build-passed-over");
    const Image grey(8, 8, 1, ColorSpace::Data, 0.5f);
    for (const char* name : {"Wall_roughness", "IMG_0042", "ripple", "snow_water_bump"})
        texproc::write_image(place / ("in/" + std::string(name) + ".png"), grey);
    const Outcome dry = run({"texture", "build", "in", "--engine", "gltf", "--dry-run"}, place);
    ASSERT_EQ(dry.exit_code, 0) << dry.err;
    EXPECT_THAT(dry.out, HasSubstr("passed over"));
    EXPECT_THAT(dry.out, HasSubstr("IMG_0042.png"));
    EXPECT_THAT(dry.out, HasSubstr("Wall_occlusionRoughnessMetallic.ktx2"));
    EXPECT_THAT(dry.out, testing::Not(HasSubstr("ripple")));
    EXPECT_THAT(dry.out, testing::Not(HasSubstr("snow_water")));
}

// URP reads occlusion from green, which a one-channel file does not have.
TEST(TextureBuild, OcclusionForUrpIsGreen)
{
    const Workplace place("build-urp");
    texproc::write_image(place / "in/Wall_ao.png", Image(8, 8, 1, ColorSpace::Data, 0.8f));
    ASSERT_EQ(
        run({"texture", "build", "in", "--engine", "unity-urp", "-o", "out"}, place).exit_code, 0);
    const texproc::RawImage file = texproc::read_raw(place / "out/Wall_Occlusion.dds");
    ASSERT_GE(file.channels, 3);
    EXPECT_NEAR(static_cast<int>(file.bytes[1]), 204, 1);
}

// Blocks turn the normals a little; the roughness beside them is chosen for what came out, and what
// ships is not worse than a rule that chooses nothing for the blocks.
TEST(TextureBuild, RoughnessIsAimedAtTheNormalsInTheFile)
{
    const Workplace place("build-aimed");
    const texproc::MaterialMaps metal =
        texproc::generate_material(texproc::MaterialKind::MetalPlate, 128, 3, 1);
    texproc::write_image(place / "metal_normal.png", metal.normal);
    texproc::write_image(place / "metal_roughness.png", metal.roughness);
    const auto built = [&](const std::string& name, const std::string& normals) {
        write_file(place / (name + ".toml"),
                   "[inputs]\nnormal = \"metal_normal.png\"\nroughness = "
                   "\"metal_roughness.png\"\n[[output]]\nfile = \"{name}_n\"\nchannels = "
                   "[\"normal.r\", \"normal.g\"]\n" +
                       normals +
                       "[[output]]\nfile = \"{name}_r\"\nchannels = [\"roughness\"]\n"
                       "format = \"dds\"\ncompression = \"bc4\"\n");
        return [&, name](const std::string& rule) {
            const Outcome made = run({"texture", "build", name + ".toml", "--rule", rule,
                                      "--quality", "full", "-o", name + rule},
                                     place);
            EXPECT_EQ(made.exit_code, 0) << made.err;
            return json::parse(read_file(place / (name + rule) / "manifest.json"))["sets"][0];
        };
    };
    const auto blocks = built("blocks", "format = \"dds\"\ncompression = \"bc5\"\n");
    const json ours = blocks("overlap"), median = blocks("median");
    for (const char* range : {"levels_1_to_5", "levels_6_up"}) {
        EXPECT_LE(ours["lobe_error"][range]["shipped"].get<double>(),
                  median["lobe_error"][range]["shipped"].get<double>() + 0.005)
            << range;
    }
    built("exact", "format = \"exr\"\nbits = 32\n")("overlap");
    EXPECT_NE(read_file(place / "blocksoverlap/blocks_r.dds"),
              read_file(place / "exactoverlap/exact_r.dds"));
    EXPECT_EQ(read_file(place / "blocksmedian/blocks_r.dds").size(),
              read_file(place / "exactoverlap/exact_r.dds").size());
}

// Full quality lights the maps as what their metallic map says: nothing metal as if there were no
// map, all of it as metal, some of it as neither.
TEST(TextureBuild, LevelsAreThoseOfWhatTheMetallicMapSays)
{
    const Workplace place("build-surface");
    const texproc::MaterialMaps plate =
        texproc::generate_material(texproc::MaterialKind::MetalPlate, 32, 3, 1);
    texproc::write_image(place / "normal.exr", plate.normal);
    texproc::write_image(place / "roughness.exr", plate.roughness);
    // share: how much of the map is metal, in a band; below 0 there is no map.
    const auto built = [&](const std::string& name, float share) {
        std::string recipe = "[inputs]\nnormal = \"normal.exr\"\nroughness = \"roughness.exr\"\n";
        std::string outputs =
            "[[output]]\nfile = \"{name}_n\"\nchannels = [\"normal.r\", \"normal.g\"]\n"
            "format = \"dds\"\ncompression = \"bc5\"\n[[output]]\nfile = \"{name}_r\"\n"
            "channels = [\"roughness\"]\nformat = \"dds\"\ncompression = \"bc4\"\n";
        if (share >= 0.0f) {
            Image metallic(32, 32, 1, ColorSpace::Data);
            for (int y = 0; y < 32; ++y)
                for (int x = 0; x < 32; ++x)
                    metallic.at(x, y, 0) = static_cast<float>(y) < 32.0f * share ? 1.0f : 0.0f;
            texproc::write_image(place / (name + "_metallic.png"), metallic);
            recipe += "metallic = \"" + name + "_metallic.png\"\n";
            outputs += "[[output]]\nfile = \"{name}_m\"\nchannels = [\"metallic\"]\n";
        }
        write_file(place / (name + ".toml"), recipe + outputs);
        const Outcome made = run({"texture", "build", name + ".toml", "--quality", "full",
                                  "--no-score", "-o", name},
                                 place);
        EXPECT_EQ(made.exit_code, 0) << made.err;
        return read_file(place / name / (name + "_n.dds")) +
               read_file(place / name / (name + "_r.dds"));
    };
    const std::string none = built("none", -1.0f), paint = built("paint", 0.0f),
                      some = built("some", 0.5f), metal = built("metal", 1.0f);
    EXPECT_TRUE(none == paint);
    EXPECT_FALSE(some == paint);
    EXPECT_FALSE(metal == paint);
    EXPECT_FALSE(metal == some);
}

// A second lobe lies beside the normals of an engine, turned as they are, and is what is scored.
TEST(TextureBuild, ASecondLobeGoesWithTheNormals)
{
    const Workplace place("build-lobes");
    const texproc::MaterialMaps plate = texproc::generate_material(texproc::MaterialKind::MetalPlate, 64, 3, 1);
    texproc::write_image(place / "in/plate_normal.png", plate.normal);
    texproc::write_image(place / "in/plate_roughness.png", plate.roughness);
    texproc::write_image(place / "in/plate_metallic.png", Image(64, 64, 1, ColorSpace::Data, 1.0f));
    const auto built = [&](const std::string& lobes) {
        const Outcome made = run({"texture", "build", "in", "--engine", "unreal", "--quality", "full", "--lobes", lobes,
                                  "-o", "out" + lobes},
                                 place);
        EXPECT_EQ(made.exit_code, 0) << made.err;
        return json::parse(contents(place / ("out" + lobes)).at("manifest.json"))["sets"][0]["picture_error"];
    };
    const json one = built("1"), two = built("2");
    EXPECT_EQ(one["lobes"], 1);
    EXPECT_EQ(two["lobes"], 2);
    EXPECT_LT(two["shipped"]["rmse"].get<double>(), one["shipped"]["rmse"].get<double>());
    EXPECT_FALSE(fs::exists(place / "out1/plate_second_lobe.dds"));
    // Filament's normals are levels of PNG and a KTX2.
    EXPECT_EQ(run({"texture", "build", "in", "--engine", "filament", "--quality", "full", "--lobes", "2", "-o", "both"}, place).exit_code, 0);
    EXPECT_TRUE(fs::exists(place / "both/plate_second_lobe.ktx2"));
    EXPECT_TRUE(fs::exists(place / "both/plate_second_lobe_1.png"));
    const texproc::RawImage lobe = texproc::read_raw(place / "out2/plate_second_lobe.dds"),
                            normal = texproc::read_raw(place / "out2/T_plate_N.dds"),
                            rough = texproc::read_raw(place / "in/plate_roughness.png");
    ASSERT_EQ(lobe.channels, 4);
    const Image a = to_image(lobe, ColorSpace::Data), b = to_image(normal, ColorSpace::Data),
                r = to_image(rough, ColorSpace::Data);
    for (int i = 0; i < 64; ++i) {  // level 0: both lobes are the same
        EXPECT_NEAR(a.at(i, i, 0), b.at(i, i, 0), 0.003f);
        EXPECT_NEAR(a.at(i, i, 1), b.at(i, i, 1), 0.003f);
        EXPECT_NEAR(a.at(i, i, 2), r.at(i, i, 0), 0.003f);
        EXPECT_NEAR(a.at(i, i, 3), 0.5f, 0.003f);
    }
    for (const std::vector<std::string>& wrong :
         {std::vector<std::string>{"--engine", "unreal", "--quality", "quick"},
          std::vector<std::string>{"--engine", "unreal", "--quality", "full", "--format", "png"}}) {
        std::vector<std::string> command{"texture", "build", "in", "--lobes", "2", "-o", "wrong"};
        command.insert(command.end(), wrong.begin(), wrong.end());
        EXPECT_EQ(run(command, place).exit_code, 2);
    }
}

// A scene gets them as an extension, from the one rule that fits them, for readers that know KTX2.
TEST(TextureBuild, TwoLobesOfASceneAskForTheirRule)
{
    const Workplace place("build-scene-lobes");
    std::ofstream(place / "in.gltf") << R"({"asset": {"version": "2.0"}})";
    const auto built = [&](const std::vector<std::string>& more) {
        std::vector<std::string> command{"texture", "build", "in.gltf", "-o", "out.gltf", "--lobes", "2"};
        command.insert(command.end(), more.begin(), more.end());
        return run(command, place).exit_code;
    };
    EXPECT_EQ(built({"--quality", "full"}), 0);
    EXPECT_EQ(built({}), 2);
    EXPECT_EQ(built({"--quality", "quick"}), 2);
    EXPECT_EQ(built({"--quality", "full", "--rule", "median"}), 2);
    EXPECT_EQ(built({"--quality", "full", "--fallback"}), 2);
}

// A leaf, green where its own opacity map says so and black elsewhere.
TEST(TextureBuild, AnOpacityMapKeepsBlackOutOfTheLevels)
{
    const Workplace place("petrichor-build-leaf");
    Image color(32, 32, 3, ColorSpace::Linear), opacity(32, 32, 1, ColorSpace::Data);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            if ((x / 3 + y / 3) % 3 == 0) continue;
            opacity.at(x, y, 0) = 1.0f;
            color.at(x, y, 1) = 0.5f;
        }
    }
    texproc::write_image(place / "Leaf_Color.png", color);
    texproc::write_image(place / "Leaf_Opacity.png", opacity);
    const std::string recipe =
        "name = \"Leaf\"\n[inputs]\nalbedo = \"Leaf_Color.png\"\n"
        "opacity = \"Leaf_Opacity.png\"\n[[output]]\n"
        "file = \"{name}\"\nchannels = [\"albedo.r\", \"albedo.g\", "
        "\"albedo.b\", \"opacity\"]\nsrgb = true\nlevel_files = true\n";
    const auto green_of_level_2 = [&](const std::string& more) {
        write_file(place / "leaf.toml", recipe + more);
        const Outcome made = run({"texture", "build", "leaf.toml", "-o", "out"}, place);
        EXPECT_EQ(made.exit_code, 0) << made.err;
        return texproc::read_image(place / "out/Leaf_2.png", {.space = ColorSpace::Linear});
    };
    const Image weighted = green_of_level_2("");
    for (std::size_t i = 0; i < weighted.pixels.size(); i += 4) {
        EXPECT_NEAR(weighted.pixels[i + 1], 0.5f, 0.005f);
    }
    const Image plain = green_of_level_2("[mips]\nalpha_weighted = false\n");
    EXPECT_LT(plain.pixels[1], 0.45f);
}

}  // namespace
}  // namespace petrichor::cli
