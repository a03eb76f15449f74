// Files of weather archives: a small sample of each lies in the corpus of the fuzzer, laid out as
// the archive does. Each must be recognised by its content and give the numbers that it says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "base/error.h"
#include "tests/support/assets.h"
#include "weather/readers/join.h"
#include "weather/readers/read_weather.h"
#include "weather/readers/tables.h"
#include "weather/readers/text.h"
#include "weather/text/utf16.h"

namespace petrichor::weather {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string text_of(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    EXPECT_TRUE(in) << file;
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

ReadResult raw(const std::string& text, ReadOptions options = {})
{
    options.fill = false;
    return read_weather(text, options);
}
ReadResult sample(const std::string& name, const ReadOptions& options = {})
{
    return raw(text_of(std::filesystem::path(PETRICHOR_SAMPLES) / name), options);
}

// Row of a time, or the number of rows.
std::size_t row_at(const ForcingTable& table, const std::string& iso)
{
    const std::int64_t us = us_from_iso(iso).value();
    return static_cast<std::size_t>(std::find(table.time_us.begin(), table.time_us.end(), us) -
                                    table.time_us.begin());
}
double at(const ForcingTable& table, Field field, const std::string& iso)
{
    const std::size_t row = row_at(table, iso);
    EXPECT_LT(row, table.rows()) << iso;
    return row < table.rows() && table.has(field) ? table[field][row] : kMissing;
}
// What fell in all rows, kg/m2.
double total(const ForcingTable& table, Field field)
{
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < table.rows(); ++i) {
        const double rate = table[field][i];
        if (!std::isnan(rate))
            sum += rate * static_cast<double>(table.time_us[i + 1] - table.time_us[i]) * 1e-6;
    }
    return sum;
}
std::string notes(const ReadReport& report)
{
    return to_text(report);
}

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

// ---- never misread without a word ----

std::string refusal(const std::string& text, const ReadOptions& options = {})
{
    try {
        read_weather(text, options);
    } catch (const Error& error) {
        return std::string(error.what()) + " | " + error.fix();
    }
    return "read";
}

// Where the zone is taken from the longitude, no number of a damaged file becomes a time.
// Found by fuzzing: the mark was left out after the file was found not to be empty.
TEST(ReadWeather, AFileOfAByteOrderMarkAloneIsEmpty)
{
    for (const char* text : {"\xef\xbb\xbf", "\xef\xbb\xbf\n \n", ""}) {
        try {
            read_weather(text);
            FAIL() << "read";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("is empty"), std::string::npos)
                << error.what();
        }
    }
}

TEST(ReadWeather, ALongitudeBeyondTheGlobeIsRefused)
{
    for (const auto& [name, place] :
         {std::pair{"environment_canada.csv", "-75.67"}, std::pair{"lcd.csv", "-73.88"}}) {
        std::string text = text_of(std::filesystem::path(PETRICHOR_SAMPLES) / name);
        ASSERT_NE(text.find(place), std::string::npos) << name;
        for (std::size_t at = 0; (at = text.find(place, at)) != std::string::npos; at += 8)
            text.replace(at, std::string(place).size(), "1.74e+200");
        EXPECT_THAT(refusal(text), HasSubstr("longitude 1.74e+200 is outside -180..360")) << name;
    }
}

TEST(NeverMisread, AColumnThatSpeaksOfWeatherIsUnderstoodOrAnError)
{
    const std::string text = "time,air_temp_c,snow_melt_rate\n2024-01-01T00:00,-1,3\n";
    EXPECT_THAT(refusal(text), testing::AllOf(HasSubstr("snow_melt_rate"), HasSubstr("--ignore")));
    ReadOptions options;
    options.ignore = {"snow_melt_rate"};
    EXPECT_EQ(refusal(text, options), "read");
    options.ignore = {"all"};
    EXPECT_EQ(refusal(text, options), "read");
    EXPECT_EQ(refusal("time,air_temp_c,battery_v\n2024-01-01T00:00,-1,12\n"), "read");
}

