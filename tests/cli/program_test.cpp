// The program from outside, where no GPU is needed: exit codes and messages.
#include "tests/support/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace petrichor::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using namespace testing_program;

TEST(Program, HelpAndVersionSucceedOnStdout)
{
    const Workplace place("help");
    for (const auto& arguments :
         std::vector<std::vector<std::string>>{{"--help"},
                                               {"--version"},
                                               {"render", "--help"},
                                               {"bench", "--help"},
                                               {"bench", "weather", "--help"},
                                               {"doctor", "--help"},
                                               {"headers", "--help"},
                                               {"init", "--help"}}) {
        const Outcome outcome = run(arguments, place);
        EXPECT_EQ(outcome.exit_code, 0) << arguments[0];
        EXPECT_THAT(outcome.out, Not(IsEmpty())) << arguments[0];
        EXPECT_THAT(outcome.err, IsEmpty()) << arguments[0];
        if (arguments.size() > 1) {
            EXPECT_THAT(outcome.out, HasSubstr("Example")) << arguments[0];
        }
    }
}

struct Mistake {
    const char* name;
    std::vector<std::string> arguments;
    const char* message;
};
void PrintTo(const Mistake& mistake, std::ostream* out)
{
    *out << mistake.name;
}

class ProgramMistake : public testing::TestWithParam<Mistake> {};
TEST_P(ProgramMistake, ExitsWithTwoAndSaysWhat)
{
    const Workplace place(GetParam().name);
    write_file(place / "scene.glb", tiny_scene_glb());
    write_file(place / "truncated.glb", tiny_scene_glb().substr(0, 700));
    write_file(place / "misspelt.toml", "[scene]\nfile = \"scene.glb\"\n[output]\nwidht = 64\n");
    write_file(place / "zero.toml", "[scene]\nfile = \"scene.glb\"\n[output]\nwidth = 0\n");
    write_file(place / "gone.toml", "[scene]\nfile = \"gone.glb\"\n");
    write_file(place / "preset.toml",
               "[scene]\nfile = \"scene.glb\"\n[weather]\npreset = \"stomr\"\n");
    write_file(
        place / "weather.toml",
        "[scene]\nfile = \"scene.glb\"\n[weather]\nkeys = [\n{ time_s = 0, temperatur_c = 1 }]\n");
    write_file(
        place / "texture.gltf",
        R"({"asset":{"version":"2.0"},"images":[{"uri":"gone.png"}],"textures":[{"source":0}],)"
        R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}]})");
    write_file(place / "file", "x");
    const Outcome outcome = run(GetParam().arguments, place);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(GetParam().message));
    EXPECT_THAT(outcome.err, HasSubstr("\n  ")) << "says what to do";
    EXPECT_THAT(outcome.out, IsEmpty());
}
INSTANTIATE_TEST_SUITE_P(
    Table, ProgramMistake,
    testing::Values(
        Mistake{"command", {"rendr"}, "Did you mean \"render\"?"},
        Mistake{"option", {"render", "--framse", "1"}, "Did you mean \"--frames\"?"},
        Mistake{"option_of_a_command", {"texture", "mips", "a.png", "--flter=box"}, "Did you mean \"--filter\"?"},
        Mistake{"folder", {"render", "."}, "is a folder"}, Mistake{"no_command", {}, "subcommand"},
        Mistake{"size_zero", {"render", "scene.glb", "--size", "0x0"}, "0x0"},
        Mistake{"size_words", {"render", "scene.glb", "--size", "large"}, "WIDTHxHEIGHT"},
        Mistake{"size_large", {"render", "scene.glb", "--size", "99999x10"}, "99999x10"},
        Mistake{
            "size_overflow", {"render", "scene.glb", "--size", "99999999999x10"}, "WIDTHxHEIGHT"},
        Mistake{
            "size_memory", {"render", "scene.glb", "--size", "16384x16385"}, "1 to 16384"},
        Mistake{"tile", {"render", "scene.glb", "--tile", "100"}, "in steps of 32"},
        Mistake{"frames", {"render", "scene.glb", "--frames", "9:3"}, "FIRST:LAST"},
        Mistake{"frames_outside", {"render", "scene.glb", "--frames", "40:60"}, "frames 0 to 47"},
        Mistake{"samples", {"render", "scene.glb", "--samples", "0"}, "samples"},
        Mistake{"nothing_to_write",
                {"render", "scene.glb", "--no-exr", "--no-png"},
                "nothing would be written"},
        Mistake{"aov", {"render", "scene.glb", "--aov", "wettness"}, "no AOV \"wettness\""},
        Mistake{"input", {"render", "dem"}, "Did you mean \"demo\"?"},
        Mistake{"missing_scene", {"render", "gone.glb"}, "gone.glb"},
        Mistake{"missing_scene_of_scenario", {"render", "gone.toml"}, "gone.glb"},
        Mistake{"missing_scenario", {"render", "none.toml"}, "none.toml"},
        Mistake{"missing_texture", {"render", "texture.gltf"}, "gone.png"},
        Mistake{"truncated", {"render", "truncated.glb"}, "truncated.glb"},
        Mistake{"misspelt_key", {"render", "misspelt.toml"}, "Did you mean \"width\"?"},
        Mistake{"zero_width_key", {"render", "zero.toml"}, "zero.toml:4"},
        Mistake{"weather_option",
                {"render", "scene.glb", "-w", "no-such"},
                "neither a preset nor a file"},
        Mistake{"weather_preset", {"render", "preset.toml"}, "stomr"},
        Mistake{"weather_key", {"render", "weather.toml"}, "Did you mean \"temperature_c\"?"},
        Mistake{"folder_is_a_file",
                {"render", "scene.glb", "-o", "file"},
                "cannot write into the folder"},
        Mistake{"folder_below_a_file",
                {"render", "scene.glb", "-o", "file/x"},
                "cannot write into the folder"},
        Mistake{"init_no_name", {"init"}, "a name is missing"},
        Mistake{"init_exists", {"init", "zero"}, "exists already"},
        Mistake{"bench_no_scene", {"bench"}, "--scene"},
        Mistake{"bench_zero", {"bench", "--scene", "scene.glb", "--size", "0x1"}, "0x1"}),
    [](const auto& test) { return test.param.name; });

