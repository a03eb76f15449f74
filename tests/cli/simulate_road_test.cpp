// A road station's own files through the program.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/support/program.h"

namespace petrichor::cli {
namespace {

using namespace testing_program;

// The files of a METRo case over a winter's morning: the road that was measured is `warmer_k`
// warmer at the end than it began to be.
void write_road_case(const Workplace& work, double warmer_k)
{
    write_file(work / "station.xml",
               "<station><header><coordinate><latitude>46</latitude><longitude>0</longitude>"
               "</coordinate><station-type>road</station-type></header><roadlayer-list><roadlayer>"
               "<type>asphalt</type><thickness>0.3</thickness></roadlayer></roadlayer-list>"
               "</station>");
    const auto hour = [](int h) {
        return "2006-03-1" + std::to_string(h / 24) + "T" + (h % 24 < 10 ? "0" : "") +
               std::to_string(h % 24) + ":00Z";
    };
    std::string seen = "<observation><measure-list>", forecast = "<forecast><prediction-list>";
    for (int h = 0; h <= 13; ++h)
        seen += "<measure><observation-time>" + hour(h) +
                "</observation-time><at>-4</at><td>-6</td>" + "<ws>7</ws><st>" +
                std::to_string(-5.0 + (h > 9 ? warmer_k * (h - 9) : 0.0)) +
                "</st><sst>-1</sst><pi>0</pi></measure>";
    for (int h = 12; h <= 22; ++h)
        forecast += "<prediction><forecast-time>" + hour(h) +
                    "</forecast-time><at>-3</at><td>-6</td>" +
                    "<ws>7</ws><ap>1010</ap><cc>2</cc><ra>0</ra><sn>0</sn></prediction>";
    write_file(work / "seen.xml", seen + "</measure-list></observation>");
    write_file(work / "forecast.xml", forecast + "</prediction-list></forecast>");
}

// What the measured road says is told and felt, and --coupling 0 leaves it out.
TEST(SimulateRoad, TheMeasuredRoadCorrectsTheRadiation)
{
    const Workplace work("road");
    const auto run = [&](std::vector<std::string> more) {
        std::vector<std::string> words{"simulate",        "forecast.xml", "--road", "station.xml",
                                       "--road-observed", "seen.xml",     "-o",     "out.csv"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome o = run_petrichor({words}, work.path());
        EXPECT_EQ(o.exit_code, 0) << o.err;
        return std::pair(o.err, read_file(work / "out.csv"));
    };
    write_road_case(work, 0.0);
    const auto [cold_says, cold] = run({});
    write_road_case(work, 1.5);
    const auto [warm_says, warm] = run({});
    const auto [off_says, off] = run({"--coupling", "0"});
    EXPECT_NE(cold_says.find("sunlight x 0."), std::string::npos) << cold_says;
    EXPECT_EQ(warm_says.find("exactly 0 C"), std::string::npos) << warm_says;
    std::string zero = read_file(work / "seen.xml");
    for (std::size_t at; (at = zero.find("<sst>-1<")) != std::string::npos;)
        zero.replace(at, 8, "<sst>.0<");
    write_file(work / "seen.xml", zero);
    EXPECT_NE(run({}).first.find("the temperature below the road is exactly 0 C in all 14 rows"),
              std::string::npos);
    write_road_case(work, 1.5);
    EXPECT_NE(warm_says.find("brings the modelled road to the measured one"), std::string::npos);
    EXPECT_EQ(off_says.find("brings the modelled road"), std::string::npos);
    EXPECT_NE(warm, off);
    EXPECT_EQ(run({"--coupling", "0", "--coupling-fade", "9"}).second, off);
    EXPECT_NE(run({"--coupling-fade", "9"}).second, warm);
    const Outcome alone =
        run_petrichor({{"simulate", "forecast.xml", "--coupling", "2"}}, work.path());
    EXPECT_EQ(alone.exit_code, 2);
    EXPECT_NE(alone.err.find("--road-observed"), std::string::npos) << alone.err;
    const Outcome bad = run_petrichor({{"simulate", "forecast.xml", "--road", "station.xml",
                                        "--road-observed", "seen.xml", "--coupling", "-1"}},
                                      work.path());
    EXPECT_EQ(bad.exit_code, 2);
    EXPECT_NE(bad.err.find("--coupling: Value -1 not in range 0"), std::string::npos) << bad.err;
}

}  // namespace
}  // namespace petrichor::cli