TEST(NeverMisread, ABareSnowColumnIsAmbiguous)
{
    EXPECT_THAT(refusal("time,air_temp_c,snow\n2024-01-01T00:00,-1,30\n"),
                HasSubstr("snow_depth_cm"));
}

TEST(NeverMisread, APlaceThatDoesNotExistIsAnError)
{
    EXPECT_THAT(refusal("# latitude: 95\ntime,air_temp_c\n2024-01-01T00:00,-1\n"),
                testing::AllOf(HasSubstr("95"), HasSubstr("--latitude")));
}

TEST(NeverMisread, AYearWithoutADropWasNotMeasured)
{
    std::string text = "time,air_temp_c,precip_mm,wind_m_s\n";
    for (int day = 0; day < 70; ++day) {
        const std::int64_t us = us_from_iso("2024-01-01").value() + day * 86400000000LL;
        text += iso_from_us(us) + ",5,0," + (day == 9 ? "3" : "2") + "\n";
    }
    const auto [table, report] = raw(text);
    EXPECT_FALSE(table.has(Field::Precip));
    EXPECT_TRUE(table.has(Field::Wind));
    EXPECT_THAT(notes(report), HasSubstr("nothing but 0 in 70 rows"));
}

TEST(NeverMisread, NoiseOfASensorIsOneLine)
{
    std::string text = "time,air_temp_c,snow_depth_m\n";
    for (int hour = 0; hour < 200; ++hour) {
        const std::int64_t us = us_from_iso("2024-01-01").value() + hour * 3600000000LL;
        text += iso_from_us(us) + ",5,-0.01\n";
    }
    const auto [table, report] = raw(text);
    EXPECT_EQ(table[Field::SnowDepth].front(), 0.0);
    EXPECT_EQ(report.notes.size(), 1u);
    EXPECT_THAT(notes(report), HasSubstr("200 values"));
}

TEST(NeverMisread, ARisingDepthTellsThatItSnowed)
{
    ReadOptions options;
    const auto read = read_weather(
        "time,air_temp_c,precip_mm,snow_depth_m\n2024-01-01T00:00,2.5,2,0.30\n"
        "2024-01-01T01:00,2.5,2,0.33\n2024-01-01T02:00,2.5,2,0.33\n2024-01-01T03:00,2.5,0,0.32\n",
        options);
    EXPECT_EQ(read.table[Field::SnowShare][0], 1.0);
    EXPECT_TRUE(std::isnan(read.table[Field::SnowShare][1]));
    EXPECT_TRUE(std::isnan(read.table[Field::SnowShare][2]));
}

TEST(NeverMisread, SmetObservationsAreKeptApart)
{
    const auto table =
        raw("SMET 1.1 ASCII\n[HEADER]\nstation_id = a\nlatitude = 46\nlongitude = 9\naltitude = "
            "1500\nnodata = -999\ntz = 1\nfields = timestamp TA TSS RSWR HS\n[DATA]\n"
            "2024-01-01T00:00 270 268 12 1.5\n")
            .table;
    EXPECT_EQ(table[Field::SurfaceTemp].front(), 268.0);
    EXPECT_EQ(table[Field::Reflected].front(), 12.0);
    EXPECT_EQ(table[Field::SnowDepth].front(), 1.5);
    EXPECT_EQ(table.site.utc_offset_h, 1.0);
}

TEST(NeverMisread, MetarPlacesAreNotGuessed)
{
    const auto read = raw("METAR EDDF 311850Z 24015KT 9999 BKN012 M01/M03 Q1013=\n");
    EXPECT_TRUE(std::isnan(read.table.site.latitude_deg));
    EXPECT_THAT(notes(read.report), HasSubstr("give latitude and longitude"));
}

TEST(NeverMisread, LocalTimesWithoutAZoneAreNoticed)
{
    std::string text = "# latitude: 43.2\n# longitude: -116.8\ntime,air_temp_c,sw_down_w_m2\n";
    for (int hour = 0; hour < 240; ++hour) {
        const std::int64_t us = us_from_iso("2024-06-01").value() + hour * 3600000000LL;
        const double sun = std::max(0.0, std::sin((hour % 24 - 6) * 3.14159 / 12.0));
        text += iso_from_us(us).substr(0, 16) + ",15," + std::to_string(900.0 * sun) + "\n";
    }
    EXPECT_THAT(notes(raw(text).report), HasSubstr("--file-zone -8"));
    ReadOptions options;
    options.utc_offset_h = -8.0;
    const auto moved = raw(text, options);
    EXPECT_EQ(iso_from_us(moved.table.time_us.front()), "2024-06-01T08:00:00Z");
    EXPECT_THAT(notes(moved.report), testing::Not(HasSubstr("--file-zone")));
}

