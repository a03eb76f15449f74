// Files of weather archives: each must be recognised by its content and give the numbers that it says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "tests/support/assets.h"
#include "tests/weather/archive_samples.h"
#include "weather/readers/join.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {
namespace {

using namespace archive_samples;
using testing::HasSubstr;

TEST(GlobalHourly, CodedGroups)
{
    const auto [table, report] = sample("noaa_global_hourly.csv");
    EXPECT_EQ(report.format, "NOAA global hourly");
    EXPECT_EQ(report.rows, 4u);
    EXPECT_NEAR(table.site.latitude_deg, 40.7792, 1e-9);
    const std::string first = "2024-01-16T00:51Z";
    EXPECT_NEAR(at(table, Field::AirTemp, first), 273.15, 1e-9);
    EXPECT_NEAR(at(table, Field::DewPoint, first), 270.95, 1e-9);
    EXPECT_NEAR(at(table, Field::Wind, first), 5.7, 1e-9);
    EXPECT_NEAR(at(table, Field::WindFrom, first), 40.0, 1e-9);
    EXPECT_NEAR(at(table, Field::Pressure, first), 101890.0, 1e-6) << "the station's own";
    EXPECT_NEAR(at(table, Field::Cloud, first), 1.0, 1e-9);
    EXPECT_NEAR(at(table, Field::SnowDepth, first), 0.05, 1e-9);
    EXPECT_NEAR(at(table, Field::Visibility, first), 4828.0, 1e-9);
    EXPECT_NEAR(at(table, Field::Wind, "2024-01-16T02:51Z"), 0.0, 1e-9) << "calm";
    EXPECT_NEAR(total(table, Field::Precip), 2.1, 1e-9) << "1.3, a trace and 0.8 mm";
    EXPECT_TRUE(std::isnan(at(table, Field::DewPoint, "2024-01-16T01:51Z"))) << "failed a check";
    EXPECT_THAT(notes(report), HasSubstr("1 sums of days"));
}

// A station that moves has no place: what is lacking is asked for, and nothing that was given.
TEST(GlobalHourly, AsksForWhatOfThePlaceWasNotGiven)
{
    std::string text = text_of(std::filesystem::path(PETRICHOR_SAMPLES) / "noaa_global_hourly.csv");
    const std::string place = "\"40.7792\",\"-73.8800\",\"3.4\"",
                      nowhere = "\"0.0\",\"0.0\",\"7026.0\"";
    ASSERT_NE(text.find(place), std::string::npos);
    for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place))
        text.replace(at, place.size(), nowhere);
    const auto told = [&](const Site& site) {
        ReadOptions options;
        options.site = site;
        return notes(raw(text, options).report);
    };
    EXPECT_THAT(told({}), HasSubstr("warning line 2 place: 0 N 0 E at 7026.0 m is no place of a "
                                    "station: give latitude, longitude, elevation"));
    EXPECT_THAT(told({.latitude_deg = 34.0, .longitude_deg = 69.0}),
                HasSubstr("of a station: give elevation"));
    EXPECT_THAT(told({.latitude_deg = 34.0, .longitude_deg = 69.0, .elevation_m = 1500.0}),
                HasSubstr("info line 2 place: 0 N 0 E at 7026.0 m is no place of a station: that "
                          "which is given is taken"));
}

TEST(GlobalHourly, PresentWeatherTellsThePhase)
{
    const auto table = sample("noaa_global_hourly.csv").table;
    const std::size_t snow = row_at(table, "2024-01-16T00:51Z");
    ASSERT_GT(snow, 0u);
    EXPECT_EQ(table[Field::SnowShare][snow - 1], 1.0) << "of the hour before the report";
    const std::size_t rain = row_at(table, "2024-01-16T02:51Z");
    EXPECT_EQ(table[Field::SnowShare][rain - 1], 0.0);
}

