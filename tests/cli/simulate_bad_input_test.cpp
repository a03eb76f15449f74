// Every reader of weather files, through the program, on every kind of damage: exit 2 and a message
// that names the problem, or exit 0 with the bridged row in the report; an output that exists is
// never touched by a failure.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/program.h"

namespace petrichor::cli {
namespace {

using namespace testing_program;

struct Row {
    int day, hour;
    std::string temp_c;  // may be nonsense
};
// A format: how its file begins and how each of its rows reads.
struct Format {
    const char* name;
    std::string head;
    std::function<std::string(const Row&)> row;
    bool sorts = false;  // rows may come newest first, reports in any order
    const char* twice = "for the same ";  // what it says then of a row that stands there again
};
void PrintTo(const Format& f, std::ostream* out)
{
    *out << f.name;
}

std::string printed(const char* form, auto... values)
{
    char text[600];
    std::snprintf(text, sizeof text, form, values...);
    return text;
}

std::string tenths(const std::string& temp_c)
{
    char* end = nullptr;
    const double v = std::strtod(temp_c.c_str(), &end);
    return *end || !std::isfinite(v) || std::abs(v) > 1000
               ? temp_c
               : std::to_string(static_cast<int>(v * 10));
}

const std::vector<Format>& formats()
{
    static const std::vector<Format> kFormats{
        {"fsm", "",
         [](const Row& r) {
             char* end = nullptr;
             const double v = std::strtod(r.temp_c.c_str(), &end);
             const std::string kelvin = *end ? r.temp_c : printed("%.2f", v + 273.15);
             return printed("2020 1 %d %d 100. 250.5 .000E+00 .000E+00 %s 80.0 2.0 90000.\n", r.day,
                            r.hour, kelvin.c_str());
         }},
        {"csv", "time,air_temp_c,rel_humidity_pct,wind_m_s,precip_mm\n",
         [](const Row& r) {
             return printed("2020-01-%02dT%02d:00Z,%s,80,2,0.1\n", r.day, r.hour, r.temp_c.c_str());
         },
         true, "in the file again, letter by letter"},
        {"epw",
         "LOCATION,Test,X,Y,TMY3,1,45.0,8.0,1.0,200\nDESIGN CONDITIONS,0\nTYPICAL/EXTREME "
         "PERIODS,0\nGROUND TEMPERATURES,0\n"
         "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\nCOMMENTS 1,a\nCOMMENTS 2,b\nDATA "
         "PERIODS,1,1,Data,Sunday, 1/ 1,12/31\n",
         [](const Row& r) {
             return printed(
                 "2021,1,%d,%d,0,?9,%s,-5.0,80,95000,0,0,250,100,50,60,0,0,0,0,200,2.0,5,5,20.0,"
                 "2000,9,999999999,10,0.05,0,88,0.2,0.1,1.0\n",
                 r.day, r.hour + 1, r.temp_c.c_str());
         },
         true, "in the file again, letter by letter"},
        {"tmy3",
         "723170,\"TEST\",NC,-5.0,36.1,-79.95,270\nDate (MM/DD/YYYY),Time (HH:MM),GHI (W/m^2),DHI "
         "(W/m^2),TotCld (tenths),Dry-bulb (C),RHum (%),Pressure (mbar),Wspd (m/s)\n",
         [](const Row& r) {
             return printed("01/%02d/1988,%02d:00,100,60,5,%s,80,990,2.0\n", r.day, r.hour + 1,
                            r.temp_c.c_str());
         }},
        {"pvgis",
         "Latitude (decimal degrees): 45.000\nLongitude (decimal degrees): 8.000\nElevation (m): "
         "250.0\ntime(UTC),T2m,RH,G(h),IR(h),WS10m,SP\n",
         [](const Row& r) {
             return printed("202001%02d:%02d00,%s,80,100.0,250.0,2.0,95000\n", r.day, r.hour,
                            r.temp_c.c_str());
         }},
        {"open-meteo-csv",
         "latitude,longitude,elevation,utc_offset_seconds,timezone,timezone_abbreviation\n52.5,13."
         "4,38.0,0,GMT,GMT\n\n"
         "time,temperature_2m (\u00b0C),relative_humidity_2m (%),precipitation (mm),wind_speed_10m "
         "(km/h)\n",
         [](const Row& r) {
             return printed("2020-01-%02dT%02d:00,%s,80,0.1,7.2\n", r.day, r.hour,
                            r.temp_c.c_str());
         }},
        {"metar", "",
         [](const Row& r) {
             char* end = nullptr;
             const double v = std::strtod(r.temp_c.c_str(), &end);
             const std::string code =
                 *end || !(std::abs(v) <= 90)
                     ? r.temp_c
                     : printed("%s%02d", v < 0 ? "M" : "", static_cast<int>(std::abs(v)));
             return printed("METAR EDDF %02d%02d50Z 24010KT 9999 BKN030 %s/M08 Q1010=\n", r.day,
                            r.hour, code.c_str());
         },
         true},
        {"smet",
         "SMET 1.1 ASCII\n[HEADER]\nstation_id = TEST\nlatitude = 46.8\nlongitude = 9.8\naltitude "
         "= 2540\nnodata = -999\ntz = 0\n"
         "fields = timestamp TA RH VW ISWR PSUM\nunits_offset = 0 273.15 0 0 0 0\nunits_multiplier "
         "= 1 1 0.01 1 1 1\n[DATA]\n",
         [](const Row& r) {
             return printed("2020-01-%02dT%02d:00 %s 80 2.0 100 0.1\n", r.day, r.hour,
                            r.temp_c.c_str());
         },
         true, "in the file again, letter by letter"},
        {"isd-lite", "",
         [](const Row& r) {
             return printed("2020 01 %02d %02d %s -80 10100 180 30 8 0 -9999\n", r.day, r.hour,
                            tenths(r.temp_c).c_str());
         },
         true, "in the file again, letter by letter"},
        {"ghcn", "",
         [](const Row& r) {
             if (r.hour != 0) return std::string();
             return printed(
                 "USC00012345,202001%02d,TMAX,%s,,,7,\nUSC00012345,202001%02d,TMIN,-90,,,7,\n",
                 r.day, tenths(r.temp_c).c_str(), r.day);
         },
         true},
        {"surfrad", " Bondville\n   40.05  88.37  230 m version 1\n",
         [](const Row& r) {
             return printed("2020 1 1 %d %d 0 18.0 65.0 100 0 80 0 50 0 10 0 250 0", r.day,
                            r.hour) +
                    printed(
                        " 270 0 270 0 300 0 272 0 272 0 0 0 150 0 320 0 -50 0 270 0 %s 0 80 0 2.0 "
                        "0 270 0 990.1 0\n",
                        r.temp_c.c_str());
         }},
        {"open-meteo-json", "", nullptr},
    };
    return kFormats;
}

std::string file_of(const Format& format, const std::vector<Row>& rows)
{
    std::string text = format.head;
    if (format.row) {
        for (const Row& row : rows) text += format.row(row);
        return text;
    }
    std::string times, temps;
    for (const Row& row : rows) {
        times +=
            (times.empty() ? "" : ",") + printed("\n\"2020-01-%02dT%02d:00\"", row.day, row.hour);
        temps += (temps.empty() ? "" : ",") + std::string("\n") + row.temp_c;
    }
    return "{\"latitude\":52.5,\"longitude\":13.4,\"elevation\":38.0,\"utc_offset_seconds\":0,"
           "\n\"hourly_units\":{\"time\":\"iso8601\",\"temperature_2m\":\"\u00b0C\"},\n"
           "\"hourly\":{\"time\":[" +
           times + "],\n\"temperature_2m\":[" + temps + "]}}\n";
}

std::vector<Row> good_rows()
{
    std::vector<Row> rows;
    for (int day = 1; day <= 20; ++day) {
        for (int hour = 0; hour < 24; hour += 6)
            rows.push_back({day, hour, std::to_string(2 + hour / 6)});
    }
    return rows;
}

std::vector<Row> with_temperatures(const std::function<std::string(std::size_t, const Row&)>& temp)
{
    std::vector<Row> rows = good_rows();
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].temp_c = temp(i, rows[i]);
    return rows;
}

class BadInput : public testing::TestWithParam<Format> {
protected:
    // Runs the program on a text, with an output that exists.
    Outcome simulated(const std::string& text)
    {
        write_file(work / "input", text);
        write_file(work / "out.csv", "keep me");
        return run_petrichor({{"simulate", "input", "--model", "physical", "--latitude", "47",
                               "--longitude", "8", "--elevation-m", "100", "-o", "out.csv"}},
                             work.path());
    }
    void expect_refused(const std::string& text, const std::string& part)
    {
        const Outcome o = simulated(text);
        EXPECT_EQ(o.exit_code, 2) << o.err.substr(0, 2000);
        EXPECT_NE(o.err.find(part), std::string::npos) << "expected: " << part << "\n"
                                                       << o.err.substr(0, 2000);
        EXPECT_EQ(read_file(work / "out.csv"), "keep me");
        const auto files = std::distance(std::filesystem::directory_iterator(work.path()), {});
        EXPECT_EQ(files, 4)
            << "the input, the old output and the test's own .stdout and .stderr, nothing else";
    }
    // The run succeeds and says what was wrong.
    void expect_bridged(const std::string& text, const std::string& part)
    {
        const Outcome o = simulated(text);
        EXPECT_EQ(o.exit_code, 0) << o.err.substr(0, 2000);
        EXPECT_NE(o.err.find(part), std::string::npos) << "expected: " << part << "\n"
                                                       << o.err.substr(0, 2000);
        EXPECT_EQ(read_file(work / "out.csv").rfind("time_s,", 0), 0u);
    }
    Workplace work{std::string("bad-") + GetParam().name};
};

TEST_P(BadInput, TheGoodFileIsGood)
{
    expect_bridged(file_of(GetParam(), good_rows()), "air_temp: ");
}
TEST_P(BadInput, Empty)
{
    expect_refused("", "empty");
    expect_refused(" \n\n", "empty");
}
TEST_P(BadInput, Binary)
{
    std::string text = file_of(GetParam(), good_rows());
    expect_refused(text.substr(0, 40) + std::string("\x7f\x45\x4c\x46\0\0\1\2", 8) + text,
                   "binary");
    for (std::size_t i = 0; i < text.size(); ++i) text[i] = static_cast<char>(1 + (i * 7919) % 25);
    expect_refused(text, "binary");
}
TEST_P(BadInput, Truncated)
{
    const Format& f = GetParam();
    const std::string text = file_of(f, good_rows());
    if (!f.row) {
        expect_refused(text.substr(0, text.size() / 2), "line");
        return;
    }
    if (!f.head.empty()) expect_refused(f.head, "weather: ");
    expect_refused(text.substr(0, 9), "weather: ");
}
TEST_P(BadInput, WrongSeparator)
{
    std::string text = file_of(GetParam(), good_rows());
    for (char& c : text) {
        if (c == ',' || c == ' ') c = '|';
    }
    expect_refused(text, "weather:");
}
TEST_P(BadInput, NotANumberThroughout)
{
    const std::string text = file_of(GetParam(), with_temperatures([](std::size_t, const Row&) {
                                         return GetParam().row ? "nan" : "null";
                                     }));
    if (std::string(GetParam().name) == "ghcn")
        expect_bridged(text, "'nan' is not possible");  // the minima are fine
    else
        expect_refused(text, "weather: ");
}
TEST_P(BadInput, OneThatIsNotANumberIsBridgedAndNamed)
{
    const auto rows = with_temperatures([](std::size_t i, const Row& r) {
        return i == 8 ? std::string(GetParam().row ? "nan" : "null") : r.temp_c;
    });
    const std::string name = GetParam().name;
    expect_bridged(file_of(GetParam(), rows), name == "ghcn"    ? "'nan' is not possible"
                                              : name == "metar" ? "'nan/M08' is not understood"
                                              : !GetParam().row ? "1 missing"
                                                                : "line ");
}
TEST_P(BadInput, AbsurdValues)
{
    const std::string text =
        file_of(GetParam(), with_temperatures([](std::size_t, const Row&) { return "8888888"; }));
    if (std::string(GetParam().name) == "ghcn")
        expect_bridged(text, "'8888888' is not possible");  // the minima are fine
    else
        expect_refused(text, std::string(GetParam().name) == "metar"
                                 ? "no air temperature"
                                 : "air_temp: 80 of 80 values are outside");
}
// Part of the file in another unit: those values cannot be, and each is named.
TEST_P(BadInput, MixedUnits)
{
    const bool kelvin = std::string(GetParam().name) != "fsm";
    const auto rows = with_temperatures([&](std::size_t i, const Row& r) {
        return i < 76 ? r.temp_c : kelvin ? "275" : "-271";
    });
    expect_bridged(file_of(GetParam(), rows),
                   std::string(GetParam().name) == "metar" ? "275/M08" : "out of range");
}
TEST_P(BadInput, UnorderedAndDuplicateTimes)
{
    const Format& f = GetParam();
    auto rows = good_rows();
    std::reverse(rows.begin(), rows.end());
    if (f.sorts)
        expect_bridged(file_of(f, rows), "air_temp: ");
    else
        expect_refused(file_of(f, rows), "earlier than the row before");
    auto twice = good_rows();
    const auto once = twice;
    for (std::size_t i = 0; i < once.size(); ++i)
        twice.insert(twice.begin() + static_cast<std::ptrdiff_t>(2 * i), once[i]);
    if (f.sorts)
        expect_bridged(file_of(f, twice), f.twice);
    else
        expect_refused(file_of(f, twice), "duplicate");
    // One alone among good ones is bridged.
    auto one = good_rows();
    one.insert(one.begin() + 9, one[8]);
    expect_bridged(file_of(f, one), f.sorts ? f.twice : "duplicate of ");
}
TEST_P(BadInput, AGigabyteOfZeros)
{
    for (const bool after_rows : {false, true}) {
        write_file(work / "input", after_rows ? file_of(GetParam(), good_rows()) : "");
        std::filesystem::resize_file(work / "input", std::uintmax_t{1} << 30);  // sparse
        write_file(work / "out.csv", "keep me");
        const Outcome o = run_petrichor({{"simulate", "input", "-o", "out.csv"}}, work.path());
        EXPECT_EQ(o.exit_code, 2) << o.err;
        EXPECT_TRUE(o.err.find("binary") != std::string::npos ||
                    o.err.find("1073741824 bytes") != std::string::npos)
            << o.err;
        EXPECT_EQ(read_file(work / "out.csv"), "keep me");
    }
    rusage used{};
    ::getrusage(RUSAGE_CHILDREN, &used);
    EXPECT_LT(used.ru_maxrss, 200 * 1024) << "KiB, the most of any run";
}

INSTANTIATE_TEST_SUITE_P(Formats, BadInput, testing::ValuesIn(formats()), [](const auto& test) {
    std::string name = test.param.name;
    std::erase(name, '-');
    return name;
});

TEST(BadCsv, UnitsThatContradictOrDoNotExist)
{
    Workplace work("bad-units");
    const auto why = [&](const std::string& header, const std::string& row) {
        write_file(work / "input.csv", header + "\n" + row + "\n");
        const Outcome o =
            run_petrichor({{"simulate", "input.csv", "--model", "physical"}}, work.path());
        EXPECT_EQ(o.exit_code, 2) << header;
        return o.err;
    };
    EXPECT_NE(
        why("time,air_temp_c,air_temp_k", "2020-01-01T00:00Z,1,274").find("mean the same quantity"),
        std::string::npos);
    EXPECT_NE(why("time,air_temp_c,wind (furlong)", "2020-01-01T00:00Z,1,2").find("furlong"),
              std::string::npos);
    EXPECT_NE(why("when,temp", "2020-01-01T00:00Z,1").find("kind of this file"), std::string::npos);
    EXPECT_NE(why("time_s,temperature_c", "0,1").find("keys"), std::string::npos)
        << "keys are not weather";
}

// Keys of the artist model, for completeness: the same questions.
// What is asked for beyond the ends of a file is not there, and said.
TEST(Window, BeyondTheEndsOfTheWeatherIsTold)
{
    const Workplace work("window");
    std::string text = "time,air_temp_c\n";
    for (int h = 0; h < 24; ++h) text += printed("2020-01-02T%02d:00Z,%d\n", h, h);
    write_file(work / "w.csv", text);
    const auto said = [&](const char* from, const char* to) {
        const Outcome o = run_petrichor({{"simulate", "w.csv", "--latitude", "45", "--longitude", "8", "--from",
                                          from, "--to", to, "-o", "out.csv"}},
                                        work.path());
        EXPECT_EQ(o.exit_code, 0) << o.err;
        return o.err;
    };
    const std::string both = said("2020-01-01", "2020-01-05");
    EXPECT_NE(both.find("--from is before the weather, which begins at 2020-01-02T00:00:00Z"), std::string::npos)
        << both;
    EXPECT_NE(both.find("--to is after the weather, which ends at "), std::string::npos) << both;
    EXPECT_EQ(said("2020-01-02T03:00", "2020-01-02T20:00").find("the weather, which"), std::string::npos);
    const std::string dates = read_file(work / "out.csv");
    EXPECT_NE(dates.find("\n10800,2020-01-02T03:00:00Z,"), std::string::npos) << dates.substr(0, 900);
    said("3h", "0.5d");
    EXPECT_NE(read_file(work / "out.csv").find("\n43200,"), std::string::npos);
    EXPECT_EQ(read_file(work / "out.csv").find("\n46800,"), std::string::npos);
    said("180min", "20h");
    EXPECT_EQ(read_file(work / "out.csv"), dates) << "spans from the start";
}

// What --fit-artist has read and filled is told, and an option that it could not use is an error.
TEST(FitArtist, TellsWhatWasReadAndTakesNoOtherOption)
{
    Workplace work("fit-artist");
    std::string text = "time,air_temp_c,sw_down_w_m2\n";
    for (int h = 0; h < 24; ++h) text += printed("2020-01-02T%02d:00Z,%d,0\n", h, h);
    write_file(work / "w.csv", text);
    const auto fit = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"simulate", "w.csv", "--fit-artist", "-o", "rates.toml"});
        return run_petrichor({more}, work.path());
    };
    const Outcome good = fit({});
    EXPECT_EQ(good.exit_code, 0) << good.err;
    EXPECT_NE(good.err.find("air_temp: 24 read"), std::string::npos) << good.err;
    EXPECT_NE(good.err.find("have no amount in the file: taken as dry"), std::string::npos) << good.err;
    EXPECT_NE(good.err.find("wrote rates.toml"), std::string::npos) << good.err;
    EXPECT_TRUE(good.out.empty());
    const std::vector<std::vector<std::string>> others{
        {"--from", "6h"}, {"--json"}, {"--sensitivity"}, {"-o", "two.csv"}, {"--ensemble", "3"}};
    for (const auto& more : others) {
        const Outcome bad = fit(more);
        EXPECT_EQ(bad.exit_code, 2) << more.front();
        EXPECT_NE(bad.err.find("is not of --fit-artist"), std::string::npos) << bad.err;
    }
}