TEST(NeverMisread, FreshSnowOfADayTellsThePhase)
{
    const auto table =
        raw("STATION,DATE,LATITUDE,LONGITUDE,ELEVATION,NAME,PRCP,SNOW,SNWD,TMAX,TMIN\n"
            "US1,2024-01-01,45,-110,1000,X,100,100,120,20,-60\n"
            "US1,2024-01-02,45,-110,1000,X,100,0,90,80,10\n"
            "US1,2024-01-03,45,-110,1000,X,0,0,80,80,10\n")
            .table;
    EXPECT_EQ(table[Field::SnowShare].front(), 1.0);
    EXPECT_EQ(table[Field::SnowShare][8], 0.0);
    EXPECT_TRUE(std::isnan(table[Field::SnowShare][16]));
    EXPECT_NEAR(table[Field::SnowDepth].front(), 0.12, 1e-12);
}

TEST(NeverMisread, AnEpwWithoutPrecipitationSaysSoAndItCanBeEstimated)
{
    NEED_ASSETS(assets);
    std::istringstream in(text_of(assets / "weather/USA_CO_Denver.Intl.AP.725650_TMY3.epw"));
    std::string text, line;
    for (int n = 0; std::getline(in, line); ++n) {
        const auto columns = split(line, ',');
        if (n >= 8 && columns.size() > 34) {
            std::string changed;
            for (std::size_t i = 0; i < columns.size(); ++i)
                changed.append(i ? "," : "").append(i == 33 ? "0" : std::string(columns[i]));
            line = changed;
        }
        text += line + "\n";
    }
    ReadOptions options;
    const auto dry = read_weather(text, options);
    EXPECT_THAT(notes(dry.report), testing::AllOf(HasSubstr("taken as not measured"),
                                                  HasSubstr("no precipitation in the file")));
    options.filling.missing_precip = MissingPrecip::Estimate;
    EXPECT_GT(total(read_weather(text, options).table, Field::Precip), 50.0);
}

// A misspelt column is never dropped without a word: in every sample with a header, each name with
// a letter too many is an error, is named in the report, or changes nothing that is read.
TEST(Archives, NoMisspeltColumnIsDroppedInSilence)
{
    int changed = 0;
    for (const auto& entry : std::filesystem::directory_iterator(PETRICHOR_SAMPLES)) {
        const std::string file = entry.path().filename().string();
        const std::string text = text_of(entry.path());
        std::size_t begin = 0, end = 0;
        char separator = 0;
        // The header: the first line of at least four names.
        for (int line = 0; line < 40 && end != text.npos && !separator; ++line) {
            begin = line == 0 ? 0 : end + 1;
            end = text.find('\n', begin);
            const std::string one = text.substr(begin, end - begin);
            for (const char c : {',', ';', '|', '\t'}) {
                const auto fields = split(one, c);
                const auto names =
                    std::count_if(fields.begin(), fields.end(), [](std::string_view f) {
                        return !to_number(f) &&
                               std::count_if(f.begin(), f.end(), [](char x) {
                                   return std::isalpha(static_cast<unsigned char>(x)) != 0;
                               }) >= 2;
                    });
                if (names >= 4 && fields.size() >= 4) separator = c;
            }
        }
        if (!separator || file.ends_with(".epw") || file.ends_with(".json")) continue;
        ReadResult plain;
        ReadOptions options;
        options.fill = false;
        try {
            plain = read_weather(text, options);
        } catch (const Error&) {
            continue;  // no weather by itself
        }
        const std::string header = text.substr(begin, end - begin);
        std::size_t at = 0;
        while (at < header.size()) {
            std::size_t stop = std::min(header.find(separator, at), header.size());
            std::size_t letters = at;
            while (letters < stop && (std::isalnum(static_cast<unsigned char>(header[letters])) ||
                                      header[letters] == '_' || header[letters] == '"'))
                ++letters;
            const std::string name = header.substr(at, letters - at);
            if (letters - at >= 3 && name.find('"') == name.npos) {
                std::string other = text;
                other.insert(begin + letters, "q");
                try {
                    const ReadResult read = read_weather(other, options);
                    bool same = read.table.time_us == plain.table.time_us;
                    for (std::size_t c = 0; c < kFieldCount && same; ++c) {
                        const auto &a = read.table.columns[c], &b = plain.table.columns[c];
                        same = a.size() == b.size() &&
                               std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
                                   return x == y || (std::isnan(x) && std::isnan(y));
                               });
                    }
                    if (!same) {
                        ++changed;
                        // By its new name, by that of the column whose unit it told, or as the
                        // clock's zone that nobody tells any more.
                        const std::string said = lower(to_text(read.report));
                        const std::size_t unread = said.find("not read:");
                        EXPECT_TRUE(
                            said.find(lower(name) + "q") != said.npos ||
                            said.find("zone") != said.npos ||
                            (unread != said.npos && said.find(lower(name), unread) != said.npos))
                            << file << ": " << name;
                    }
                } catch (const Error&) {
                }
            }
            at = stop + 1;
        }
    }
    EXPECT_GT(changed, 20);
}

