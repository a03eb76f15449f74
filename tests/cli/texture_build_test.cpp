// `petrichor texture build` from outside, on a folder of small generated materials.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "cli/texture/build/sha256.h"
#include "tests/cli/texture_inputs.h"
#include "tests/support/program.h"

namespace petrichor::cli {
namespace {

using testing::HasSubstr;
using namespace testing_program;
using namespace testing_texture;
namespace fs = std::filesystem;
using nlohmann::json;

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

}  // namespace
}  // namespace petrichor::cli
