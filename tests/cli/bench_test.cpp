// The rows of `petrichor bench weather`. Nothing here looks at how long anything took.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "cli/bench/measure.h"
#include "cli/bench/sample_weather.h"
#include "cli/bench/texture_bench.h"
#include "cli/bench/weather_bench.h"
#include "weather/readers/read_weather.h"

namespace petrichor::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using weather::Field;

std::vector<std::string> names_of(const nlohmann::json& report)
{
    std::vector<std::string> names;
    for (const auto& row : report["rows"]) names.push_back(row["name"]);
    return names;
}

const WeatherBenchOptions kQuick{.repeat = 1, .cells = 12, .days = 3, .threads = 2};

nlohmann::json report_of(const WeatherBenchOptions& options)
{
    return nlohmann::json::parse(json_report(options, weather_rows(options)));
}

TEST(BenchWeather, TimesEveryRowWithoutAnyFile)
{
    const auto report = report_of(kQuick);
    EXPECT_EQ(report["weather"], "made up");
    EXPECT_EQ(report["threads"], 2);
    EXPECT_GT(report["peak_memory_mib"], 0);
    EXPECT_THAT(
        names_of(report),
        ElementsAre("degree_day_bare", "cell_year_bare", "road_year_bare", "seek_bare",
                    "degree_day_snow", "cell_year_snow", "road_year_snow", "seek_snow", "read_epw",
                    "read_metar_year", "artist_exact", "artist_stepped", "grid_bare_1_thread",
                    "grid_bare_all_threads", "grid_snow_1_thread", "grid_snow_all_threads"));
    for (const auto& row : report["rows"]) {
        EXPECT_GE(row["cpu_ms"], 0.0) << row["name"];
        EXPECT_GT(row["wall_ms"], 0.0) << row["name"];
        EXPECT_TRUE(row["what"].is_string()) << row["name"];
        const std::string name = row["name"];
        EXPECT_EQ(row.contains("memory_mib"), name.substr(0, 5) == "grid_") << name;
    }
}

TEST(BenchWeather, TimesARealFile)
{
    const auto folder = std::filesystem::path(testing::TempDir()) / "petrichor_bench_test";
    std::filesystem::create_directories(folder);
    WeatherBenchOptions options = kQuick;
    options.file = (folder / "town.epw").string();
    std::ofstream(options.file) << epw_of(sample_year(3, false));
    const auto report = report_of(options);
    std::filesystem::remove_all(folder);
    EXPECT_EQ(report["weather"], "town.epw");
    EXPECT_THAT(names_of(report),
                ElementsAre("degree_day_file", "cell_year_file", "road_year_file", "seek_file",
                            "read_epw", "read_metar_year", "read_file", "artist_exact",
                            "artist_stepped", "grid_file_1_thread", "grid_file_all_threads"));
}

TEST(BenchWeather, SaysWhichFileIsNotThere)
{
    WeatherBenchOptions options = kQuick;
    options.file = "gone.epw";
    try {
        weather_rows(options);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("gone.epw"));
    }
}

TEST(BenchRival, NameAndCommandAreSplitAtTheFirstEqualsSign)
{
    const Rival rival = parse_rival("FSM2.1=./FSM2 < nlst=a");
    EXPECT_EQ(rival.name, "FSM2.1");
    EXPECT_EQ(rival.command, "./FSM2 < nlst=a");
    for (const char* text : {"", "FSM2", "=./FSM2", "FSM2=", "FSM2= ", "a b=true", "a;b=true"}) {
        try {
            parse_rival(text);
            ADD_FAILURE() << "no error: " << text;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr(std::string("'") + text + "'"));
        }
    }
}

// Work done by what the command starts counts too, and time asleep is no CPU time.
TEST(BenchRival, CountsTheWorkOfTheCommandAndItsChildren)
{
    const Cost asleep = time_rival({"sleep", "sleep 0.2"}, 1);
    EXPECT_GE(asleep.wall_ms, 200.0);
    EXPECT_LT(asleep.cpu_ms, 100.0);
    const std::string count = "i=0; while [ $i -lt 200000 ]; do i=$((i+1)); done";
    const Cost busy = time_rival({"busy", "sh -c '" + count + "' | cat; true"}, 1);
    EXPECT_GT(busy.cpu_ms, asleep.cpu_ms + 10.0);
}

TEST(BenchRival, KnowsTheMemoryOfItsLargestProcess)
{
    const Cost cost = time_rival({"dd", "dd if=/dev/zero of=/dev/null bs=64M count=1"}, 1);
    EXPECT_GT(cost.peak_mib, 64.0);
    EXPECT_LT(cost.peak_mib, 96.0);
}

