// ISD-Lite, GHCN-daily and SURFRAD: no real file is at hand, so rows are made up after the official
// descriptions (isd-lite-format.txt, GHCN-Daily readme.txt, the SURFRAD README): codes, scales,
// flags, traces, totals of several hours and days, headings between days.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <string>
#include <utility>

#include "base/error.h"
#include "tests/weather/reading.h"
#include "weather/physics/constants.h"
#include "weather/readers/read_weather.h"
#include "weather/readers/text.h"

namespace petrichor::weather {
namespace {

using namespace testing_reading;

// The value at a time of a row; NaN without such a row.
double value(const ForcingTable& t, Field f, const char* iso)
{
    const std::int64_t us = us_from_iso(iso).value();
    for (std::size_t i = 0; i < t.rows(); ++i) {
        if (t.time_us[i] == us) return t[f][i];
    }
    return kMissing;
}

bool says(const ReadReport& report, const char* text)
{
    return to_text(report).find(text) != std::string::npos;
}

const ReadOptions kPlace{.site = {.latitude_deg = 50, .longitude_deg = 8, .elevation_m = 100}};

// ---- ISD-Lite

TEST(IsdLite, MissingTraceAndSixHours)
{
    const std::string text =
        "2020 01 01 00   -50   -70 10200   180    30     8     0 -9999\n"
        "2020 01 01 01   -52   -72 10201   180    31     4    -1 -9999\n"
        "2020 01 01 02 -9999   -72 10201   180    31     4    12 -9999\n"
        "2020 01 01 06   -40   -60 10190   190    40     0 -9999    50\n";
    const auto r =
        read_weather(text, {.site = {.latitude_deg = 50, .longitude_deg = 8, .elevation_m = 100}});
    EXPECT_EQ(r.report.format, "ISD-Lite");
    EXPECT_NEAR(sum_mm(r.table, Field::Precip), 5.0, 1e-6);
    EXPECT_NE(to_text(r.report).find("gap from"), std::string::npos);
    expect_complete(r.table);
    EXPECT_LT(r.table[Field::Pressure][1], 101000);
}

// As a file of the archive: blanks, scales of 10, -9999 in every field once.
TEST(IsdLite, RowsOfTheArchive)
{
    const auto r = read_weather(
        "2021 02 09 06   -83   -97 10132   350    51     8 -9999 -9999\n"
        "2021 02 09 07 -9999 -9999 -9999 -9999 -9999 -9999 -9999 -9999\n"
        "2021 02 09 08   -89  -103 10139     0     0     2     3 -9999\n",
        {.site = kPlace.site, .fill = false});
    EXPECT_NEAR(value(r.table, Field::AirTemp, "2021-02-09T06:00Z"), 273.15 - 8.3, 1e-9);
    EXPECT_NEAR(value(r.table, Field::DewPoint, "2021-02-09T08:00Z"), 273.15 - 10.3, 1e-9);
    EXPECT_NEAR(value(r.table, Field::Wind, "2021-02-09T06:00Z"), 5.1, 1e-9);
    EXPECT_NEAR(value(r.table, Field::WindFrom, "2021-02-09T08:00Z"), 0.0, 1e-9);  // calm
    EXPECT_NEAR(value(r.table, Field::Cloud, "2021-02-09T08:00Z"), 0.25, 1e-9);
    EXPECT_NEAR(value(r.table, Field::Pressure, "2021-02-09T06:00Z"), 100010.0, 40.0);
    for (const Field f : {Field::AirTemp, Field::DewPoint, Field::Pressure, Field::Wind,
                          Field::WindFrom, Field::Cloud})
        EXPECT_TRUE(std::isnan(value(r.table, f, "2021-02-09T07:00Z"))) << field_info(f).name;
    // 0.3 mm in the hour that ends at 08.
    EXPECT_NEAR(value(r.table, Field::Precip, "2021-02-09T07:00Z") * 3600.0, 0.3, 1e-9);
}

TEST(IsdLite, SkyCodes)
{
    const std::pair<int, double> cases[] = {{0, 0.0},   {1, 0.125}, {4, 0.5},   {7, 0.875},
                                            {8, 1.0},   {9, 1.0},   {11, 0.44}, {12, 0.44},
                                            {13, 0.44}, {14, 0.75}, {15, 0.75}, {16, 0.75},
                                            {17, 1.0},  {18, 1.0},  {19, 1.0}};
    for (const auto& [code, cloud] : cases) {
        char row[120];
        std::snprintf(row, sizeof row,
                      "2020 01 01 00    50    20 10200   180    30 %5d -9999 -9999\n", code);
        const auto r = read_weather(row, {.site = kPlace.site, .fill = false});
        EXPECT_NEAR(r.table[Field::Cloud][0], cloud, 1e-9) << code;
    }
    const auto hidden = read_weather(
        "2020 01 01 00    50    20 10200   180    30    10 -9999 -9999\n"
        "2020 01 01 01    50    20 10200   180    30 -9999 -9999 -9999\n",
        {.site = kPlace.site, .fill = false});
    EXPECT_TRUE(!hidden.table.has(Field::Cloud) || std::isnan(hidden.table[Field::Cloud][0]));
}

// Hours of their own stay; the six-hour total fills the rest of its time.
TEST(IsdLite, SixHourTotalsFillWhatTheHoursLeaveOpen)
{
    std::string text;
    const int hours[] = {-9999, 10, -1, -9999, -9999, 5, -9999};
    for (int h = 0; h <= 6; ++h) {
        char row[120];
        std::snprintf(row, sizeof row,
                      "2020 03 01 %02d    50    20 10200   180    30     8 %5d %5d\n", h, hours[h],
                      h == 6 ? 60 : -9999);
        text += row;
    }
    const auto r = read_weather(text, kPlace);
    EXPECT_NEAR(sum_mm(r.table, Field::Precip), 6.0, 1e-9);
    EXPECT_NEAR(value(r.table, Field::Precip, "2020-03-01T00:00Z") * 3600.0, 1.0, 1e-9);
    EXPECT_NEAR(value(r.table, Field::Precip, "2020-03-01T01:00Z") * 3600.0, 0.0, 1e-9);  // trace
    EXPECT_NEAR(value(r.table, Field::Precip, "2020-03-01T02:00Z") * 3600.0, 1.5, 1e-9);
    EXPECT_NEAR(value(r.table, Field::Precip, "2020-03-01T04:00Z") * 3600.0, 0.5, 1e-9);
    EXPECT_TRUE(says(r.report, "1 traces (-1), taken as 0")) << to_text(r.report);
}

// ---- GHCN-daily

// A day is read as eight rows; without shortwave they are divided into hours.
constexpr std::size_t kHours = 3;

TEST(Ghcn, FixedColumnsAndTables)
{
    std::string dly;
    const auto line = [&](const char* element, std::initializer_list<int> values) {
        char head[32];
        std::snprintf(head, sizeof head, "USC00012345202001%s", element);
        dly += head;
        int n = 0;
        for (int v : values) {
            char cell[16];
            std::snprintf(cell, sizeof cell, "%5d   ", v);
            dly += cell;
            ++n;
        }
        for (; n < 31; ++n) dly += "-9999   ";
        dly += "\n";
    };
    line("TMAX", {50, 60, 20});
    line("TMIN", {-50, -10, -30});
    line("PRCP", {0, 123, 5});
    const auto r = read_weather(
        dly, {.site = {.latitude_deg = 40, .longitude_deg = -105, .elevation_m = 1600}});
    EXPECT_EQ(r.report.format, "GHCN-daily");
    EXPECT_EQ(r.table.rows(), 24 * kHours);
    EXPECT_NEAR(r.table[Field::AirTemp][2 * kHours], 268.15, 1e-9);  // 06 local
    EXPECT_NEAR(r.table[Field::AirTemp][5 * kHours], 278.15, 1e-9);  // 15 local
    EXPECT_NEAR(r.table[Field::Precip][9 * kHours] * 86400, 12.3, 1e-9);
    const auto t = read_weather(
        "USC00012345,20200101,TMAX,50,,,7,\nUSC00012345,20200101,TMIN,-50,,,7,\nUSC00012345,"
        "20200101,PRCP,20,,,7,\n");
    EXPECT_EQ(t.report.format, "GHCN-daily");
    EXPECT_EQ(t.table.rows(), 8 * kHours);
    expect_complete(t.table);
}

// One line of a .dly file; a value may carry its three flags.
std::string dly_line(const char* element, std::initializer_list<std::pair<int, const char*>> values)
{
    std::string text = std::string("CH000006660202102") + element;
    int n = 0;
    for (const auto& [v, flags] : values) {
        char cell[16];
        std::snprintf(cell, sizeof cell, "%5d%s", v, flags);
        text += cell;
        ++n;
    }
    for (; n < 31; ++n) text += "-9999   ";
    return text + "\n";
}

TEST(Ghcn, FlagsTracesAndUnits)
{
    const auto r =
        read_weather(dly_line("TMAX", {{-22, "  E"}, {999, " XE"}, {31, "  E"}}) +
                         dly_line("TMIN", {{-101, "  E"}, {-90, "  E"}, {-15, "  E"}}) +
                         dly_line("PRCP", {{0, "T E"}, {254, "  E"}, {38, "B E"}}) +
                         dly_line("SNWD", {{1220, "  E"}, {-9999, "   "}, {1300, "  E"}}) +
                         dly_line("WT01", {{1, "  E"}}),
                     kPlace);
    // The second day's maximum failed a check: it swings no higher than its minimum.
    EXPECT_EQ(r.table.rows(), 24 * kHours);
    EXPECT_NEAR(r.table[Field::AirTemp][5 * kHours], 273.15 - 2.2, 1e-9);
    EXPECT_NEAR(r.table[Field::AirTemp][13 * kHours], 273.15 - 9.0, 1e-9);
    EXPECT_NEAR(r.table[Field::Precip][0], 0.0, 1e-15);
    EXPECT_NEAR(r.table[Field::Precip][8 * kHours] * 86400.0, 25.4, 1e-9);
    EXPECT_NEAR(r.table[Field::SnowDepth][0], 1.22, 1e-9);
    EXPECT_TRUE(std::isnan(r.table[Field::SnowDepth][8 * kHours]));
}

TEST(Ghcn, TotalsOfSeveralDaysAreShared)
{
    const std::string temperatures =
        dly_line("TMAX", {{50, "   "}, {50, "   "}, {50, "   "}, {50, "   "}}) +
        dly_line("TMIN", {{10, "   "}, {10, "   "}, {10, "   "}, {10, "   "}});
    const auto r = read_weather(
        temperatures +
            dly_line("PRCP", {{20, "   "}, {-9999, "   "}, {-9999, "   "}, {-9999, "   "}}) +
            dly_line("MDPR", {{-9999, "   "}, {-9999, "   "}, {-9999, "   "}, {300, "   "}}) +
            dly_line("DAPR", {{-9999, "   "}, {-9999, "   "}, {-9999, "   "}, {3, "   "}}),
        kPlace);
    EXPECT_NEAR(r.table[Field::Precip][0] * 86400.0, 2.0, 1e-9);
    for (const std::size_t day : {1u, 2u, 3u})
        EXPECT_NEAR(r.table[Field::Precip][day * 8 * kHours] * 86400.0, 10.0, 1e-9) << day;
    EXPECT_TRUE(says(r.report, "1 totals of several days shared"));
    const auto unknown =
        read_weather(temperatures + dly_line("MDPR", {{-9999, "   "}, {300, "   "}}), kPlace);
    EXPECT_TRUE(says(unknown.report, "without their number (DAPR), not used"));
}

TEST(Ghcn, AccessTablesHonourTheirFlags)
{
    const std::string head =
        "\"STATION\",\"DATE\",\"LATITUDE\",\"LONGITUDE\",\"ELEVATION\",\"NAME\",\"PRCP\","
        "\"PRCP_ATTRIBUTES\",\"TMAX\",\"TMAX_ATTRIBUTES\",\"TMIN\",\"TMIN_ATTRIBUTES\"\n";
    const std::string place = "\"46.8\",\"9.8\",\"1560.0\",\"DAVOS, SZ\",";
    const auto r = read_weather(head + "\"SZ000009480\",\"2021-01-14\"," + place +
                                "\"  312\",\",,E\",\"  -20\",\",,E\",\" -105\",\",,E\"\n" +
                                "\"SZ000009480\",\"2021-01-15\"," + place +
                                "\" 9990\",\",X,E\",\"  -31\",\",,E\",\" -142\",\",,E\"\n");
    EXPECT_NEAR(r.table.site.elevation_m, 1560.0, 1e-9);
    EXPECT_NEAR(r.table[Field::Precip][0] * 86400.0, 31.2, 1e-9);
    EXPECT_NEAR(r.table[Field::Precip][8 * kHours], 0.0,
                1e-15);  // failed its check: as if not given
    EXPECT_NEAR(r.table[Field::AirTemp][2 * kHours], 273.15 - 10.5, 1e-9);
}

TEST(Ghcn, OrderedTablesInOtherUnits)
{
    const std::string head = "STATION,DATE,PRCP,TMAX,TMIN\n";
    const auto metric =
        read_weather(head + "USW1,2021-01-14,3.1,-2.0,-10.5\nUSW1,2021-01-15,0.0,1.5,-4.2\n");
    EXPECT_NEAR(metric.table[Field::Precip][0] * 86400.0, 3.1, 1e-9);
    EXPECT_NEAR(metric.table[Field::AirTemp][2 * kHours], 273.15 - 10.5, 1e-9);
    EXPECT_TRUE(says(metric.report, "taken as C, mm and m/s"));
    try {
        read_weather(head + "USW1,2021-01-14,0.12,28,13\nUSW1,2021-01-15,0.00,35,24\n");
        FAIL() << "inches and Fahrenheit";
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("inches and Fahrenheit"), std::string::npos);
    }
}

// ---- SURFRAD

TEST(Surfrad, Rows)
{
    std::string text = " Bondville\n   40.05  88.37  230 m version 1\n";
    for (int minute = 0; minute < 5; ++minute) {
        text += "2020 1 1 1 18 " + std::to_string(minute) + " 18.0 65.0";
        const double values[] = {400.5, 80,  500, 100, 250.5, 270,  270, 300, 272, 272,
                                 0,     150, 320, -50, 270,   -2.5, 80,  4.2, 270, 990.1};
        for (double v : values) text += " " + std::to_string(v) + " 0";
        text += "\n";
    }
    const auto r = read_weather(text);
    EXPECT_EQ(r.report.format, "SURFRAD");
    EXPECT_EQ(r.table.rows(), 5u);
    EXPECT_NEAR(r.table.site.longitude_deg, -88.37, 1e-9);
    EXPECT_NEAR(r.table[Field::Shortwave][0], 400.5, 1e-9);
    EXPECT_NEAR(r.table[Field::Longwave][0], 250.5, 1e-9);
    EXPECT_NEAR(r.table[Field::AirTemp][0], 270.65, 1e-9);
    EXPECT_NEAR(r.table[Field::Pressure][0], 99010, 1e-6);
}

// A row with one value replaced: `place` counts the 20 pairs of value and quality.
std::string surfrad_row(int day, int hour, int minute, int place = -1, const char* pair = "")
{
    char head[80];
    std::snprintf(head, sizeof head, " 2008 %3d  1 %2d %2d %2d %6.3f  65.31", day, day, hour,
                  minute, hour + minute / 60.0);
    const char* values[] = {"400.5 0", "80.2 0",  "500.1 0", "100.4 0", "250.5 0",
                            "270.1 0", "270.3 0", "300.9 0", "272.2 0", "272.4 0",
                            "11.2 0",  "150.6 0", "320.3 0", "-50.4 0", "269.9 0",
                            "-2.5 0",  "80.1 0",  "4.2 0",   "271.3 0", "990.1 0"};
    std::string row = head;
    for (int i = 0; i < 20; ++i) row += std::string("  ") + (i == place ? pair : values[i]);
    return row + "\n";
}

TEST(Surfrad, QualityAndMissingCodes)
{
    const std::string head = " Boulder\n   40.13 -105.24 1689 m version 1\n";
    const auto r = read_weather(head + surfrad_row(1, 18, 0, 0, "-9999.9 1") +
                                    surfrad_row(1, 18, 3, 4, "251.0 2") +
                                    surfrad_row(1, 18, 6, 15, "60.0 1") + surfrad_row(1, 18, 9),
                                {.fill = false});
    EXPECT_EQ(r.table.rows(), 4u);
    EXPECT_EQ(r.table.time_us[1] - r.table.time_us[0], 180000000);
    EXPECT_TRUE(std::isnan(r.table[Field::Shortwave][0]));
    EXPECT_TRUE(std::isnan(r.table[Field::Longwave][1]));
    EXPECT_TRUE(std::isnan(r.table[Field::AirTemp][2]));
    EXPECT_NEAR(r.table[Field::Shortwave][3], 400.5, 1e-9);
    EXPECT_NEAR(r.table[Field::Direct][3], 500.1, 1e-9);
    EXPECT_NEAR(r.table[Field::Diffuse][3], 100.4, 1e-9);
    EXPECT_NEAR(r.table[Field::RelHumidity][3], 80.1, 1e-9);
    EXPECT_NEAR(r.table[Field::Wind][3], 4.2, 1e-9);
    EXPECT_NEAR(r.table[Field::WindFrom][3], 271.3, 1e-9);
    EXPECT_EQ(r.table.site.temp_height_m, 10.0);
    EXPECT_EQ(r.report.bad_rows, 0u);
}

TEST(Surfrad, DaysInOneFileKeepTheirHeadings)
{
    const std::string head = " Boulder\n   40.13 -105.24 1689 m version 1\n";
    std::string text;
    for (int day = 1; day <= 3; ++day) {
        text += head;
        for (int minute = 0; minute < 1440; minute += 3)
            text += surfrad_row(day, minute / 60, minute % 60);
    }
    const auto r = read_weather(text);
    EXPECT_EQ(r.table.rows(), 3u * 480u);
    EXPECT_EQ(r.report.bad_rows, 0u);
    expect_complete(r.table);
}

}  // namespace
}  // namespace petrichor::weather
