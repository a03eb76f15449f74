// pack, mips, normal, bake, unpack, compare, inspect, generate from outside: what they say about bad
// maps. Whatever goes wrong, files that were there stay as they were.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "base/sanitized.h"
#include "tests/cli/texture_inputs.h"
#include "tests/support/assets.h"
#include "tests/support/program.h"

namespace petrichor::cli {
namespace {

using testing::HasSubstr;
using namespace testing_program;
using namespace testing_texture;
namespace fs = std::filesystem;

struct Mistake {
    const char* name;
    std::vector<std::string> arguments;
    const char* message;
};
void PrintTo(const Mistake& m, std::ostream* out)
{
    *out << m.name;
}

class TextureMistake : public testing::TestWithParam<Mistake> {};
TEST_P(TextureMistake, ExitsWithTwoSaysWhatAndKeepsWhatWasThere)
{
    const Workplace place(std::string("texture_") + GetParam().name);
    write_maps(place);
    std::vector<std::string> arguments{"texture"};
    arguments.insert(arguments.end(), GetParam().arguments.begin(), GetParam().arguments.end());
    const Outcome outcome = run(arguments, place);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(GetParam().message));
    EXPECT_THAT(outcome.err, HasSubstr("\n  ")) << "says what to do";
    for (const char* name : {"out.png", "out_0.png", "out_1.png", "out_occlusion.png"}) {
        EXPECT_EQ(read_file(place / name), "old") << name;
    }
}
INSTANTIATE_TEST_SUITE_P(
    Table, TextureMistake,
    testing::Values(
        Mistake{"pack_no_file",
                {"pack", "--preset", "gltf-orm", "--roughness", "gone.png", "-o", "out.png"},
                "gone.png"},
        Mistake{"pack_no_picture",
                {"pack", "--preset", "gltf-orm", "--roughness", "text.png", "-o", "out.png"},
                "text.png"},
        Mistake{"pack_sizes",
                {"pack", "--preset", "gltf-orm", "--roughness", "rough.png", "--metallic",
                 "other.png", "-o", "out.png"},
                "16 x 32"},
        Mistake{"pack_preset",
                {"pack", "--preset", "gltf-rom", "--roughness", "rough.png", "-o", "out.png"},
                "gltf-rom"},
        Mistake{"pack_role",
                {"pack", "--preset", "gltf-orm", "--height", "height.png", "-o", "out.png"},
                "no channel for 'height'"},
        Mistake{
            "pack_nothing", {"pack", "--preset", "gltf-orm", "-o", "out.png"}, "no map was given"},
        Mistake{"pack_own",
                {"pack", "--preset", "bad.toml", "--map", "a=rough.png", "-o", "out.png"},
                "bad.toml:1"},
        Mistake{"pack_channel",
                {"pack", "--preset", "gltf-orm", "--roughness", "rough.png:b", "-o", "out.png"},
                "'b' is not one"},
        Mistake{"pack_folder",
                {"pack", "--preset", "gltf-orm", "--roughness", "rough.png", "-o", "file/out.png"},
                "file"},
        Mistake{"pack_format",
                {"pack", "--preset", "gltf-orm", "--roughness", "rough.png", "--format", "bc7",
                 "-o", "out.png"},
                "no blocks"},
        Mistake{"mips_pattern", {"mips", "color.png", "-o", "out.png"}, "%d"},
        Mistake{
            "mips_normals", {"mips", "rough.png", "--normals", "-o", "out_%d.png"}, "3 channels"},
        Mistake{"mips_alpha",
                {"mips", "color.png", "--alpha-cutoff", "0.5", "-o", "out_%d.png"},
                "4 channels"},
        Mistake{"mips_nan", {"mips", "nan.exr", "-o", "out_%d.png"}, "not numbers"},
        Mistake{"normal_channels",
                {"normal", "rough.png", "--flip-green", "-o", "out.png"},
                "3 channels"},
        Mistake{"normal_layout",
                {"normal", "normal.png", "--from-layout", "ag", "-o", "out.png"},
                "4 channels"},
        Mistake{
            "normal_nan", {"normal", "nan.exr", "--from-height", "-o", "out.png"}, "not numbers"},
        Mistake{"normal_nothing", {"normal", "normal.png"}, "--out"},
        Mistake{"normal_blend",
                {"normal", "normal.png", "--blend", "other.png", "-o", "out.png"},
                "other.png"},
        Mistake{"normal_detect",
                {"normal", "normal.png", "--detect", "--height", "other.png"},
                "16 x 32"},
        Mistake{"bake_nan", {"bake", "--height", "nan.exr", "-o", "out_%d.png"}, "not numbers"},
        Mistake{"bake_sizes",
                {"bake", "--height", "height.png", "--roughness", "rough.png", "--metallic",
                 "other.png", "-o", "out_%d.png"},
                "16 x 32"},
        Mistake{"bake_reach",
                {"bake", "--height", "height.png", "--reach", "0.9", "-o", "out_%d.png"},
                "reach"},
        Mistake{"bake_folder", {"bake", "--height", "height.png", "-o", "file/out_%d.png"}, "file"},
        Mistake{"unpack_channels",
                {"unpack", "rough.png", "--preset", "unity-hdrp-mask", "-o", "out_%d.png"},
                "unity-hdrp-mask holds maps in the first 4"},
        Mistake{"unpack_pattern",
                {"unpack", "color.png", "--preset", "gltf-orm", "-o", "out.png"},
                "%d"},
        Mistake{"compare_sizes", {"compare", "rough.png", "other.png", "-o", "out.png"}, "16 x 32"},
        Mistake{"compare_fails",
                {"compare", "color.png", "zero.png", "--fail-psnr", "60"},
                "differ by more"},
        Mistake{"score_json", {"score", "--picture", "quick", "--json"}, "--csv"},
        Mistake{"inspect_text", {"inspect", "text.png", "rough.png"}, "text.png"},
        Mistake{"sheet_maps", {"inspect", "rough.png", "--sheet", "out.png"}, "--sheet and --film need"},
        Mistake{"film_kind", {"inspect", "normal.png", "rough.png", "--film", "out.gif"}, ".mp4"},
        Mistake{"generate_kind", {"generate", "cobbel", "-o", "made"}, "Did you mean \"cobble\"?"},
        Mistake{"generate_parameter", {"generate", "brick", "--set", "joints_m=0.01", "-o", "made"}, "Did you mean \"joint_m\"?"},
        Mistake{"generate_range", {"generate", "brick", "--set", "joint_m=1", "-o", "made"}, "0.002 to 0.025"},
        Mistake{"generate_number", {"generate", "brick", "--set", "joint_m=wide", "-o", "made"}, "NAME=NUMBER"},
        Mistake{"generate_color", {"generate", "brick", "--color", "#12345", "-o", "made"}, "#rrggbb"},
        Mistake{"generate_preset", {"generate", "bad.toml", "-o", "made"}, "bad.toml"},
        Mistake{"generate_twice", {"generate", "brick", "brick", "-o", "made"}, "two materials"},
        Mistake{"generate_ripple_set", {"generate", "ripple", "--set", "tile_m=1", "-o", "made"}, "has no parameters"},
        Mistake{"generate_none", {"generate", "-o", "made"}, "no material was named"},
        Mistake{"generate_size", {"generate", "cobble", "--size", "4", "-o", "made"}, "--size"}),
    [](const auto& test) { return test.param.name; });

TEST(TextureTools, AFullDiskLeavesTheOldFile)
{
    const Workplace place("texture_full");
    write_maps(place);
    write_file(place / "out.dds", "old");
    // 32 x 32 x 2 bytes are read, four times that cannot be written.
    const Outcome outcome = run_petrichor(
        {.arguments = {"texture", "pack", "--preset", "gltf-orm", "--roughness", "height.png",
                       "--occlusion", "height.png", "--metallic", "height.png", "-o", "out.dds"},
         .file_limit_bytes = 3500},
        place.path());
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("cannot write"));
    EXPECT_EQ(read_file(place / "out.dds"), "old");
}

