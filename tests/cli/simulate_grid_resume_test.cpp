#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "tests/support/program.h"

// Grids that stop and go on, through the program.
namespace petrichor::cli {
namespace {

using namespace testing_program;

std::string hill_asc(double top_m = 1800.0)
{
    constexpr int kSide = 48;
    std::string text = "ncols 48\nnrows 48\nxllcorner 0\nyllcorner 0\ncellsize 100\n";
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const double from_top = std::hypot(x - 24.0, y - 24.0) / 34.0;
            text += std::to_string(1000.0 + (top_m - 1000.0) * (1.0 - from_top)) + " ";
        }
        text += "\n";
    }
    return text;
}

std::string two_months(double warmer_c = 0.0)
{
    std::string text = "time,air_temp_c,rel_humidity_pct,wind_m_s,precip_mm\n";
    for (int hour = 0; hour < 59 * 24; ++hour) {
        const int day = hour / 24;
        char line[100];
        std::snprintf(line, sizeof line, "2023-%02d-%02dT%02d:00Z,%.2f,80,2,%.1f\n",
                      day < 31 ? 1 : 2, 1 + day % 31, hour % 24,
                      warmer_c + 5.0 * std::sin(hour * 0.02) + 3.0 * std::sin(hour * 0.2618),
                      day % 4 == 0 ? 0.5 : 0.0);
        text += line;
    }
    return text;
}

// The words of every run here; more may follow.
std::vector<std::string> words(std::vector<std::string> more)
{
    std::vector<std::string> all = {"simulate",    "w.csv",    "--latitude",    "46",
                                    "--longitude", "8",        "--elevation-m", "1200",
                                    "--grid",      "hill.asc", "--hash"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

class GridResume : public testing::Test {
protected:
    GridResume()
    {
        write_file(work / "hill.asc", hill_asc());
        write_file(work / "w.csv", two_months());
    }
    Outcome run(const std::vector<std::string>& more, const std::string& interrupt_when = {})
    {
        return run_petrichor(
            {.arguments = words(more),
             .interrupt_when = interrupt_when.empty() ? "" : work / interrupt_when},
            work.path());
    }
    Workplace work{"grid_resume"};
};

TEST_F(GridResume, GoesOnWithIdenticalBits)
{
    ASSERT_EQ(run({"-o", "whole.csv"}).exit_code, 0);
    // Stopped by --to in the middle of a row's interval, by other threads.
    ASSERT_EQ(
        run({"--to", "2023-01-20T07:00", "--checkpoint", "c", "-o", "first.csv", "--threads", "1"})
            .exit_code,
        0);
    const Outcome rest = run({"--resume", "c", "--checkpoint", "end", "-o", "rest.csv"});
    ASSERT_EQ(rest.exit_code, 0) << rest.err;
    EXPECT_NE(rest.err.find("resumed at 2023-01-20T07:00:00Z with 20 rows"), std::string::npos)
        << rest.err;
    EXPECT_EQ(read_file(work / "rest.csv"), read_file(work / "whole.csv"));
    // A finished run resumes to its last row.
    ASSERT_EQ(run({"--resume", "end", "-o", "again.csv"}).exit_code, 0);
    EXPECT_EQ(read_file(work / "again.csv"), read_file(work / "whole.csv"));
}

TEST_F(GridResume, AnInterruptLeavesAWholeCheckpointAndSaysHowToGoOn)
{
    ASSERT_EQ(run({"-o", "whole.csv"}).exit_code, 0);
    const std::vector<std::string> all = {"--checkpoint", "c",         "-o",   "out.csv",
                                          "--map",        "m.png",     "--at", "2023-01-02",
                                          "--at",         "2023-02-28"};
    const Outcome stopped = run(all, "m_20230102T0000.png");
    ASSERT_EQ(stopped.exit_code, 130) << stopped.err;
    EXPECT_NE(stopped.err.find("--resume c"), std::string::npos) << stopped.err;
    EXPECT_FALSE(std::filesystem::exists(work / "out.csv"));
    for (const auto& entry : std::filesystem::directory_iterator(work.path()))
        EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
    auto more = all;
    more.insert(more.end(), {"--resume", "c"});
    ASSERT_EQ(run(more).exit_code, 0);
    EXPECT_EQ(read_file(work / "out.csv"), read_file(work / "whole.csv"));
    EXPECT_TRUE(std::filesystem::exists(work / "m_20230228T0000.png"));
}

TEST_F(GridResume, WithoutACheckpointItSaysWhatToGive)
{
    const Outcome stopped =
        run({"-o", "out.csv", "--map", "m.png", "--at", "2023-01-02", "--at", "2023-02-28"},
            "m_20230102T0000.png");
    ASSERT_EQ(stopped.exit_code, 130) << stopped.err;
    EXPECT_NE(stopped.err.find("--checkpoint FILE"), std::string::npos) << stopped.err;
}

TEST_F(GridResume, CheckpointsOfOtherRunsAreRefused)
{
    ASSERT_EQ(run({"--to", "2023-01-10", "--checkpoint", "c", "-o", "a.csv"}).exit_code, 0);
    const auto refused = [&](const std::vector<std::string>& more, const char* why) {
        const Outcome outcome = run(more);
        EXPECT_EQ(outcome.exit_code, 2) << why << "\n" << outcome.err;
        EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
    };
    refused({"--resume", "c", "--phase", "humidity"}, "another --phase, --dt");
    refused({"--resume", "c", "--surface", "rock"}, "another terrain or other surfaces");
    refused({"--resume", "c", "--wind-height-m", "3"}, "other weather or another site");
    refused({"--resume", "c", "--every", "6h"}, "--every");
    refused({"--resume", "c", "--to", "2023-01-05"}, "after the last row");
    refused({"--resume", "w.csv"}, "no checkpoint of a grid");
    const std::string bytes = read_file(work / "c");
    write_file(work / "short", bytes.substr(0, bytes.size() / 2));
    refused({"--resume", "short"}, "cut short");
    write_file(work / "tail", bytes.substr(0, bytes.size() - 8));
    refused({"--resume", "tail"}, "cut short");
    std::string damaged = bytes;
    damaged[damaged.size() / 3] = static_cast<char>(damaged[damaged.size() / 3] ^ 1);
    write_file(work / "damaged", damaged);
    refused({"--resume", "damaged"}, "damaged");
    write_file(work / "hill.asc", hill_asc(1801.0));
    refused({"--resume", "c"}, "another terrain");
    write_file(work / "hill.asc", hill_asc());
    write_file(work / "w.csv", two_months(0.1));
    refused({"--resume", "c"}, "other weather");
    // And not by one cell, as one cell's not by a grid.
    const Outcome cell =
        run_petrichor({.arguments = {"simulate", "w.csv", "--resume", "c"}}, work.path());
    EXPECT_EQ(cell.exit_code, 2) << cell.err;
}

}  // namespace
}  // namespace petrichor::cli