TEST(Program, WithoutAVulkanDriverItSaysSo)
{
    const Workplace place("novulkan");
    write_file(place / "scene.glb", tiny_scene_glb());
    const std::vector<std::string> none{"VK_ICD_FILENAMES=/nonexistent",
                                        "VK_DRIVER_FILES=/nonexistent"};
    const Outcome render = run_petrichor(
        {.arguments = {"render", "scene.glb", "-o", "out"}, .environment = none}, place.path());
    EXPECT_EQ(render.exit_code, 2) << render.err;
    EXPECT_THAT(render.err, HasSubstr("Vulkan"));
    EXPECT_FALSE(std::filesystem::exists(place / "out/frames.jsonl"));
    const Outcome doctor =
        run_petrichor({.arguments = {"doctor"}, .environment = none}, place.path());
    EXPECT_EQ(doctor.exit_code, 2);
    EXPECT_THAT(doctor.out, AllOf(HasSubstr("MISSING vulkan"), HasSubstr("mesa-vulkan-drivers")));
}

TEST(Program, InitWritesAScenarioThatIsAccepted)
{
    const Workplace place("init");
    const Outcome first = run({"init", "mine", "--scene", "gone.glb"}, place);
    EXPECT_EQ(first.exit_code, 0) << first.err;
    EXPECT_THAT(read_file(place / "mine.toml"), HasSubstr("file = \"gone.glb\""));
    // Everything in it is understood: what is missing is the scene.
    write_file(place / "w.toml",
               "[weather]\nkeys = [{ time_s = 0, temperature_c = 1, rainfall = 0 }]\n");
    const Outcome render = run({"render", "mine.toml", "--weather", "w.toml"}, place);
    EXPECT_EQ(render.exit_code, 2);
    EXPECT_THAT(render.err, HasSubstr("gone.glb"));
}

TEST(Program, InitWritesTheSchemaOfScenarios)
{
    const Workplace place("init_schema");
    const Outcome both = run({"init", "mine", "--schema"}, place);
    EXPECT_EQ(both.exit_code, 0) << both.err;
    EXPECT_THAT(read_file(place / "mine.toml"), StartsWith("#:schema petrichor.schema.json\n"));
    const std::string schema = read_file(place / "petrichor.schema.json");
    EXPECT_THAT(schema, HasSubstr("\"roughness_factor\""));
    write_file(place / "petrichor.schema.json", "old");
    EXPECT_EQ(run({"init", "--schema"}, place).exit_code, 0);
    EXPECT_EQ(read_file(place / "petrichor.schema.json"), schema);
}

// What the rival started ends too: it would have left a file two seconds later.
TEST(Program, InterruptedBenchEndsItsRivals)
{
    const Workplace place("rival");
    const Outcome outcome =
        run_petrichor({.arguments = {"bench", "weather", "--rival",
                                     "slow=(sleep 2; touch late) & touch started; wait"},
                       .interrupt_when = place / "started"},
                      place.path());
    EXPECT_EQ(outcome.exit_code, 128 + SIGINT);
    EXPECT_THAT(outcome.out, IsEmpty());
    std::this_thread::sleep_for(std::chrono::milliseconds(2500));
    EXPECT_FALSE(std::filesystem::exists(place / "late"));
}

TEST(Program, DoctorReportsAsJson)
{
    const Workplace place("doctor");
    const Outcome outcome = run({"doctor", "--json"}, place);
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("\"version\""), HasSubstr("\"devices\""),
                                   HasSubstr("\"can_render\"")));
    EXPECT_THAT(outcome.out, HasSubstr("\"demo\""))
        << "the data folder is found from the build tree";
}

}  // namespace
}  // namespace petrichor::cli