TEST(BadKeys, AreListedWithTheirLines)
{
    Workplace work("bad-keys");
    const auto why = [&](const std::string& text) {
        write_file(work / "keys.csv", text);
        write_file(work / "out.csv", "keep me");
        const Outcome o = run_petrichor({{"simulate", "keys.csv", "-o", "out.csv"}}, work.path());
        EXPECT_EQ(o.exit_code, 2) << text.substr(0, 100) << o.err;
        EXPECT_EQ(read_file(work / "out.csv"), "keep me");
        return o.err;
    };
    const std::string head = "time_s,temperature_c,rainfall\n";
    EXPECT_NE(why(head).find("no rows"), std::string::npos);
    EXPECT_NE(why(head + "0,5,nan\n").find("line 2"), std::string::npos);
    EXPECT_NE(why(head + "0,5,0\n0,5,0\n").find("line 3"), std::string::npos);
    EXPECT_NE(why(head + "4,5,0\n2,5,0\n").find("earlier"), std::string::npos);
    EXPECT_NE(why(head + "0,500,0\n").find("temperature_c"), std::string::npos);
    EXPECT_NE(why("time_s;temperature_c;rainfall\n0;5;0\n").find("comma"), std::string::npos);
    EXPECT_NE(why("time_s,rainfall\n0,0\n").find("temperature_c"), std::string::npos);
}

}  // namespace
}  // namespace petrichor::cli
