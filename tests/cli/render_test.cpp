// Whole renders of a tiny scene: determinism, resuming, Ctrl-C, a full disk.
#include "tests/support/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "cli/rooms.h"
#include "film/frames/frames_jsonl.h"
#include "gpu/renderer.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using namespace testing_program;

constexpr const char* kScenario = R"(
[scene]
file = "scene.glb"
[sun]
elevation_degrees = [[0, 40], [6, 10]]
[weather]
keys = [{ time_s = 0, temperature_c = 10, rainfall = 1.0 }, { time_s = 6, temperature_c = -10 }]
[output]
width = 48
height = 27
samples = 2
frames = 6
[materials."stone"]
porosity = 0.7
)";

// Every file of a folder with its bytes.
std::map<std::string, std::string> contents(const fs::path& folder)
{
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        files[entry.path().filename().string()] = read_file(entry.path());
    }
    return files;
}

class Render : public testing::Test {
protected:
    Render()
        : place_(std::string("render") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())
    {
        write_file(place_ / "scene.glb", tiny_scene_glb());
        write_file(place_ / "s.toml", kScenario);
    }
    void SetUp() override
    {
        for (const gpu::DeviceInfo& device : gpu::list_devices()) {
            if (device.usable) return;
        }
        const char* required = std::getenv("PETRICHOR_REQUIRE_GPU");
        if (required && std::string(required) == "1") FAIL() << "no usable Vulkan device";
        GTEST_SKIP() << "no usable Vulkan device";
    }
    Outcome render(std::vector<std::string> more, const std::vector<std::string>& environment = {})
    {
        more.insert(more.begin(), {"render", "s.toml"});
        return run_petrichor({.arguments = more, .environment = environment}, place_.path());
    }
    Workplace place_;
};

// One run is compared with: a frame alone, one thread, a resumed run, a run in two parts.
TEST_F(Render, AFrameIsTheSameHoweverItIsReached)
{
    const Outcome whole = render({"-o", "whole", "--threads", "2"});
    ASSERT_EQ(whole.exit_code, 0) << whole.err;
    EXPECT_EQ(whole.out, "");
    const auto files = contents(place_ / "whole");
    EXPECT_EQ(
        files.count("frame_0005.exr") + files.count("frame_0005.png") + files.count("frames.jsonl"),
        3u);
    for (const auto& [name, bytes] : files) EXPECT_NE(name[0], '.') << name << " was left behind";
    EXPECT_NE(files.at("frame_0000.png"), files.at("frame_0005.png"));

    ASSERT_EQ(render({"-o", "alone", "--frames", "3", "--threads", "1"}).exit_code, 0);
    const auto alone = contents(place_ / "alone");
    EXPECT_EQ(alone.size(), 3u);
    EXPECT_TRUE(alone.at("frame_0003.exr") == files.at("frame_0003.exr"));
    EXPECT_TRUE(alone.at("frame_0003.png") == files.at("frame_0003.png"));
    EXPECT_THAT(files.at("frames.jsonl"), HasSubstr(alone.at("frames.jsonl"))) << "the same line";

    // The rest in a second command; what is there is kept, and the end is the same, film included.
    const auto kept_since = fs::last_write_time(place_ / "alone/frame_0003.exr");
    const Outcome rest = render({"-o", "alone", "--resume"});
    ASSERT_EQ(rest.exit_code, 0) << rest.err;
    EXPECT_THAT(rest.err, HasSubstr("5 frames rendered, 1 kept"));
    EXPECT_EQ(fs::last_write_time(place_ / "alone/frame_0003.exr"), kept_since);
    EXPECT_TRUE(contents(place_ / "alone") == files);
}

TEST_F(Render, ResumeRedoesWhatIsDamagedOrOtherwiseMade)
{
    ASSERT_EQ(render({"-o", "out", "--frames", "0:2"}).exit_code, 0);
    const auto before = contents(place_ / "out");
    write_file(place_ / "out/frame_0000.exr", before.at("frame_0000.exr").substr(0, 100));
    fs::remove(place_ / "out/frame_0001.png");
    const Outcome mended = render({"-o", "out", "--frames", "0:2", "--resume"});
    EXPECT_THAT(mended.err, HasSubstr("2 frames rendered, 1 kept"));
    EXPECT_TRUE(contents(place_ / "out") == before);
    // Another sample pattern is another picture.
    const Outcome other = render({"-o", "out", "--frames", "1:1", "--resume", "--seed", "9"});
    EXPECT_THAT(other.err, HasSubstr("1 frames rendered"));
    const auto records = read_frame_records(place_ / "out");
    ASSERT_EQ(records.size(), 3u);
    EXPECT_NE(records.at(1).settings, records.at(0).settings);
    for (const auto& [frame, record] : records)
        EXPECT_EQ(wrong_with_files(record, place_ / "out"), "");
}

