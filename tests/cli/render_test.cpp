// Whole renders of a tiny scene: determinism, resuming, Ctrl-C, a full disk.
#include "tests/support/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "cli/rooms.h"
#include "film/frames/frames_jsonl.h"
#include "tests/support/device.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using namespace testing_program;

constexpr const char* kScenario = R"(
[scene]
file = "scene.glb"
ground = "none"
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
        (void)testing_device::device_is_there();
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

TEST_F(Render, FramesInFlightHaveTheSameBytesAndAreWrittenInOrder)
{
    const Outcome one = render({"-o", "one", "--frames-in-flight", "1"});
    ASSERT_EQ(one.exit_code, 0) << one.err;
    const Outcome three = render({"-o", "three", "--frames-in-flight", "3"});
    ASSERT_EQ(three.exit_code, 0) << three.err;
    EXPECT_THAT(three.err, HasSubstr("3 at a time"));
    EXPECT_TRUE(contents(place_ / "one") == contents(place_ / "three"));
    // No room for a second renderer: fewer, which is said.
    const Outcome tight =
        render({"-o", "tight", "--frames-in-flight", "3", "--memory", "100", "--frames", "0:2"});
    ASSERT_EQ(tight.exit_code, 0) << tight.err;
    EXPECT_THAT(tight.err, HasSubstr("1 instead of 3"));
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
    EXPECT_NE(records.at({1}).made_from, records.at({0}).made_from);
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

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

// The files of a folder are whole, and are those that frames.jsonl names.
void expect_what_is_named(const fs::path& folder)
{
    std::set<std::string> named = {"frames.jsonl"};
    for (const auto& [job, record] : read_frame_records(folder)) {
        EXPECT_EQ(wrong_with_files(record, folder), "") << job.frame;
        for (const auto& [name, mark] : record.files) named.insert(name);
    }
    std::set<std::string> there;
    for (const auto& [name, bytes] : contents(folder)) there.insert(name);
    EXPECT_EQ(there, named);
}

// A stop that comes late for a reason of the machine (a disk that stalls) is not late twice.
Outcome stopped_in_time(const Run& run, const fs::path& folder, const fs::path& output)
{
    Outcome outcome = run_petrichor(run, folder);
    if (outcome.stopping_s < 0.5 + outcome.machine_late_s) return outcome;
    fs::remove_all(output);
    return run_petrichor(run, folder);
}

TEST_F(Render, CtrlCKeepsWholeFramesAndSaysHowToGoOn)
{
    const Outcome stopped =
        stopped_in_time({.arguments = {"render", "s.toml", "-o", "out", "--count", "500"},
                         .interrupt_when = place_ / "out/frame_0001.png"},
                        place_.path(), place_ / "out");
    EXPECT_EQ(stopped.exit_code, 130) << stopped.err;
    const auto records = read_frame_records(place_ / "out");
    EXPECT_GE(records.size(), 2u);
    EXPECT_LT(records.size(), 500u);
    EXPECT_THAT(stopped.err,
                HasSubstr(std::to_string(records.size()) + " of 500 frames are in out"));
    EXPECT_THAT(stopped.err, HasSubstr("petrichor render s.toml -o out --count 500 --resume"));
    EXPECT_LT(stopped.stopping_s, 0.5 + stopped.machine_late_s);
    expect_what_is_named(place_ / "out");
}

// Frames that take long, so that the stop comes while one is rendered, encoded or written.
TEST_F(Render, AStopAtAnyMomentTakesHalfASecondAndLeavesOnlyWholeFrames)
{
    for (const double after_s : {0.05, 0.2, 0.5, 0.9, 1.4, 2.0, 2.7}) {
        fs::remove_all(place_ / "out");
        const Outcome stopped = stopped_in_time(
            {.arguments = {"render", "s.toml", "-o", "out", "--count", "500", "--size", "640x360",
                           "--samples", "16", "--aov", "depth,normal"},
             .interrupt_after_s = after_s,
             .signal = after_s < 1.0 ? SIGINT : SIGTERM},
            place_.path(), place_ / "out");
        const auto was = testing::Message() << "after " << after_s << " s: " << stopped.err;
        SCOPED_TRACE(was);
        // Before it watches for it, at the very start, the signal ends it.
        EXPECT_THAT(stopped.exit_code, testing::AnyOf(130, 128 + SIGINT));
        EXPECT_LT(stopped.stopping_s, 0.5 + stopped.machine_late_s);
        if (!fs::exists(place_ / "out")) continue;
        if (contents(place_ / "out").empty()) continue;
        expect_what_is_named(place_ / "out");
    }
}

// Dead ones may stay listed as zombies where nobody collects them.
bool lives(const fs::path& pid_file)
{
    const std::string pid = replaced(read_file(pid_file), "\n", "");
    for (int i = 0; i < 100; ++i) {
        const std::string stat = read_file("/proc/" + pid + "/stat");
        const std::size_t state = stat.rfind(") ");
        if (state == stat.npos || stat.at(state + 2) == 'Z') return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return true;
}

// An ffmpeg that never ends, in front of the real one.
TEST_F(Render, FfmpegEndsWithTheProgram)
{
    fs::create_directories(place_ / "bin");
    const std::string pid = (place_ / "pid").string();
    write_file(place_ / "bin/ffmpeg", "#!/bin/sh\necho $$ > " + pid + ".new\nmv " + pid + ".new " +
                                          pid + "\nexec sleep 600\n");
    fs::permissions(place_ / "bin/ffmpeg", fs::perms::owner_all);
    const char* path = std::getenv("PATH");
    for (const int signal : {SIGINT, SIGKILL}) {
        fs::remove(place_ / "pid");
        const Outcome stopped = run_petrichor(
            {.arguments = {"render", "s.toml", "-o", "out", "--count", "2"},
             .environment = {"PATH=" + (place_ / "bin").string() + ":" + (path ? path : "")},
             .interrupt_when = place_ / "pid",
             .signal = signal},
            place_.path());
        EXPECT_EQ(stopped.exit_code, signal == SIGINT ? 130 : 128 + SIGKILL) << stopped.err;
        EXPECT_LT(stopped.stopping_s, 0.5 + stopped.machine_late_s);
        EXPECT_FALSE(lives(place_ / "pid"));
        if (signal == SIGINT) expect_what_is_named(place_ / "out");
        fs::remove_all(place_ / "out");
    }
}

// What decides a picture, changed behind the scenario's back; --resume has a word for each.
TEST_F(Render, ResumeSaysWhatChanged)
{
    const std::string shader =
        replaced(read_file(fs::path(PETRICHOR_SOURCE_DIR) / "data/shaders/minnaert.glsl"),
                 "minnaert", "own");
    const std::string weather =
        "time,air_temp_c,precip_mm,wind_m_s\n2020-01-01T00:00,3,1,2\n2020-01-01T01:00,3,1,2\n";
    const std::string scenario = R"([scene]
file = "scene.glb"
ground = "none"
[weather]
file = "w.csv"
latitude_degrees = 50
longitude_degrees = 8
[output]
width = 48
height = 27
samples = 1
frames = 1
film = false
[materials."stone"]
lighting_model = "own.glsl"
)";
    const std::string scene = tiny_scene_glb();
    write_file(place_ / "own.glsl", shader);
    write_file(place_ / "w.csv", weather);
    write_file(place_ / "s.toml", scenario);
    const Outcome first = render({"-o", "out"});
    ASSERT_EQ(first.exit_code, 0) << first.err;
    EXPECT_THAT(render({"-o", "out", "--resume"}).err, HasSubstr("0 frames rendered, 1 kept"));
    const struct {
        const char *file, *word;
        std::string text;
    } changes[] = {
        {"own.glsl", "lighting models changed", replaced(shader, "1.5", "1.6")},
        {"w.csv", "weather changed", replaced(weather, ",3,", ",-3,")},
        {"scene.glb", "scene files changed", replaced(scene, "court", "yards")},
        {"s.toml", "output settings changed", replaced(scenario, "samples = 1", "samples = 2")},
    };
    for (const auto& change : changes) {
        write_file(place_ / change.file, change.text);
        const Outcome again = render({"-o", "out", "--resume"});
        EXPECT_THAT(again.err, HasSubstr(std::string("frame 0 is rendered again: ") + change.word))
            << change.file;
        EXPECT_THAT(render({"-o", "out", "--resume"}).err, HasSubstr("0 frames rendered, 1 kept"));
    }
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
    EXPECT_THAT(outcome.err, HasSubstr("out/frame_0000"));
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

// Two variants from two views: names, records, resume and shards go by job.
TEST_F(Render, VariantsAndViewsAreJobs)
{
    write_file(place_ / "s.toml",
               std::string(kScenario) +
                   "[[variant]]\nname = \"wet\"\n[[variant]]\nname = \"snow\"\n"
                   "[variant.weather]\npreset = \"first-snow\"\n"
                   "[[view]]\nname = \"near\"\n[view.camera]\nposition_m = [1, 1, 2]\n"
                   "look_at_m = [0, 0, 0]\n"
                   "[[view]]\nname = \"far\"\n[view.camera]\nposition_m = [2, 2, 4]\n"
                   "look_at_m = [0, 0, 0]\n");
    const Outcome whole = render({"-o", "whole", "--count", "2"});
    ASSERT_EQ(whole.exit_code, 0) << whole.err;
    EXPECT_THAT(whole.err, HasSubstr("8 frames rendered"));
    const auto files = contents(place_ / "whole");
    for (const char* name : {"frame_0000_wet_near.exr", "frame_0001_snow_far.png"})
        EXPECT_EQ(files.count(name), 1u) << name;
    EXPECT_NE(files.at("frame_0001_wet_far.png"), files.at("frame_0001_wet_near.png"));
    EXPECT_NE(files.at("frame_0001_wet_far.png"), files.at("frame_0001_snow_far.png"));
    const auto records = read_frame_records(place_ / "whole");
    EXPECT_EQ(records.size(), 8u);
    EXPECT_EQ(records.count({1, "snow", "far"}), 1u);

    for (const char* shard : {"3/3", "1/3", "2/3"})
        ASSERT_EQ(render({"-o", "parts", "--count", "2", "--shard", shard}).exit_code, 0);
    EXPECT_TRUE(contents(place_ / "parts") == files);
    const Outcome again = render({"-o", "parts", "--count", "2", "--resume"});
    EXPECT_THAT(again.err, HasSubstr("0 frames rendered, 8 kept"));
    const Outcome one = render(
        {"-o", "one", "--frames", "1", "--count", "2", "--variants", "snow", "--views", "far"});
    ASSERT_EQ(one.exit_code, 0) << one.err;
    EXPECT_TRUE(contents(place_ / "one").at("frame_0001_snow_far.exr") ==
                files.at("frame_0001_snow_far.exr"));
    EXPECT_EQ(render({"-o", "no", "--variants", "dry"}).exit_code, 2);
}

TEST_F(Render, AScenarioOfOursIsFoundBesideAFolderOfItsName)
{
    fs::create_directory(place_ / "demo");
    const Outcome outcome =
        run_petrichor({.arguments = {"render", "demo", "--frames", "99"}}, place_.path());
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("the sequence has frames 0 to 47"));
}

TEST_F(Render, BenchTimesAFrameOfAScenario)
{
    const Outcome outcome =
        run_petrichor({.arguments = {"bench", "s.toml", "--frame", "3", "--repeat", "1", "--json"}},
                      place_.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const char* text : {"\"scenario\": \"s.toml\"", "\"frame\": 3", "\"width\": 48",
                             "\"samples\": 2", "\"ripple\""}) {
        EXPECT_THAT(outcome.out, HasSubstr(text));
    }
    EXPECT_EQ(
        run_petrichor({.arguments = {"bench", "s.toml", "--frame", "6"}}, place_.path()).exit_code,
        2);
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

// Passes one by one are the same picture, and the CPU time of each is known: of all no more than the frame's.
TEST_F(Render, BenchTellsTheCpuTimeOfEachPass)
{
    const auto bench = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"bench", "s.toml", "--repeat", "1", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_petrichor({.arguments = std::move(arguments)}, place_.path());
    };
    const Outcome together = bench({"--png", "together.png"});
    const Outcome apart = bench({"--png", "apart.png", "--apart"});
    ASSERT_EQ(together.exit_code, 0) << together.err;
    ASSERT_EQ(apart.exit_code, 0) << apart.err;
    EXPECT_THAT(together.out, Not(HasSubstr("\"cpu_ms\"")));
    EXPECT_EQ(read_file(place_ / "apart.png"), read_file(place_ / "together.png"));
    const auto report = nlohmann::json::parse(apart.out);
    double all_ms = 0.0;
    for (const auto& pass : report["passes"]) all_ms += pass["cpu_ms"].get<double>();
    EXPECT_GT(all_ms, 0.0);
    EXPECT_LE(all_ms, report["cpu_ms_per_frame"].get<double>());
}

// What is timed is what `render` draws: snow has its body. In a film it is laid anew for each frame, for the same picture.
TEST_F(Render, BenchDrawsTheSnowOfItsFrame)
{
    const std::string snow =
        "[scene]\nfile = \"scene.glb\"\n[weather]\npreset = \"first-snow\"\n[output]\nwidth = 96\nheight = 54\n"
        "samples = 1\nframes = 6\nfps = 0.15\n";
    write_file(place_ / "snow.toml", snow);
    write_file(place_ / "flat.toml", snow + "[render]\nsnow_body = false\n");
    const auto picture = [&](const char* scenario, const char* name, std::vector<std::string> more) {
        std::vector<std::string> arguments{"bench", scenario, "--frame", "5", "--repeat", "1", "--png", name};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run_petrichor({.arguments = std::move(arguments)}, place_.path());
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return read_file(place_ / name);
    };
    const std::string still = picture("snow.toml", "still.png", {});
    EXPECT_NE(still, picture("flat.toml", "flat.png", {}));
    EXPECT_EQ(still, picture("snow.toml", "film.png", {"--film"}));
}

}  // namespace
}  // namespace petrichor::cli