TEST(GlobalHourly, RemarksFillWhatTheCodesLack)
{
    const auto table =
        raw("\"STATION\",\"DATE\",\"LATITUDE\",\"LONGITUDE\",\"ELEVATION\",\"NAME\",\"REPORT_"
            "TYPE\",\"WND\",\"VIS\",\"TMP\",\"DEW\",\"SLP\",\"REM\"\n"
            "\"1\",\"2024-01-16T00:51:00\",\"40\",\"-73\",\"3\",\"X\",\"FM-15\",\"040,5,N,0057,5\","
            "\"004828,5,N,5\",\"+9999,9\",\"+9999,9\",\"99999,9\",\"MET105 METAR KLGA 160051Z "
            "04011KT 3SM -SN BKN021 M05/M07 A3011\"\n")
            .table;
    EXPECT_NEAR(table[Field::AirTemp].back(), 268.15, 1e-9);
    EXPECT_NEAR(table[Field::Cloud].back(), 0.75, 0.15);
    EXPECT_NEAR(table[Field::Precip].back() * 3600.0, 0.5, 1e-9) << "light snow, no amounts";
    EXPECT_EQ(table[Field::SnowShare].back(), 1.0);
}

TEST(GlobalHourly, ARealYear)
{
    NEED_ASSETS(assets);
    const std::string text =
        text_of(assets / "weather/real_files/noaa_global_hourly_00702699999.csv");
    ReadOptions options;
    options.site = {.latitude_deg = 34.0, .longitude_deg = 69.0, .elevation_m = 1500.0};
    const auto begin = std::chrono::steady_clock::now();
    const auto [table, report] = read_weather(text, options);
    const double ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    EXPECT_EQ(report.format, "NOAA global hourly");
    EXPECT_GT(report.rows, 6000u);
    EXPECT_EQ(report.bad_rows, 0u);
    EXPECT_LT(report.notes.size(), 60u) << to_text(report);
    RecordProperty("milliseconds", std::to_string(ms));
}

TEST(Isd, FixedColumnsSayTheSameAsTheTable)
{
    const auto [table, report] = sample("isd_full.txt");
    EXPECT_EQ(report.format, "ISD");
    const std::string first = "2024-01-16T00:51Z";
    EXPECT_NEAR(at(table, Field::AirTemp, first), 273.15, 1e-9);
    EXPECT_NEAR(at(table, Field::Wind, first), 5.7, 1e-9);
    EXPECT_NEAR(at(table, Field::Pressure, first), 101890.0, 1e-6);
    EXPECT_NEAR(at(table, Field::SnowDepth, first), 0.05, 1e-9);
    EXPECT_NEAR(total(table, Field::Precip), 2.1, 1e-9);
    EXPECT_NEAR(table.site.longitude_deg, -73.88, 1e-9);
    EXPECT_NEAR(table.site.elevation_m, 3.0, 1e-9);
}

TEST(Uscrn, HourlyAndFiveMinutes)
{
    const auto [hourly, report] = sample("uscrn_hourly.txt");
    EXPECT_EQ(report.format, "USCRN");
    EXPECT_NEAR(at(hourly, Field::AirTemp, "2024-01-16T01:00Z"), 269.75, 1e-9);
    EXPECT_NEAR(at(hourly, Field::SurfaceTemp, "2024-01-16T01:00Z"), 269.05, 1e-9);
    EXPECT_TRUE(std::isnan(at(hourly, Field::AirTemp, "2024-01-16T03:00Z")));
    EXPECT_NEAR(total(hourly, Field::Precip), 1.7, 1e-9);
    EXPECT_EQ(hourly.site.utc_offset_h, -5.0);
    const auto fine = sample("uscrn_5min.txt").table;
    EXPECT_NEAR(at(fine, Field::Wind, "2024-01-16T00:05Z"), 1.53, 1e-9);
    EXPECT_NEAR(total(fine, Field::Precip), 0.2, 1e-9);
}

