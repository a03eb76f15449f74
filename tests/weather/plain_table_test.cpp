// Tables as people have them: the same weather, however it is laid out, and a word where it is not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "base/error.h"
#include "weather/readers/read_weather.h"
#include "weather/readers/text.h"

namespace petrichor::weather {
namespace {

using testing::HasSubstr;
using testing::Not;

using Row = std::array<std::string, 8>;
const Row kNames = {"time",       "sw_down_w_m2",     "lw_down_w_m2", "precip_mm",
                    "air_temp_c", "rel_humidity_pct", "wind_m_s",     "pressure_hpa"};

std::string number(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", value);
    return text;
}

// Ten days of hours about the last Sunday of March 2024; UTC without saying so.
std::vector<Row> hours()
{
    std::vector<Row> rows;
    const auto start = *us_from_iso("2024-03-26T00:00Z");
    for (int h = 0; h < 240; ++h) {
        const double noon = 12.0 - std::abs(h % 24 - 12.0);
        const double air_c = -4.0 + 0.02 * h + 0.5 * noon;
        rows.push_back({iso_from_us(start + h * 3600000000LL).substr(0, 16),
                        number(noon > 6 ? 80.0 * (noon - 6.0) : 0.0), number(280.0 + h % 7),
                        number(h % 5 == 0 ? 0.4 : 0.0), number(air_c), number(80.0 - noon),
                        number(2.0 + h % 3), number(870.25 + h % 11)});
    }
    return rows;
}

std::string text_of(
    const Row& names, const std::vector<Row>& rows, const std::string& separator = ",",
    const std::function<std::string(std::size_t, const std::string&)>& cell = nullptr)
{
    std::string text;
    const auto line = [&](const Row& row, bool name) {
        for (std::size_t i = 0; i < row.size(); ++i)
            text += (i ? separator : "") + (cell && !name ? cell(i, row[i]) : row[i]);
        text += "\n";
    };
    line(names, true);
    for (const Row& row : rows) line(row, false);
    return text;
}
std::string usual()
{
    return text_of(kNames, hours());
}

ReadResult read(const std::string& text)
{
    ReadOptions options;
    options.site.latitude_deg = 45.3;
    options.site.longitude_deg = 0.0;
    options.site.elevation_m = 1325.0;
    return read_weather(text, options);
}
std::string refusal(const std::string& text)
{
    try {
        read(text);
    } catch (const Error& e) {
        return std::string(e.what()) + " " + e.fix();
    }
    return "";
}

// The text is read as the usual table is, to 1e-9 of each value. The report.
std::string expect_same(const std::string& text)
{
    const auto want = read(usual());
    const auto got = read(text);
    EXPECT_EQ(got.table.time_us, want.table.time_us);
    EXPECT_EQ(got.report.bad_rows, 0u);
    for (std::size_t f = 0; f < kFieldCount; ++f) {
        const auto field = static_cast<Field>(f);
        EXPECT_EQ(got.table[field].size(), want.table[field].size()) << field_info(field).name;
        for (std::size_t i = 0; i < std::min(got.table[field].size(), want.table[field].size());
             ++i) {
            if (std::isnan(want.table[field][i]) && std::isnan(got.table[field][i])) continue;
            EXPECT_NEAR(got.table[field][i], want.table[field][i],
                        1e-9 * std::max(1.0, std::abs(want.table[field][i])))
                << field_info(field).name << " " << i;
            if (testing::Test::HasFailure()) return "";
        }
    }
    return to_text(got.report);
}

std::string with_comma(std::string text)
{
    std::replace(text.begin(), text.end(), '.', ',');
    return text;
}

TEST(PlainTable, OtherSeparatorsAndDecimalCommas)
{
    for (const char* separator : {";", "\t", " ", "   "})
        expect_same(text_of(kNames, hours(), separator));
    const auto comma = [](std::size_t, const std::string& c) { return with_comma(c); };
    for (const char* separator : {";", "\t", " "})
        expect_same(text_of(kNames, hours(), separator, comma));
    expect_same(text_of(kNames, hours(), ",", [](std::size_t, const std::string& c) {
        return "\"" + with_comma(c) + "\"";
    }));
    // 1.013,25: points between thousands.
    auto rows = hours();
    auto names = kNames;
    names[7] = "pressure_pa";
    for (Row& row : rows) {
        const double pa = 100.0 * *to_number(row[7]);
        char text[32];
        std::snprintf(text, sizeof text, "%d.%03d,0", static_cast<int>(pa) / 1000,
                      static_cast<int>(pa) % 1000);
        row[7] = text;
    }
    expect_same(text_of(names, rows, ";"));
    // "1,013" between commas is a thousand in English, and 1.013 elsewhere: neither is taken.
    for (Row& row : rows) row[7] = "\"87,025\"";
    EXPECT_THAT(refusal(text_of(names, rows)), HasSubstr("not numbers"));
}

TEST(PlainTable, SeparatorsAtTheEndAreNoColumn)
{
    const auto at_end = [](std::size_t i, const std::string& c) { return i == 7 ? c + "," : c; };
    expect_same(text_of(kNames, hours(), ",", at_end));
    auto names = kNames;
    names[7] += ",";
    EXPECT_THAT(expect_same(text_of(names, hours(), ",", at_end)),
                Not(HasSubstr("without a name")));
    expect_same(text_of(names, hours()));
    // What stands there is named.
    EXPECT_THAT(to_text(read(text_of(names, hours(), ",",
                                     [](std::size_t i, const std::string& c) {
                                         return i == 7 ? c + ",x" : c;
                                     }))
                            .report),
                HasSubstr("a column without a name"));
}

TEST(PlainTable, TitlesAndUnitsAroundTheNames)
{
    EXPECT_THAT(expect_same("My station, Grenoble\n\n" + usual()),
                HasSubstr("'My station, Grenoble': the names of the columns are in line 3"));
    EXPECT_THAT(expect_same("Weather data, time in UTC\n" + usual()), HasSubstr("in line 2"));
    const auto placed =
        read_weather("Station: Grenoble\nLatitude; 45.25\nLongitude,5.5\n" + usual());
    EXPECT_EQ(placed.table.site.latitude_deg, 45.25);
    EXPECT_EQ(placed.table.site.longitude_deg, 5.5);
    const auto comma =
        read_weather("Latitude;45,25;;\nLongitude;5,5;;\n" + text_of(kNames, hours(), ";"));
    EXPECT_EQ(comma.table.site.latitude_deg, 45.25);
    const Row bare = {"time",     "sw_down",      "lw_down", "precip",
                      "air_temp", "rel_humidity", "wind",    "pressure"};
    const std::string rows = usual().substr(usual().find('\n') + 1);
    const std::string names = text_of(bare, {});
    EXPECT_THAT(expect_same(names + ",W/m2,W/m^2,mm,C,%,m/s,hPa\n" + rows),
                HasSubstr("line 2 columns: the units of the columns"));
    EXPECT_THAT(refusal(names + ",W/m2,W/m2,mm,C,%,m/s,hP\n" + rows),
                HasSubstr("'hp' is not known"));
    // A logger's own: names, units, and how values were made.
    const std::string logger =
        "\"TOA5\",\"hut\",\"CR1000\",\"1234\",\"Std.1\",\"CPU:hut.CR1\",\"1\",\"Hourly\"\n"
        "\"TIMESTAMP\",\"SlrW_Avg\",\"LW_in_Avg\",\"Rain_mm_Tot\",\"AirTC_Avg\",\"RH\",\"WS_ms_"
        "Avg\","
        "\"BP_mbar\"\n"
        "\"TS\",\"W/m^2\",\"W/m^2\",\"mm\",\"Deg C\",\"%\",\"m/s\",\"mbar\"\n"
        "\"\",\"Avg\",\"Avg\",\"Tot\",\"Avg\",\"Smp\",\"Avg\",\"Smp\"\n";
    const auto toa5 = read(logger + rows), want = read(usual());
    EXPECT_EQ(toa5.report.bad_rows, 0u);
    for (const Field f :
         {Field::Shortwave, Field::Longwave, Field::AirTemp, Field::Wind, Field::Pressure})
        EXPECT_EQ(toa5.table[f], want.table[f]) << field_info(f).name;
    EXPECT_EQ(toa5.table[Field::Rain][5], want.table[Field::Precip][5]);
}

TEST(PlainTable, NamesWithoutRowsSaySo)
{
    for (const char* text : {"time,air_temp_c,precip_mm\n",
                             "time,air_temp_c,precip_mm\n# nothing yet\n\n", "time;air_temp_c\n"})
        EXPECT_THAT(refusal(text), HasSubstr("no row follows")) << text;
}

TEST(PlainTable, NamesAsProgramsWriteThem)
{
    expect_same(text_of({"Date/Time", "Global Radiation (W/m\u00B2)", "Longwave (W/m2)",
                         "Precipitation (mm)", "Temperature (\u00B0C)", "Relative humidity (%)",
                         "Wind speed (m/s)", "Air pressure (hPa)"},
                        hours()));
    auto names = kNames;
    names[7] += ",Wind Gust (m/s)";
    const auto gust = [](std::size_t i, const std::string& c) { return i == 7 ? c + ",9" : c; };
    expect_same(text_of(names, hours(), ",", gust));
    // Energy of the hour.
    for (const auto& [unit, joule] :
         {std::pair{"kj_m2", 1e3}, {"MJ_m2", 1e6}, {"j_cm2", 1e4}, {"Wh_m2", 3600.0}}) {
        names = kNames;
        names[1] = std::string("solar_radiation_") + unit;
        const double j = joule;
        expect_same(text_of(names, hours(), ",", [&](std::size_t i, const std::string& c) {
            if (i != 1) return c;
            char text[32];
            std::snprintf(text, sizeof text, "%.12g", *to_number(c) * 3600.0 / j);
            return std::string(text);
        }));
    }
}

// The same table with German names, as loggers, offices and spreadsheets there write it.
TEST(PlainTable, GermanNamesAndDecimalCommas)
{
    const auto rows = hours();
    const auto english = read_weather(text_of(kNames, rows), {.fill = false}).table;
    const auto comma = [](std::size_t i, const std::string& cell) {
        std::string text = cell;
        if (i > 0) std::replace(text.begin(), text.end(), '.', ',');
        // 2024-03-26T00:00 as 26.03.2024 00:00
        else
            text = cell.substr(8, 2) + "." + cell.substr(5, 2) + "." + cell.substr(0, 4) + " " + cell.substr(11);
        return text;
    };
    const Row utf8 = {"Datum/Uhrzeit",    "Globalstrahlung [W/m\xC2\xB2]", "Gegenstrahlung (W/m\xC2\xB2)",
                      "Niederschlag [mm]", "Temperatur [\xC2\xB0" "C]",      "rel. Feuchte [%]",
                      "Windgeschwindigkeit (m/s)", "Luftdruck (hPa)"};
    Row names = utf8;
    names[5] = "Relative Luftfeuchte [%]";
    const auto german = read_weather(text_of(names, rows, ";", comma), {.fill = false});
    for (std::size_t f = 0; f < kFieldCount; ++f)
        EXPECT_EQ(german.table.columns[f].size(), english.columns[f].size()) << f;
    ASSERT_EQ(german.table.time_us, english.time_us);
    for (const Field f : {Field::Shortwave, Field::Longwave, Field::Precip, Field::AirTemp,
                          Field::RelHumidity, Field::Wind, Field::Pressure})
        for (std::size_t i = 0; i < english.rows(); ++i)
            ASSERT_NEAR(german.table[f][i], english[f][i], 1e-9) << i;
    // Latin-1, and a date and a clock apart, under names of other units.
    Row latin = names;
    latin[4] = "Lufttemperatur \xB0" "C";
    latin[3] = "Niederschlag l/m\xB2";
    EXPECT_NEAR(read_weather(text_of(latin, rows, ";", comma), {.fill = false}).table[Field::AirTemp][7],
                english[Field::AirTemp][7], 1e-9);
    const std::string apart = "Datum;Zeit;Wind (km/h);Schneeh\xC3\xB6he (cm);Bew\xC3\xB6lkung (Achtel);Regen (mm)\n"
                              "31.01.2024;06:00;7,2;12;4;0,3\n31.01.2024;07:00;10,8;13;8;0,0\n";
    const auto two = read_weather(apart, {.fill = false}).table;
    EXPECT_EQ(two.time_us[1], *us_from_iso("2024-01-31T07:00Z"));
    EXPECT_NEAR(two[Field::Wind][1], 3.0, 1e-9);
    EXPECT_NEAR(two[Field::SnowDepth][0], 0.12, 1e-9);
    EXPECT_NEAR(two[Field::Cloud][0], 0.5, 1e-9);
    EXPECT_NEAR(two[Field::Rain][0] * 3600.0, 0.3, 1e-9);
    // What speaks of weather in German and is not understood is named too.
    try {
        read_weather(text_of(utf8, rows, ";", comma));
        FAIL() << "read";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("not understood: rel. Feuchte [%]"));
    }
}

TEST(PlainTable, RowsInAnyOrderAndTwice)
{
    auto rows = hours();
    std::reverse(rows.begin(), rows.end());
    EXPECT_THAT(expect_same(text_of(kNames, rows)), HasSubstr("the newest row stands first"));
    rows = hours();
    std::rotate(rows.begin() + 50, rows.begin() + 60, rows.begin() + 75);
    EXPECT_THAT(expect_same(text_of(kNames, rows)), HasSubstr("read in the order of their times"));
    std::vector<Row> twice;
    for (const Row& row : hours()) twice.insert(twice.end(), 2, row);
    EXPECT_THAT(expect_same(text_of(kNames, twice)), HasSubstr("240 rows stand in the file again"));
    // One that says something else is no repetition.
    rows = hours();
    rows.insert(rows.begin() + 9, rows[8]);
    rows[9][4] = "9";
    const auto r = read(text_of(kNames, rows));
    EXPECT_EQ(r.report.bad_rows, 1u);
    EXPECT_THAT(to_text(r.report), HasSubstr("duplicate of 2024-03-26T08:00:00Z"));
    // Many are told in one line.
    for (std::size_t i = 20; i < 32; ++i) rows[i][0] = "2024-02-30T00:00";
    const std::string said = to_text(read(text_of(kNames, rows)).report);
    EXPECT_THAT(said, HasSubstr("bad row: 8 more, the last in line 33"));
}

// The clock of Europe: the row after 1 h of 31 March is that of 3 h.
TEST(PlainTable, SummerTimeIsTold)
{
    auto rows = hours();
    const auto change = *us_from_iso("2024-03-31T02:00Z");
    for (Row& row : rows) {
        const auto us = *us_from_iso(row[0]);
        if (us >= change) row[0] = iso_from_us(us + 3600000000LL).substr(0, 16);
    }
    const std::string said = to_text(read(text_of(kNames, rows)).report);
    EXPECT_THAT(said, HasSubstr("skips an hour on 2024-03-31: it seems to keep summer time"));
    // With its offset each time is clear.
    for (Row& row : rows) row[0] += *us_from_iso(row[0]) > change ? "+01:00" : "+00:00";
    EXPECT_THAT(expect_same(text_of(kNames, rows)), Not(HasSubstr("summer time")));
    // Back in autumn: 2 h comes twice.
    rows = hours();
    const auto back = *us_from_iso("2024-10-27T03:00Z");
    for (std::size_t h = 0; h < rows.size(); ++h) {
        const auto us =
            *us_from_iso("2024-10-24T00:00Z") + static_cast<std::int64_t>(h) * 3600000000LL;
        rows[h][0] = iso_from_us(us >= back ? us - 3600000000LL : us).substr(0, 16);
    }
    EXPECT_THAT(to_text(read(text_of(kNames, rows)).report),
                HasSubstr("repeats one on 2024-10-27"));
    // Gaps at other hours, or many, are no clock.
    rows = hours();
    rows.erase(rows.begin() + 40);
    EXPECT_THAT(to_text(read(text_of(kNames, rows)).report), Not(HasSubstr("summer time")));
    rows = hours();
    for (const int h : {200, 150, 128, 122, 77, 40, 20}) rows.erase(rows.begin() + h);
    EXPECT_THAT(to_text(read(text_of(kNames, rows)).report), Not(HasSubstr("summer time")));
}

TEST(PlainTable, WordsAndCodesInPlaceOfNumbers)
{
    // 999 is no humidity; in its row it is no pressure and no sunshine either.
    auto rows = hours();
    for (std::size_t i = 10; i < rows.size(); i += 11)
        for (const std::size_t c : {1, 4, 5, 7}) rows[i][c] = "999";
    const auto coded = read(text_of(kNames, rows));
    for (std::size_t i = 10; i < rows.size(); i += 11) {
        EXPECT_LT(coded.table[Field::Shortwave][i], 700.0);
        EXPECT_LT(coded.table[Field::Pressure][i], 90000.0);
    }
    EXPECT_THAT(to_text(coded.report), testing::AllOf(HasSubstr("'999' means no value, 84 times"),
                                                      Not(HasSubstr("out of range"))));
    rows = hours();
    rows[12][7] = "999.00";
    EXPECT_NEAR(read(text_of(kNames, rows)).table[Field::Pressure][12], 99900.0, 1e-6)
        << "it is one alone";

    rows = hours();
    rows[5][3] = "T";
    rows[6][3] = "trace";
    const auto trace = read(text_of(kNames, rows));
    EXPECT_EQ(trace.table[Field::Precip][5], 0.0);
    EXPECT_THAT(to_text(trace.report),
                testing::AllOf(HasSubstr("'T' is a trace, taken as 0, 1 times"),
                               HasSubstr("precip: 240 read\n")));
    auto names = kNames;
    names[1] = "wind_direction";
    rows = hours();
    for (Row& row : rows) row[1] = "NNW";
    rows[3][1] = "calm";
    rows[4][1] = "W";
    const auto wind = read(text_of(names, rows));
    EXPECT_EQ(wind.table[Field::WindFrom][0], 337.5);
    EXPECT_EQ(wind.table[Field::WindFrom][4], 270.0);
    EXPECT_TRUE(std::isnan(wind.table[Field::WindFrom][3]));
    rows[5][1] = "NNX";
    EXPECT_THAT(to_text(read(text_of(names, rows)).report), HasSubstr("'NNX' is not a number"));
}

// What a unit that was mistaken leaves in the numbers.
TEST(PlainTable, QuantitiesThatContradictEachOtherAreTold)
{
    EXPECT_THAT(to_text(read(usual()).report), Not(HasSubstr("warning")));
    auto rows = hours();
    for (Row& row : rows) row[4] = number(*to_number(row[4]) * 1.8 + 32.0);
    for (Row& row : rows) row[2] = "260";
    EXPECT_THAT(
        to_text(read(text_of(kNames, rows)).report),
        HasSubstr("of what a black body as warm as the air sends while rain or snow falls"));
    rows = hours();
    for (Row& row : rows) row[1] = number(*to_number(row[1]) * 0.0036);
    EXPECT_THAT(to_text(read(text_of(kNames, rows)).report),
                HasSubstr("sw_down: no day has more than"));
    rows.resize(49);  // two days are enough for a thousandth
    EXPECT_THAT(to_text(read(text_of(kNames, rows)).report),
                HasSubstr("sw_down: no day has more than"));
    rows = hours();
    rows.resize(49);
    for (Row& row : rows) row[1] = number(*to_number(row[1]) * 0.05);  // thick cloud
    EXPECT_THAT(to_text(read(text_of(kNames, rows)).report), Not(HasSubstr("no day has more")));
    rows = hours();
    for (Row& row : rows) row[1] = number(*to_number(row[1]) * 3.6);
    EXPECT_THAT(to_text(read(text_of(kNames, rows)).report),
                HasSubstr("every other day has more than"));
    auto names = kNames;
    names[2] = "dew_point_c";
    rows = hours();
    for (Row& row : rows) row[2] = number(*to_number(row[4]) + 3.0);
    EXPECT_THAT(refusal(text_of(names, rows)),
                HasSubstr("the dew point is above the air temperature in 240 of 240"));
    for (Row& row : rows) row[2] = number(*to_number(row[4]) + 0.3);
    EXPECT_EQ(refusal(text_of(names, rows)), "") << "two sensors";
}

}  // namespace
}  // namespace petrichor::weather