// A change that keeps the size: sizes alone would keep the damaged frame.
TEST_F(Render, ResumeComparesHashesAndVerifyReadsPixels)
{
    ASSERT_EQ(render({"-o", "out", "--frames", "0:1"}).exit_code, 0);
    const auto before = contents(place_ / "out");
    std::string damaged = before.at("frame_0000.png");
    damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 1);
    write_file(place_ / "out/frame_0000.png", damaged);
    const Outcome mended = render({"-o", "out", "--frames", "0:1", "--resume"});
    EXPECT_THAT(mended.err, HasSubstr("1 frames rendered, 1 kept"));
    EXPECT_THAT(mended.err, HasSubstr("frame 0 is rendered again: frame_0000.png is not the file"));
    EXPECT_TRUE(contents(place_ / "out") == before);
    const Outcome verified = render({"-o", "out", "--frames", "0:1", "--verify"});
    EXPECT_THAT(verified.err, HasSubstr("0 frames rendered, 2 kept"));
}

TEST_F(Render, AFilmIsMadeInFoldersOfAnyName)
{
    for (const char* folder : {"100%d", "a:b", "-x", "it's \"so\""}) {
        const Outcome outcome =
            render({"--output=" + std::string(folder), "--count", "2", "--no-exr"});
        ASSERT_EQ(outcome.exit_code, 0) << folder << ": " << outcome.err;
        if (outcome.err.find("ffmpeg is not installed") != std::string::npos)
            GTEST_SKIP() << "ffmpeg is not installed";
        EXPECT_GT(fs::file_size(place_ / folder / "film.mp4"), 500u) << folder;
    }
}

TEST_F(Render, WhatAKilledRunLeftIsRemovedAndNothingElse)
{
    fs::create_directories(place_ / "out");
    write_file(place_ / "out/.petrichor-0123456789abcdef.png", "half a frame");
    write_file(place_ / "out/.petrichor-mine", "somebody's");
    ASSERT_EQ(render({"-o", "out", "--frames", "0:0"}).exit_code, 0);
    EXPECT_FALSE(fs::exists(place_ / "out/.petrichor-0123456789abcdef.png"));
    EXPECT_TRUE(fs::exists(place_ / "out/.petrichor-mine"));
}

TEST_F(Render, ASceneOverItsMemoryBudgetSaysWhatToLower)
{
    const Outcome outcome = render({"-o", "out", "--size", "2048x2048", "--memory", "64"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("the budget is 64 MiB"));
    EXPECT_FALSE(fs::exists(place_ / "out/frame_0000.png"));
}

TEST_F(Render, CtrlCKeepsWholeFramesAndSaysHowToGoOn)
{
    const Outcome stopped =
        run_petrichor({.arguments = {"render", "s.toml", "-o", "out", "--count", "500"},
                       .interrupt_when = place_ / "out/frame_0001.png"},
                      place_.path());
    EXPECT_EQ(stopped.exit_code, 130) << stopped.err;
    // Where the frame at hand took longer than a stop may, the words are shorter.
    EXPECT_THAT(stopped.err, testing::AnyOf(HasSubstr("of 500 frames are in out"),
                                            HasSubstr("what was finished is kept")));
    EXPECT_THAT(stopped.err, HasSubstr("petrichor render s.toml -o out --count 500 --resume"));
    const auto records = read_frame_records(place_ / "out");
    EXPECT_GE(records.size(), 2u);
    EXPECT_LT(records.size(), 500u);
    std::size_t files = 1;  // frames.jsonl
    for (const auto& [frame, record] : records) {
        EXPECT_EQ(wrong_with_files(record, place_ / "out"), "") << frame;
        files += record.files.size();
    }
    const auto left = contents(place_ / "out");
    EXPECT_LE(left.size(), files + 2) << "what frames.jsonl names, and the frame it was about to";
    for (const auto& [name, bytes] : left) EXPECT_NE(name[0], '.') << name;
}

TEST_F(Render, AFullDiskIsAnErrorAndLeavesNothingHalfWritten)
{
    const Outcome outcome =
        run_petrichor({.arguments = {"render", "s.toml", "-o", "out", "--size", "320x180"},
                       // the driver's own cache would run into the limit too
                       .environment = {"MESA_SHADER_CACHE_DISABLE=true"},
                       .file_limit_bytes = 20000},
                      place_.path());
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("frame_0000"));
    for (const auto& [name, bytes] : contents(place_ / "out"))
        ADD_FAILURE() << name << " was left behind";
}

TEST_F(Render, ASceneNeedsNoScenario)
{
    const Outcome outcome =
        run_petrichor({.arguments = {"render", "scene.glb", "-o", "out", "--size", "33x17",
                                     "--count", "3", "--samples", "1", "--no-exr"}},
                      place_.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto files = contents(place_ / "out");
    EXPECT_EQ(files.count("frame_0002.png"), 1u);
    EXPECT_EQ(files.count("frame_0002.exr"), 0u);
}

TEST_F(Render, BenchReportsAndKeepsThePicture)
{
    const Outcome outcome =
        run_petrichor({.arguments = {"bench", "--scene", "scene.glb", "--size", "64x36", "--repeat",
                                     "3", "--json", "--png", "timed.png"}},
                      place_.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const char* name :
         {"\"cpu_ms_per_frame\"", "\"wall_ms_per_frame\"", "\"peak_memory_mib\"", "\"lighting\""}) {
        EXPECT_THAT(outcome.out, HasSubstr(name));
    }
    EXPECT_GT(fs::file_size(place_ / "timed.png"), 100u);
}

}  // namespace
}  // namespace petrichor::cli