TEST(Umep, ColumnsOfTheUrbanModels)
{
    const auto [table, report] = sample("umep.txt");
    EXPECT_EQ(report.format, "UMEP");
    EXPECT_EQ(report.rows, 5u) << "-9 ends the file";
    EXPECT_EQ(report.bad_rows, 0u);
    // The 60th day of 2024 is 29 February.
    const std::string first = "2024-02-29T01:00Z";
    EXPECT_NEAR(at(table, Field::AirTemp, first), 271.55, 1e-9) << "Td is the air";
    EXPECT_FALSE(table.has(Field::DewPoint));
    EXPECT_NEAR(at(table, Field::Pressure, first), 98700.0, 1e-6);
    EXPECT_NEAR(at(table, Field::Wind, first), 2.4, 1e-9);
    EXPECT_NEAR(at(table, Field::WindFrom, first), 212.0, 1e-9);
    EXPECT_TRUE(std::isnan(at(table, Field::Longwave, first)));
    EXPECT_NEAR(at(table, Field::Cloud, first), 1.0, 1e-9);
    EXPECT_NEAR(total(table, Field::Precip), 1.8, 1e-9);
    EXPECT_NEAR(at(table, Field::Direct, "2024-02-29T10:00Z"), 320.0, 1e-9)
        << "means of the hours around";
    EXPECT_THAT(to_text(report), HasSubstr("not read: lai_hr"));
    EXPECT_THAT(to_text(report), HasSubstr("--file-zone"));
    ReadOptions options;
    options.utc_offset_h = 1.0;
    EXPECT_NEAR(at(sample("umep.txt", options).table, Field::AirTemp, "2024-02-29T00:00Z"), 271.55,
                1e-9);
    std::string odd = text_of(std::filesystem::path(PETRICHOR_SAMPLES) / "umep.txt");
    odd.replace(odd.find("2024 60 1"), 9, "2023 366 1");
    EXPECT_EQ(raw(odd).report.bad_rows, 1u) << "2023 has no 366th day";
}

TEST(Lcd, BothSystemsOfUnits)
{
    const auto [table, report] = sample("lcd.csv");
    EXPECT_EQ(report.format, "LCD");
    EXPECT_EQ(report.rows, 3u) << "the sum of the day is none";
    const std::string first = "2024-01-16T00:51Z";  // 19:51 in New York
    EXPECT_NEAR(at(table, Field::AirTemp, first), 273.15, 1e-9);
    EXPECT_NEAR(at(table, Field::Wind, first), 11 * 0.44704, 1e-9);
    EXPECT_NEAR(at(table, Field::Pressure, first), 30.09 * 3386.389, 1e-3);
    EXPECT_NEAR(total(table, Field::Precip), 0.07 * 25.4, 1e-9);
    const auto metric = sample("lcd_metric.csv").table;
    EXPECT_NEAR(at(metric, Field::AirTemp, first), 273.15, 1e-9);
    EXPECT_NEAR(at(metric, Field::Pressure, first), 101890.0, 1e-6);
    EXPECT_NEAR(at(metric, Field::Wind, first), 5.7, 1e-9);
    EXPECT_NEAR(total(metric, Field::Precip), 1.3, 1e-9);
}

TEST(GhcnHourly, ValuesQualityAndSky)
{
    const auto [table, report] = sample("ghcn_hourly.psv");
    EXPECT_EQ(report.format, "GHCN hourly");
    const std::string first = "2024-01-16T00:51Z";
    EXPECT_NEAR(at(table, Field::AirTemp, first), 273.15, 1e-9);
    EXPECT_NEAR(at(table, Field::Pressure, first), 101890.0, 1e-6);
    EXPECT_NEAR(at(table, Field::SnowDepth, first), 0.05, 1e-9);
    EXPECT_NEAR(at(table, Field::Cloud, "2024-01-16T02:51Z"), 0.4375, 1e-9);
    EXPECT_TRUE(std::isnan(at(table, Field::DewPoint, "2024-01-16T01:51Z"))) << "quality 3";
    EXPECT_NEAR(at(table, Field::Pressure, "2024-01-16T02:51Z"),
                station_pressure_pa(101830.0, 3.4, 274.25), 1e-6);
    EXPECT_NEAR(total(table, Field::Precip), 2.1, 1e-9);
}

TEST(Dwd, FilesOfOneQuantityAreJoined)
{
    const std::string temperature = text_of(PETRICHOR_SAMPLES "/dwd_temperature.txt"),
                      rain = text_of(PETRICHOR_SAMPLES "/dwd_precipitation.txt");
    ReadOptions options;
    options.fill = false;
    const auto [table, report] =
        read_weather_files({{"tu.txt", temperature}, {"rr.txt", rain}}, options);
    EXPECT_EQ(report.format, "DWD");
    EXPECT_NEAR(at(table, Field::AirTemp, "2024-01-19T00:00Z"), 271.25, 1e-9);
    EXPECT_NEAR(at(table, Field::RelHumidity, "2024-01-19T03:00Z"), 98.0, 1e-9);
    EXPECT_NEAR(total(table, Field::Precip), 1.5, 1e-9);
    EXPECT_EQ(at(table, Field::SnowShare, "2024-01-19T00:00Z"), 1.0) << "WRTR 7, the hour before 1";
    EXPECT_EQ(at(table, Field::SnowShare, "2024-01-19T02:00Z"), 0.0);
    const auto fine = sample("dwd_10min.txt").table;
    EXPECT_NEAR(at(fine, Field::Pressure, "2024-01-01T00:10Z"), 97030.0, 1e-6);
}

