// The array script of data/slurm: its tasks make the pictures of one run, in an environment as
// Slurm sets it and, where Slurm is installed, on a cluster of this machine.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <map>
#include <string>

#include "tests/support/device.h"
#include "tests/support/program.h"

namespace petrichor::testing_program {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kScenario = R"(
[scene]
file = "scene.glb"
ground = "none"
[weather]
keys = [{ time_s = 0, temperature_c = 10, rainfall = 1.0 }, { time_s = 6, temperature_c = -10 }]
[output]
width = 48
height = 27
samples = 1
frames = 5
film = false
)";

std::map<std::string, std::string> contents(const fs::path& folder)
{
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder))
        files[entry.path().filename().string()] = read_file(entry.path());
    return files;
}

class Slurm : public testing::Test {
protected:
    Slurm()
        : place_(std::string("slurm") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())
    {
        write_file(place_ / "scene.glb", tiny_scene_glb());
        write_file(place_ / "s.toml", kScenario);
    }
    void SetUp() override { (void)testing_device::device_is_there(); }
    std::map<std::string, std::string> whole()
    {
        const Outcome outcome = run({"render", "s.toml", "-o", "whole"}, place_);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return contents(place_ / "whole");
    }
    // A line of the shell in the test's folder; what it says lies in "said".
    int shell(const std::string& line)
    {
        const std::string command = "cd '" + place_.path().string() +
                                    "' && env -u SLURM_ARRAY_TASK_ID -u SHARDS PETRICHOR='" +
                                    PETRICHOR_PROGRAM + "' " + line + " >said 2>&1";
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    std::string said() { return read_file(place_ / "said"); }
    static std::string task(int id, int least, int most, int count)
    {
        return "SLURM_ARRAY_TASK_ID=" + std::to_string(id) +
               " SLURM_ARRAY_TASK_MIN=" + std::to_string(least) +
               " SLURM_ARRAY_TASK_MAX=" + std::to_string(most) +
               " SLURM_ARRAY_TASK_COUNT=" + std::to_string(count) + " SLURM_CPUS_PER_TASK=1 ";
    }
    Workplace place_;
    const std::string script_ = "bash '" PETRICHOR_SOURCE_DIR "/data/slurm/render.sbatch' ";
};

TEST_F(Slurm, TasksOfAnArrayMakeThePicturesOfOneRun)
{
    for (const int id : {3, 1, 2})
        ASSERT_EQ(shell(task(id, 1, 3, 3) + script_ + "s.toml -o parts"), 0) << said();
    const auto files = whole();
    EXPECT_EQ(files.count("frame_0004.png"), 1u);
    EXPECT_TRUE(contents(place_ / "parts") == files);
    // One that is sent again alone knows of how many it is, and finds its pictures.
    ASSERT_EQ(shell("SHARDS=3 " + task(2, 2, 2, 1) + script_ + "s.toml -o parts"), 0) << said();
    EXPECT_THAT(said(), HasSubstr("0 frames rendered, "));
    fs::remove(place_ / "parts" / "frame_0004.png");
    for (const int id : {1, 2, 3})
        ASSERT_EQ(shell("SHARDS=3 " + task(id, 1, 3, 2) + script_ + "s.toml -o parts"), 0)
            << said();
    EXPECT_TRUE(contents(place_ / "parts") == files) << "what was lost is rendered again";
    // More tasks than pictures: the last have nothing to do.
    for (int id = 1; id <= 7; ++id)
        ASSERT_EQ(shell(task(id, 1, 7, 7) + script_ + "s.toml -o many"), 0) << id << said();
    EXPECT_TRUE(contents(place_ / "many") == files);
}

TEST_F(Slurm, ArraysThatDoNotSayTheirPartsAreRefused)
{
    EXPECT_EQ(shell(script_ + "s.toml"), 2);
    EXPECT_THAT(said(), HasSubstr("no array job"));
    for (const std::string& env :
         {task(0, 0, 2, 3), task(3, 3, 7, 2), task(3, 3, 3, 1), task(1, 1, 9, 5)}) {
        EXPECT_EQ(shell(env + script_ + "s.toml"), 2) << env;
        EXPECT_THAT(said(), HasSubstr("the array is not 1-N")) << env;
    }
    EXPECT_FALSE(fs::exists(place_ / "petrichor-s"));
    // Of the program itself: its words and its code.
    EXPECT_EQ(shell(task(1, 1, 2, 2) + script_ + "nowhere.toml"), 2);
    EXPECT_THAT(said(), HasSubstr("nowhere"));
}

TEST_F(Slurm, ARealClusterMakesThem)
{
    const int code = shell("'" PETRICHOR_SOURCE_DIR
                           "/tests/cli/slurm_cluster.sh' --array=1-3 --cpus-per-task=1 --mem=500M "
                           "'" PETRICHOR_SOURCE_DIR "/data/slurm/render.sbatch' s.toml -o parts");
    if (code == 77) GTEST_SKIP() << "no Slurm on this machine: " << said();
    std::string logs = said();
    for (const auto& entry : fs::directory_iterator(place_.path()))
        if (entry.path().extension() == ".log") logs += read_file(entry.path());
    ASSERT_EQ(code, 0) << logs;
    EXPECT_TRUE(contents(place_ / "parts") == whole()) << logs;
}

}  // namespace
}  // namespace petrichor::testing_program