TEST(BenchRival, IsTheFirstRow)
{
    WeatherBenchOptions options = kQuick;
    options.rivals = {{"echo", "echo much text; echo more >&2"}, {"true", "true"}};
    const auto report = report_of(options);
    const auto names = names_of(report);
    ASSERT_GE(names.size(), 2u);
    EXPECT_EQ(names[0], "echo");
    EXPECT_EQ(names[1], "true");
    EXPECT_THAT(report["rows"][0]["what"].get<std::string>(), HasSubstr("echo much text"));
    EXPECT_GT(report["rows"][0]["wall_ms"], 0.0);
}

struct FailingRival {
    const char *name, *command, *message;
};
void PrintTo(const FailingRival& c, std::ostream* out)
{
    *out << c.name;
}
class BenchRivalFails : public testing::TestWithParam<FailingRival> {};
TEST_P(BenchRivalFails, AndSaysHow)
{
    const auto& c = GetParam();
    try {
        time_rival({c.name, c.command}, 1);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr(std::string("'") + c.name + "'"));
        EXPECT_THAT(error.what(), HasSubstr(c.message));
        EXPECT_NE(error.fix(), "");
    }
}
INSTANTIATE_TEST_SUITE_P(
    Table, BenchRivalFails,
    testing::Values(FailingRival{"missing", "./no_such_model < a.txt", "a.txt"},
                    FailingRival{"gone", "./no_such_model", "was not found"},
                    FailingRival{"folder", "/tmp", "is not a program"},
                    FailingRival{"failing", "echo first >&2; echo bad namelist >&2; exit 3",
                                 "failed with exit code 3: bad namelist"},
                    FailingRival{"killed", "kill -9 $$", "was ended by signal 9"}),
    [](const auto& test) { return test.param.name; });

TEST(BenchTexture, TablesHaveWhatWasMeasuredAndWhatWasNot)
{
    const std::vector<TextureBenchRow> rows{
        {"bc5", "petrichor", Cost{1500.0, 800.0, 120.0}, 44.25, ""},
        {"prefilter", "petrichor median kernel", Cost{3000.0, 1600.0}, {}, "16.8 Mtexel"},
        {"bc5", "nvcompress", {}, {}, "missing: apt install libnvtt-bin"}};
    EXPECT_EQ(to_text(rows),
              "task       program                    CPU s   wall s     MiB  PSNR dB\n"
              "bc5        petrichor                   1.50     0.80     120    44.25\n"
              "prefilter  petrichor median kernel     3.00     1.60                   16.8 Mtexel\n"
              "bc5        nvcompress               missing: apt install libnvtt-bin\n");
    const nlohmann::json json = nlohmann::json::parse(to_json(rows))["rows"];
    EXPECT_EQ(json[0]["psnr_db"], 44.25);
    EXPECT_EQ(json[0]["peak_mib"], 120.0);
    EXPECT_FALSE(json[1].contains("peak_mib"));
    EXPECT_FALSE(json[2].contains("cpu_s"));
}

TEST(BenchMedian, IsTheMiddle)
{
    EXPECT_EQ(median({}), 0.0);
    EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
    EXPECT_EQ(median({4.0, 1.0, 2.0, 3.0}), 2.5);
}

// The made-up weather is what its name says, and its files say the same weather.
TEST(BenchSample, SnowyIsSnowyAndFilesAgree)
{
    const auto bare = sample_year(365, false);
    const auto snowy = sample_year(365, true);
    EXPECT_EQ(bare.rows(), 8760u);
    const auto frosty_hours = [](const weather::ForcingTable& table) {
        int hours = 0;
        for (std::size_t i = 0; i < table.rows(); ++i)
            hours += table[Field::AirTemp][i] < 273.15 && table[Field::Precip][i] > 0.0;
        return hours;
    };
    EXPECT_GT(frosty_hours(snowy), 200);
    EXPECT_LT(frosty_hours(bare), frosty_hours(snowy) / 4);

    const auto epw = weather::read_weather(epw_of(bare));
    EXPECT_EQ(epw.report.format, "EPW");
    EXPECT_EQ(epw.report.bad_rows, 0u);
    EXPECT_EQ(epw.table.rows(), bare.rows() + 1);  // its hours end at their times
    weather::ReadOptions reading;
    reading.year = kSampleYear;
    reading.month = kSampleMonth;
    const auto metar = weather::read_weather(metar_of(bare), reading);
    EXPECT_EQ(metar.report.format, "METAR");
    EXPECT_EQ(metar.table.rows(), bare.rows());
    EXPECT_EQ(metar.report.bad_rows, 0u);
}

}  // namespace
}  // namespace petrichor::cli