// Flags belong to their column by its name, wherever they stand.
TEST(GhcnTables, FlagsAreFoundByName)
{
    const std::string usual =
        "\"STATION\",\"DATE\",\"LATITUDE\",\"LONGITUDE\",\"ELEVATION\",\"TMAX\","
        "\"TMAX_ATTRIBUTES\",\"TMIN\"\n"
        "\"ZZ1\",\"2021-01-14\",\"46.8\",\"9.8\",\"1560\",\"  400\",\",X,E\",\" -105\"\n"
        "\"ZZ1\",\"2021-01-15\",\"46.8\",\"9.8\",\"1560\",\" -31\",\"T,,E\",\" -142\"\n";
    const std::string moved =
        "\"TMAX\",\"STATION\",\"TMIN\",\"DATE\",\"LATITUDE\",\"LONGITUDE\",\"ELEVATION\","
        "\"TMAX_ATTRIBUTES\"\n"
        "\"  400\",\"ZZ1\",\" -105\",\"2021-01-14\",\"46.8\",\"9.8\",\"1560\",\",X,E\"\n"
        "\" -31\",\"ZZ1\",\" -142\",\"2021-01-15\",\"46.8\",\"9.8\",\"1560\",\"T,,E\"\n";
    const ForcingTable a = raw(usual).table, b = raw(moved).table;
    ASSERT_EQ(a.time_us, b.time_us);
    for (std::size_t i = 0; i < a.rows(); ++i) {
        const double was = a[Field::AirTemp][i], is = b[Field::AirTemp][i];
        EXPECT_TRUE(was == is || (std::isnan(was) && std::isnan(is))) << i;
        EXPECT_FALSE(is > 300.0) << "40 C failed its check";
    }
}

