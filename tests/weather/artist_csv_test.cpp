#include "weather/models/artist/csv.h"
#include "weather/models/artist/exact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.h"

namespace petrichor::weather {
namespace {

std::string problem_of(std::string_view text)
{
    try {
        parse_timeline_csv(text, Interpolation::Hold);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

void expect_problem(std::string_view text, const std::string& part)
{
    const std::string found = problem_of(text);
    EXPECT_NE(found.find(part), std::string::npos) << "got: " << found << "\nexpected: " << part;
}

TEST(TimelineCsv, ReadsColumnsInAnyOrderAndCase)
{
    const auto reading = parse_timeline_csv(
        "\xEF\xBB\xBF# keys\r\nRainfall,Time_S, temperature_c ,Time_Scale\r\n0.5,0,1e1,\r\n\r\n"
        "0,2.5,-3,2\r\n\"1\",4,+4,\r\n",
        Interpolation::Smooth);
    const Timeline& t = reading.timeline;
    EXPECT_EQ(t.rainfall.values, (std::vector<double>{0.5, 0, 1}));
    EXPECT_EQ(t.temperature_c.times, (std::vector<TimeUs>{0, 2500000, 4000000}));
    EXPECT_EQ(t.temperature_c.interpolation, Interpolation::Smooth);
    EXPECT_EQ(t.parameters.at("time_scale").times, std::vector<TimeUs>{2500000});
    EXPECT_TRUE(reading.bridged.empty());
}

TEST(TimelineCsv, ListsEveryProblemWithItsLine)
{
    const std::string head = "time_s,temperature_c,rainfall\n";
    expect_problem("", "the file is empty");
    expect_problem("\n\n", "the file is empty");
    expect_problem(head, "no rows");
    expect_problem("time_s;temperature_c;rainfall\n0;1;0\n", "line 1: columns are separated by ;");
    expect_problem("time_s\ttemperature_c\trainfall\n", "a tab");
    expect_problem("time_s,rainfall\n0,0\n", "temperature_c: this column is missing");
    expect_problem("time_s,temperature_c,rainfall,rainfal\n0,0,0,0\n", "rainfal: no input");
    expect_problem("time_s,temperature_c,rainfall,Rainfall\n", "appears twice");
    expect_problem(head + "0,1,0\n1,nan,0\n", "line 3, temperature_c: not a finite number: nan");
    expect_problem(head + "0,1,0\n1,inf,0\n", "line 3, temperature_c");
    expect_problem(head + "0,1,0\n1,2,5.5\n", "line 3, rainfall: 5.5 is outside 0 .. 1");
    expect_problem(head + "0,1,0\n1,9999,0\n", "line 3, temperature_c: 9999 is outside");
    expect_problem(head + "0,1,0\n5,1,0\n3,1,0\n", "line 4, time_s: 3 is earlier");
    expect_problem(head + "0,1,0\n5,1,0\n5,1,0\n", "line 4, time_s: 5 appears twice");
    expect_problem(head + "-1,1,0\n", "line 2, time_s: -1 is outside");
    expect_problem(head + "0,1\n", "line 2: 2 cells, expected 3");
    expect_problem(head + "0,1,5,0,3\n", "decimal commas");
    expect_problem(head + ",1,0\n", "line 2, time_s: empty");
    expect_problem(head + "0,,0\n", "temperature_c: no row has a value");
    expect_problem(std::string(100, '\0'), "not a text file");
    expect_problem(std::string_view("\x7f"
                                    "ELF\x02\x01\x01\0\0",
                                    9),
                   "not a text file");
    const std::string both = problem_of(head + "0,x,0\n1,1,y\n");
    EXPECT_NE(both.find("2 problems"), std::string::npos);
    EXPECT_NE(both.find("line 2, temperature_c"), std::string::npos);
    EXPECT_NE(both.find("line 3, rainfall"), std::string::npos);
}

TEST(TimelineCsv, BridgesOneBadRowAmongManyAndSaysSo)
{
    std::string text = "time_s,temperature_c,rainfall\n";
    for (int i = 0; i < 40; ++i) {
        text += std::to_string(i) + (i == 17 ? ",NaN" : ",5") + ",0\n";
    }
    const auto reading = parse_timeline_csv(text, Interpolation::Linear);
    EXPECT_EQ(reading.timeline.temperature_c.times.size(), 39u);
    ASSERT_EQ(reading.bridged.size(), 1u);
    EXPECT_EQ(reading.bridged[0].line, 19u);
    EXPECT_EQ(reading.bridged[0].field, "temperature_c");
}

// Whatever the bytes, an answer or an Error.
TEST(TimelineCsv, SurvivesDamagedText)
{
    const std::string good =
        "time_s,temperature_c,rainfall,time_scale\n0,1,0,1\n1,\"2\",0.5,\n2,-3,1,2\n3,4,0,1\n";
    std::mt19937 random(9);
    int errors = 0;
    for (int round = 0; round < 3000; ++round) {
        std::string text = good;
        for (int edits = 0; edits < 3; ++edits) {
            const std::size_t at = random() % text.size();
            switch (random() % 3) {
                case 0:
                    text[at] = static_cast<char>(random());
                    break;
                case 1:
                    text.erase(at, random() % 9);
                    break;
                default:
                    text.insert(at, text.substr(random() % text.size(), random() % 20));
            }
            if (text.empty()) text = ",";
        }
        try {
            check_timeline(parse_timeline_csv(text, Interpolation::Hold).timeline);
        } catch (const Error&) {
            ++errors;
        }
    }
    EXPECT_GT(errors, 1000);
}

TEST(Csv, NumbersReadBackAsTheSameBits)
{
    EXPECT_EQ(number_17(0.1), "0.10000000000000001");
    EXPECT_EQ(number_17(1.0), "1");
    EXPECT_EQ(number_17(-0.0), "-0");
    for (double value : {1.0 / 3.0, 1e-300, 123456789.123, 2.0 / 7.0}) {
        EXPECT_EQ(parse_number(number_17(value)), value);
    }
    EXPECT_FALSE(parse_number("1,5"));
    EXPECT_FALSE(parse_number("1.5x"));
    EXPECT_FALSE(parse_number(""));
    EXPECT_FALSE(parse_number("1e999"));
}

TEST(Csv, ProblemListsAreCut)
{
    const std::vector<Problem> many(30, {4, "x", "bad"});
    const std::string text = list_problems(many, 3);
    EXPECT_EQ(text, "line 4, x: bad\nline 4, x: bad\nline 4, x: bad\n... and 27 more");
}

TEST(TimelineCsv, HandSetStatesAreColumns)
{
    const auto reading = parse_timeline_csv(
        "time_s,temperature_c,rainfall,script_controlled,wetness\n0,5,0,1,\n2,5,0,0,0.25\n4,5,0,0,"
        "0.75\n",
        Interpolation::Linear);
    ASSERT_EQ(reading.timeline.states.size(), 1u);
    EXPECT_DOUBLE_EQ(ArtistTimeline(reading.timeline, {}, {}).state_at(to_time_us(3)).wetness, 0.5);
    EXPECT_THROW(parse_timeline_csv("time_s,temperature_c,rainfall,wetness\n0,5,0,1.5\n",
                                    Interpolation::Hold),
                 Error);
}

}  // namespace
}  // namespace petrichor::weather