TEST(Join, FilesThatOverlapAndSayTheSameThingAreRefused)
{
    const std::string one = text_of(PETRICHOR_SAMPLES "/dwd_temperature.txt");
    try {
        read_weather_files({{"a.txt", one}, {"b.txt", one}});
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("air_temp"));
    }
}

TEST(Meteostat, SnowIsADepth)
{
    const auto [table, report] = sample("meteostat.csv");
    EXPECT_EQ(report.format, "Meteostat");
    EXPECT_FALSE(table.has(Field::Snow)) << "20 mm of depth are no snowfall";
    EXPECT_NEAR(at(table, Field::SnowDepth, "2025-01-11T09:00Z"), 0.020, 1e-12);
    EXPECT_NEAR(at(table, Field::Wind, "2025-01-11T09:00Z"), 10.0, 1e-9);
    EXPECT_NEAR(total(table, Field::Precip), 5.8, 1e-9);
    EXPECT_EQ(table[Field::SnowShare].front(), 1.0) << "coco 15";
    const auto bulk = sample("meteostat_bulk.csv").table;
    EXPECT_NEAR(at(bulk, Field::AirTemp, "2025-01-11T06:00Z"), 272.55, 1e-9);
}

TEST(EnvironmentCanada, LocalStandardTimeAndUnitsInUtf8)
{
    const auto [table, report] = sample("environment_canada.csv");
    EXPECT_EQ(report.format, "Environment Canada");
    EXPECT_EQ(table.site.utc_offset_h, -5.0);
    const std::string midnight = "2024-01-09T05:00Z";
    EXPECT_NEAR(at(table, Field::AirTemp, midnight), 270.05, 1e-9);
    EXPECT_NEAR(at(table, Field::Pressure, midnight), 100910.0, 1e-6);
    EXPECT_NEAR(at(table, Field::WindFrom, midnight), 90.0, 1e-9);
    EXPECT_NEAR(at(table, Field::Wind, midnight), 5.0, 1e-9);
    EXPECT_NEAR(total(table, Field::Precip), 1.2, 1e-9);
    EXPECT_EQ(table[Field::SnowShare][row_at(table, "2024-01-09T06:00Z") - 1], 1.0);
}

// The sample with its columns in another order: names and cells, or the names alone.
std::string reordered(const std::string& text, std::size_t turn, bool cells_too)
{
    std::string out;
    Lines lines(text);
    while (const auto line = lines.next()) {
        const auto fields = split(*line, ',');
        for (std::size_t i = 0; i < fields.size(); ++i) {
            const bool turned = cells_too || lines.number() == 1;
            out += std::string(i ? "," : "") + "\"" +
                   std::string(fields[turned ? (i * 7 + turn) % fields.size() : i]) + "\"";
        }
        out += "\n";
    }
    return out;
}

TEST(EnvironmentCanada, ColumnsAreFoundByNameAndNamesElsewhereAreSaid)
{
    const std::string text =
        text_of(std::filesystem::path(PETRICHOR_SAMPLES) / "environment_canada.csv");
    const auto plain = read_weather(text, {});
    for (std::size_t turn = 0; turn < 31; ++turn) {
        const auto r = read_weather(reordered(text, turn, true), {});
        EXPECT_EQ(r.table.time_us, plain.table.time_us) << turn;
        for (const Field f : {Field::AirTemp, Field::Wind, Field::Precip, Field::Pressure})
            EXPECT_EQ(r.table[f], plain.table[f]) << turn;
    }
    for (std::size_t turn = 1; turn < 31; ++turn) {
        try {
            read_weather(reordered(text, turn, false), {});
            ADD_FAILURE() << turn << ": read";
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("columns hold what their names do not say: '"))
                << turn;
            EXPECT_THAT(error.what(), HasSubstr("' holds ")) << turn;
        }
    }
    // One sensor that fails is no reordering: it is what the usual report is for.
    std::string broken = text;
    for (std::size_t at; (at = broken.find("\"87\"")) != std::string::npos;)
        broken.replace(at, 4, "\"xx\"");
    EXPECT_NO_THROW(read_weather(broken, {}));
}