// What an editor or a mail program does to a text changes nothing that is read from it.
TEST(EverySample, ReadsTheSameWithOtherEndsOfLinesAndEmptyOnesAround)
{
    const auto answer = [](const std::string& text) {
        ReadOptions options;
        options.ignore = {"all"};
        options.fill = false;
        std::string out;
        try {
            const ReadResult r = read_weather(text, options);
            for (std::size_t i = 0; i < r.table.rows(); ++i) {
                out += iso_from_us(r.table.time_us[i]);
                for (const auto& column : r.table.columns)
                    out += column.empty() ? "," : "," + std::to_string(column[i]);
                out += "\n";
            }
            const Site& at = r.table.site;
            for (const double v : {at.latitude_deg, at.longitude_deg, at.elevation_m,
                                   at.temp_height_m, at.wind_height_m, at.utc_offset_h})
                out += " " + std::to_string(v);
        } catch (const Error&) {
            return std::string();
        }
        return out;
    };
    int read = 0;
    for (const auto& entry : std::filesystem::directory_iterator(PETRICHOR_SAMPLES)) {
        const std::string bytes = text_of(entry.path());
        const bool wide = is_utf16(bytes) && bytes.size() % 2 == 0;
        const std::string text = wide ? utf8_of_utf16(bytes) : bytes;
        const std::string as_it_is = answer(bytes);
        if (as_it_is.empty()) continue;  // seeds of the fuzzer that are no weather
        ++read;
        std::string crlf;
        for (const char c : text) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
        const std::string mark = "\xEF\xBB\xBF";
        const bool marked = text.rfind(mark, 0) == 0;
        for (const std::string& other :
             {text, marked ? text : mark + text, text.find('\r') == std::string::npos ? crlf : text,
              "\n\n" + (marked ? text.substr(3) : text), "\r\n" + (marked ? text.substr(3) : text),
              text + "\n\n"})
            EXPECT_EQ(answer(other), as_it_is) << entry.path().filename();
    }
    EXPECT_GE(read, 40);
}

// Saved by a spreadsheet of a country with decimal commas, or with tabs: the same.
TEST(EverySample, OfCommasReadsTheSameWithASpreadsheetsSeparators)
{
    int read = 0;
    for (const char* name : {"typical_year.epw", "typical_year_tmy3.csv", "nsrdb.csv", "pvgis.csv",
                             "midc.csv", "open_meteo.csv", "noaa_global_hourly.csv", "lcd.csv",
                             "environment_canada.csv", "meteostat.csv"}) {
        const std::string text = text_of(std::filesystem::path(PETRICHOR_SAMPLES) / name);
        ReadOptions options;
        options.ignore = {"all"};
        const ReadResult want = raw(text, options);
        for (const char separator : {';', '\t'}) {
            std::string other;
            Lines lines(text);
            while (const auto line = lines.next()) {
                std::size_t cells = 0;
                for (const std::string_view cell : split(*line, ',', 4096)) {
                    if (cells++) other += separator;
                    const bool number =
                        separator == ';' && to_number(cell) && cell.find('.') != cell.npos;
                    std::string put(cell);
                    if (number) std::replace(put.begin(), put.end(), '.', ',');
                    other += put;
                }
                other += '\n';
            }
            const ReadResult got = raw(other, options);
            EXPECT_EQ(got.report.format, want.report.format) << name;
            EXPECT_EQ(got.table.time_us, want.table.time_us) << name;
            EXPECT_THAT(to_text(got.report), HasSubstr("as a spreadsheet saves them")) << name;
            for (std::size_t f = 0; f < kFieldCount; ++f) {
                const auto &a = got.table.columns[f], &b = want.table.columns[f];
                EXPECT_TRUE(a.size() == b.size() &&
                            std::equal(a.begin(), a.end(), b.begin(),
                                       [](double x, double y) {
                                           return x == y || (std::isnan(x) && std::isnan(y));
                                       }))
                    << name << " " << field_info(static_cast<Field>(f)).name;
            }
            ++read;
        }
    }
    EXPECT_EQ(read, 20);
    EXPECT_EQ(sample("dwd_temperature.txt").report.format, "DWD") << "whose cells are apart so";
}

TEST(Pvgis, AStrayLineDoesNotEndTheTable)
{
    std::string text = text_of(std::filesystem::path(PETRICHOR_SAMPLES) / "pvgis.csv");
    const std::size_t rows = raw(text).table.rows();
    const std::size_t third = text.find("20", text.find("time(UTC)"));
    text.insert(text.find('\n', text.find('\n', third) + 1) + 1, "hello world\n\n");
    const auto r = raw(text);
    EXPECT_EQ(r.table.rows(), rows);
    EXPECT_EQ(r.report.bad_rows, 1u);
}