TEST(TextureTools, AWordThatIsNoCommandIsNamed)
{
    const Workplace place("texture_words");
    for (const auto& [word, said] : {std::pair{"prepare", "no command \"prepare\""}, {"biuld", "Did you mean \"build\"?"}}) {
        const Outcome outcome = run({"texture", word, "x.png"}, place);
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_THAT(outcome.err, HasSubstr(said));
        EXPECT_THAT(outcome.err, HasSubstr("prefilter"));
    }
    EXPECT_THAT(run({"texture"}, place).err, HasSubstr("a command is missing"));
    EXPECT_THAT(run({"texture", "mips", "a.png", "-o", "b_%d.png", "more"}, place).err, HasSubstr("not expected: more"));
}

// Every damaged and every awkward file of the shared data in one command:
//   petrichor texture inspect $(find bad formats -type f)
TEST(TextureTools, InspectSurvivesEveryBadFile)
{
    NEED_ASSETS(assets);
    const Workplace place("texture_bad_files");
    std::vector<std::string> command{"texture", "inspect"};
    for (const char* folder : {"bad", "formats"}) {
        for (const auto& entry : fs::recursive_directory_iterator(assets / folder)) {
            const bool scene = entry.path().string().find("/gltf") != std::string::npos;
            if (entry.is_regular_file() && !scene) command.push_back(entry.path().string());
        }
    }
    ASSERT_GT(command.size(), 300u);
    const Outcome outcome = run(command, place);
    EXPECT_EQ(outcome.exit_code, 2) << "some are damaged";
    std::size_t pictures = 0, errors = 0;
    for (std::size_t i = 2; i < command.size(); ++i) {
        const bool shown = outcome.out.find(command[i] + ": ") != std::string::npos;
        const bool refused = outcome.err.find(command[i]) != std::string::npos;
        EXPECT_NE(shown, refused) << command[i];
        pictures += shown;
        errors += refused;
    }
    EXPECT_GE(pictures, 170u);
    EXPECT_GE(errors, 120u);
    struct rusage usage {};
    ASSERT_EQ(getrusage(RUSAGE_CHILDREN, &usage), 0);
#ifndef PETRICHOR_SANITIZED  // which keeps freed memory for a while
    EXPECT_LT(usage.ru_maxrss, 2l * 1024 * 1024) << "KiB";
#endif
    std::printf("%zu files: %zu pictures, %zu errors, at most %ld MiB\n", command.size() - 2,
                pictures, errors, usage.ru_maxrss / 1024);
}

}  // namespace
}  // namespace petrichor::cli