TEST(Iem, TableOfAnAirport)
{
    const auto [table, report] = sample("iem_asos.csv");
    EXPECT_EQ(report.format, "IEM");
    const std::string first = "2024-01-16T00:51Z";
    EXPECT_NEAR(at(table, Field::AirTemp, first), 273.15, 1e-9);
    EXPECT_NEAR(at(table, Field::Wind, first), 11 * 1852.0 / 3600.0, 1e-9);
    EXPECT_NEAR(at(table, Field::SnowDepth, first), 0.0508, 1e-9);
    EXPECT_NEAR(total(table, Field::Precip), 0.08 * 25.4, 1e-9);
    EXPECT_NEAR(table.site.latitude_deg, 40.7792, 1e-9);
}

TEST(Midc, ColumnsByTheirWordsAndUnits)
{
    const auto [table, report] = sample("midc.csv");
    EXPECT_EQ(report.format, "MIDC");
    const std::string noon = "2024-02-03T19:00Z";
    EXPECT_NEAR(at(table, Field::Shortwave, noon), 310.2, 1e-9);
    EXPECT_NEAR(at(table, Field::Direct, noon), 12.1, 1e-9);
    EXPECT_NEAR(at(table, Field::AirTemp, noon), 274.35, 1e-9);
    EXPECT_NEAR(at(table, Field::SnowDepth, noon), 0.04, 1e-9);
    EXPECT_NEAR(total(table, Field::Precip), 0.2, 1e-6) << "the counter went from 1.2 to 1.4 mm";
    EXPECT_THAT(notes(report), HasSubstr("li-200"));
}

TEST(PvgisJson, TypicalYear)
{
    const auto [table, report] = sample("pvgis.json");
    EXPECT_EQ(report.format, "PVGIS JSON");
    EXPECT_TRUE(report.typical_year);
    EXPECT_EQ(table.site.elevation_m, 250.0);
    EXPECT_NEAR(at(table, Field::AirTemp, "2015-01-01T10:00Z"), 272.44, 1e-9);
    EXPECT_NEAR(at(table, Field::Pressure, "2015-01-01T10:00Z"), 99800.0, 1e-9);
}

TEST(Tmy2, FixedColumns)
{
    const auto [table, report] = sample("typical_year_tmy2.tm2");
    EXPECT_EQ(report.format, "TMY2");
    EXPECT_TRUE(report.typical_year);
    EXPECT_NEAR(table.site.latitude_deg, 42.0 + 22.0 / 60.0, 1e-9);
    EXPECT_NEAR(table.site.longitude_deg, -(71.0 + 2.0 / 60.0), 1e-9);
    const std::string noon = "1962-01-01T17:00Z";
    EXPECT_NEAR(at(table, Field::AirTemp, noon), 268.15, 1e-9);
    EXPECT_NEAR(at(table, Field::Pressure, noon), 101000.0, 1e-6);
    EXPECT_NEAR(at(table, Field::Wind, noon), 5.7, 1e-9);
    EXPECT_NEAR(at(table, Field::SnowDepth, noon), 0.08, 1e-9);
    EXPECT_NEAR(at(table, Field::Cloud, noon), 0.5, 1e-9);
}

TEST(Wea, SunOfADay)
{
    const auto [table, report] = sample("sun.wea");
    EXPECT_EQ(report.format, "WEA");
    EXPECT_NEAR(table.site.longitude_deg, -71.02, 1e-9) << "west is positive in the file";
    EXPECT_NEAR(at(table, Field::Direct, "2019-01-01T16:30Z"), 300.0, 1e-9);
    const double flat = at(table, Field::Shortwave, "2019-01-01T16:30Z");
    EXPECT_GT(flat, 120.0 + 300.0 * 0.38);
    EXPECT_LT(flat, 120.0 + 300.0 * 0.42);
}

TEST(ForcingCsv, CommentsSayThePlace)
{
    const auto [table, report] = sample("place_in_comments.csv");
    EXPECT_EQ(table.site.elevation_m, 1325.0);
    EXPECT_NEAR(table[Field::SurfaceTemp].front(), 271.15, 1e-9);
    EXPECT_THAT(notes(report), HasSubstr("made by hand"));
}

}  // namespace
}  // namespace petrichor::weather