TEST(Tmy3, APlaceWithoutItsZoneIsTold)
{
    std::string text = text_of(std::filesystem::path(PETRICHOR_SAMPLES) / "typical_year_tmy3.csv");
    const auto whole = raw(text);
    EXPECT_EQ(whole.table.site.utc_offset_h, -6.0);
    const std::size_t end = text.find_first_of("\r\n"), elevation = text.rfind(',', end);
    std::string cut = text;
    cut.erase(elevation, end - elevation);
    const auto without = raw(cut);
    EXPECT_EQ(without.table.time_us, whole.table.time_us) << "its zone is still there";
    EXPECT_TRUE(std::isnan(without.table.site.elevation_m));
    std::string none = text;
    none.replace(none.find(",-6.0,"), 6, ",,");
    EXPECT_THAT(to_text(raw(none).report),
                HasSubstr("warning line 1 time: the line of the place names no time zone"));
}

TEST(Metro, NumbersAreReadOrRefusedAndNoAmountIsLost)
{
    const auto forecast = [](const std::string& second) {
        return "<?xml version=\"1.0\"?><forecast><header/><prediction-list>"
               "<prediction><forecast-time>2005-02-24T21:00Z</forecast-time><at>-5.5</at><td>-9</"
               "td><ra>0</ra><sn>0</sn>"
               "<ws>8</ws><ap>1014</ap><cc>0</cc></prediction>"
               "<prediction><forecast-time>2005-02-24T22:00Z</forecast-time><at>-5.5</at><td>-9</"
               "td><ra>" +
               second +
               "</ra><sn>0</sn><ws>8</ws><ap>1014</ap><cc>0</cc></prediction>"
               "<prediction><forecast-time>2005-02-24T23:00Z</forecast-time><at>-5.5</at><td>-9</"
               "td><ra>2</ra><sn>0</sn>"
               "<ws>8</ws><ap>1014</ap><cc>0</cc></prediction></prediction-list></forecast>";
    };
    const auto point = raw(forecast("0.5")).table, comma = raw(forecast("0,5")).table;
    EXPECT_EQ(point[Field::Rain], comma[Field::Rain]);
    EXPECT_NEAR(point[Field::Rain][0] * 3600.0, 0.5, 1e-9);
    const auto none = raw(forecast("")).table;
    EXPECT_NEAR(none[Field::Rain][0] * 3600.0, 1.0, 1e-9) << "2 mm in two hours";
    EXPECT_NEAR(none[Field::Rain][1] * 3600.0, 1.0, 1e-9);
    EXPECT_THROW(raw(forecast("much")), Error);
}

// What people give in place of weather is known by its content, and said where it belongs.
TEST(NoWeather, SaysWhereItBelongs)
{
    const auto refusal = [](const std::string& text) {
        try {
            read_weather(text);
        } catch (const Error& e) {
            return std::string(e.what()) + " " + e.fix();
        }
        return std::string();
    };
    EXPECT_THAT(refusal("date,snow_depth_m\n1998-10-01,0.1\n"),
                testing::AllOf(HasSubstr("has observations alone"), HasSubstr("--observed")));
    EXPECT_EQ(raw("date,snow_depth_m\n1998-10-01,0.1\n").report.rows, 1u)
        << "to be joined with weather";
    EXPECT_THAT(refusal("date,snow_depth_m,swe_kg_m2,snow_albedo\n1998-10-01,0.1,20,0.8\n"),
                testing::AllOf(HasSubstr("has observations alone"), HasSubstr("--observed")));
    EXPECT_THAT(refusal("2005  10   1    0.17    1.20    0.00    0.00    8.01   10.10\n"),
                HasSubstr("--observed"));
    EXPECT_THAT(refusal("<?xml version=\"1.0\"?>\n<station><header/></station>\n"),
                HasSubstr("--road"));
    EXPECT_THAT(refusal("<?xml version=\"1.0\"?>\n<roadcast><header/></roadcast>\n"),
                HasSubstr("result of METRo"));
    EXPECT_THAT(refusal("<!DOCTYPE html><html>404</html>"), HasSubstr("a web page"));
    EXPECT_THAT(
        refusal("time,air_temp_c,snow_albedo\n1998-10-01,0.1,0.8\n"),
        testing::AllOf(HasSubstr("not understood: snow_albedo"), Not(HasSubstr("--observed"))));
}

}  // namespace
}  // namespace petrichor::weather
