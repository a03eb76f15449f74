// What the readers say about a file: missing codes, moved times, precipitation without amounts; and
// files joined.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/error.h"
#include "weather/readers/join.h"
#include "weather/readers/text.h"

namespace petrichor::weather {
namespace {

const FieldReport& report_of(const ReadReport& report, const std::string& name)
{
    for (const FieldReport& f : report.fields) {
        if (f.name == name) return f;
    }
    ADD_FAILURE() << "no field " << name;
    return report.fields.front();
}

std::size_t warnings(const ReadReport& report)
{
    std::size_t n = 0;
    for (const ReadNote& note : report.notes) n += note.kind == ReadNote::Kind::Warning;
    return n;
}

TEST(Report, CodesOfMissingValuesAreNamedAndCounted)
{
    const auto r = read_weather(
        "time,air_temp_c,rel_humidity_pct,precip_mm\n"
        "2020-01-01T00:00Z,-5,80,0\n2020-01-01T01:00Z,-99,NA,-9999\n2020-01-01T02:00Z,,-999,0."
        "5\n2020-01-01T03:00Z,-8,n/a,0\n");
    EXPECT_EQ(report_of(r.report, "air_temp").missing, 2u);
    EXPECT_EQ(report_of(r.report, "air_temp").first_missing_line, 3u);
    EXPECT_EQ(report_of(r.report, "air_temp").out_of_range, 0u);
    EXPECT_EQ(report_of(r.report, "rel_humidity").missing, 3u);
    EXPECT_NEAR(r.table[Field::AirTemp][1], 273.15 - 6.0, 1e-9) << "bridged, not -99";
    const std::string text = to_text(r.report);
    for (const char* code : {"'-99'", "'NA'", "'n/a'", "'-999'", "'-9999'", "an empty cell"})
        EXPECT_NE(text.find(code), std::string::npos) << code;
}

TEST(Report, TheLettersOfAStationDoNotSayWhereItIs)
{
    const std::string text =
        "KBOS 231754Z 24008KT 10SM FEW200 09/M04 A3032\n"
        "KBOS 240454Z 24006KT 10SM CLR 02/M04 A3033\n";
    const ReadOptions dated{.year = 2024, .month = 1};
    const auto r = read_weather(text, dated);
    EXPECT_EQ(warnings(r.report), 1u) << to_text(r.report);
    EXPECT_EQ(warnings(read_weather(text).report), 2u) << "the month is taken, too";
    EXPECT_TRUE(std::isnan(r.table.site.latitude_deg));
    ReadOptions placed = dated;
    placed.site.latitude_deg = 42.36;
    placed.site.longitude_deg = -71.01;
    EXPECT_EQ(warnings(read_weather(text, placed).report), 0u);
}

TEST(Report, PrecipitationWithoutAnAmountIsWarnedOf)
{
    const std::string head =
        "time,air_temp_c,rel_humidity_pct,cloud_fraction,visibility_m,precip_mm\n";
    std::string text = head;
    // 12 hours of drizzle with amounts, then the same sky without.
    for (int h = 0; h < 24; ++h)
        text += "2020-01-01T" + std::string(h < 10 ? "0" : "") + std::to_string(h) +
                ":00Z,5,95,1,4000," + (h < 12 ? "0.6" : "NA") + "\n";
    for (int h = 0; h < 24; ++h)
        text += "2020-01-02T" + std::string(h < 10 ? "0" : "") + std::to_string(h) +
                ":00Z,5,40,0.1,20000,NA\n";
    const auto dry = read_weather(text);
    EXPECT_EQ(warnings(dry.report), 1u);
    EXPECT_EQ(report_of(dry.report, "precip").filled, 36u);
    EXPECT_NE(report_of(dry.report, "precip").filled_by.find("the file gives no amount"),
              std::string::npos);
    EXPECT_EQ(dry.table[Field::Precip][20], 0.0);
    ReadOptions options;
    options.filling.missing_precip = MissingPrecip::Estimate;
    const auto guessed = read_weather(text, options);
    EXPECT_NEAR(guessed.table[Field::Precip][20] * 3600.0, 0.6, 1e-9)
        << "the rate of the file's own rows under this sky";
    EXPECT_EQ(guessed.table[Field::Precip][40], 0.0) << "a clear dry sky";
    EXPECT_EQ(guessed.table[Field::Precip][3], dry.table[Field::Precip][3]);
    EXPECT_EQ(warnings(guessed.report), 1u);
    EXPECT_EQ(
        warnings(read_weather(head +
                              "2020-01-01T00:00Z,5,95,1,4000,0\n2020-01-01T01:00Z,5,95,1,4000,0\n")
                     .report),
        0u);
}

TEST(Report, PvgisIrradianceIsMovedToItsRow)
{
    const std::string head =
        "Latitude (decimal degrees): 45.000\nLongitude (decimal degrees): 8.000\nElevation (m): "
        "250.0\n";
    const std::string rows =
        "time(UTC),T2m,RH,G(h),Gb(n),Gd(h),IR(h),WS10m,WD10m,SP\n20180101:0900,2,90,100,0,0,280,1,"
        "257,99870\n"
        "20180101:1000,2,90,200,0,0,290,1,257,99870\n20180101:1100,2,90,260,0,0,300,1,257,99870\n";
    const auto plain = read_weather(head + rows);
    const auto later = read_weather(head + "Irradiance Time Offset (h): 0.25\n" + rows);
    const auto sooner = read_weather(head + "Irradiance Time Offset (h): -0.25\n" + rows);
    EXPECT_DOUBLE_EQ(plain.table[Field::Shortwave][1], 200.0);
    EXPECT_DOUBLE_EQ(later.table[Field::Shortwave][1], 175.0) << "200 holds at 10:15";
    EXPECT_DOUBLE_EQ(later.table[Field::Shortwave][2], 245.0);
    EXPECT_DOUBLE_EQ(sooner.table[Field::Shortwave][1], 215.0) << "200 holds at 9:45";
    EXPECT_DOUBLE_EQ(later.table[Field::Longwave][1], 290.0) << "not from the satellite";
    EXPECT_NE(to_text(later.report).find("15 min after"), std::string::npos);
    // A series carries the minutes in its times.
    std::string series = head + rows;
    for (std::size_t at = series.find("00,2,90"); at != series.npos; at = series.find("00,2,90"))
        series.replace(at, 2, "11");
    EXPECT_EQ(iso_from_us(read_weather(series).table.time_us[1]), "2018-01-01T10:11:00Z");
}

TEST(Report, MetarStationsReportOnlyWhatFell)
{
    ReadOptions denver{.year = 2024, .month = 1};
    denver.site.latitude_deg = 39.83;
    denver.site.longitude_deg = -104.66;
    const auto r = read_weather(
        "KDEN 010053Z 36005KT 10SM OVC020 02/01 A2992 RMK AO2 P0009\nKDEN 010153Z 36005KT 10SM "
        "OVC020 02/01 A2992 RMK AO2\n"
        "KDEN 010253Z 36005KT 10SM OVC020 02/01 A2992 RMK AO2 P0002\nKDEN 010353Z 36005KT 10SM "
        "OVC020 02/01 A2992 RMK AO2\n",
        denver);
    double sum = 0;
    for (std::size_t i = 0; i + 1 < r.table.rows(); ++i) {
        sum += r.table[Field::Precip][i] *
               static_cast<double>(r.table.time_us[i + 1] - r.table.time_us[i]) * 1e-6;
    }
    EXPECT_NEAR(sum, 11 * 0.254, 1e-6);
    EXPECT_EQ(warnings(r.report), 0u) << "after the last report nothing falls";
}

TEST(Report, DecimalCommasAndBareNames)
{
    const auto r = read_weather(
        "time;air_temp_c;precip_mm;precip\n2020-01-01 00:00;1,5;0,2;9\n2020-01-01 "
        "01:00;-2,25;0,4;9\n2020-01-01 02:00;0;0;9\n");
    EXPECT_NEAR(r.table[Field::AirTemp][0], 274.65, 1e-9);
    EXPECT_NEAR(r.table[Field::AirTemp][1], 270.90, 1e-9);
    EXPECT_NEAR(r.table[Field::Precip][1] * 3600, 0.4, 1e-12);
    EXPECT_NE(
        to_text(r.report).find("not used, as another column says the same quantity with a unit: "
                               "precip (precip_mm is)"),
        std::string::npos);
}

// Two columns of one quantity: the one that says its unit counts, and the other is named, in a
// warning, as its content may differ.
TEST(Report, AColumnThatIsPassedOverIsNamedInAWarning)
{
    for (const char* header :
         {"time,air_temp_c,temperature,wind_m_s", "time,temperature,air_temp_c,wind_m_s"}) {
        const bool first = std::string(header).find(",temperature") == 4;
        const std::string rows = first ? "\n2024-01-01T00:00Z,41,5,2\n2024-01-01T01:00Z,43,6,2\n"
                                       : "\n2024-01-01T00:00Z,5,41,2\n2024-01-01T01:00Z,6,43,2\n";
        const auto r = read_weather(header + rows);
        EXPECT_NEAR(r.table[Field::AirTemp][0], 278.15, 1e-9) << header;
        const std::string text = to_text(r.report);
        EXPECT_NE(text.find("warning line 1 columns: not used, as another column says the same "
                            "quantity with a unit: temperature (air_temp_c is)"),
                  std::string::npos)
            << text;
    }
    EXPECT_THROW(read_weather("time,temperature,temp\n2024-01-01T00:00Z,5,6\n"), Error);
    EXPECT_THROW(read_weather("time,air_temp_c,air_temp_k\n2024-01-01T00:00Z,5,278\n"), Error);
}

// Tables as programs write them: times without a name, seconds or milliseconds since 1970, and all
// unknown columns in one line of the report.
TEST(Report, TablesOfPrograms)
{
    const auto unnamed = read_weather(
        ",temp,rh,mood,\n2024-01-01 00:00:00,5.2,80,7,\n2024-01-01 01:00:00,5.0,82,7,\n");
    EXPECT_EQ(iso_from_us(unnamed.table.time_us[1]), "2024-01-01T01:00:00Z");
    EXPECT_NE(to_text(unnamed.report).find("not known, not used: mood\n"), std::string::npos)
        << to_text(unnamed.report);
    const auto seconds = read_weather("timestamp,air_temp_c\n1704067200,5.2\n1704070800,5.0\n");
    EXPECT_EQ(iso_from_us(seconds.table.time_us[0]), "2024-01-01T00:00:00Z");
    const auto millis = read_weather("timestamp,air_temp_c\n1704067200000,5\n1704070800000,5\n");
    EXPECT_EQ(iso_from_us(millis.table.time_us[1]), "2024-01-01T01:00:00Z");
    const auto digits = read_weather("time,air_temp_c\n2024010106,5\n2024010107,5\n");
    EXPECT_EQ(iso_from_us(digits.table.time_us[0]), "2024-01-01T06:00:00Z");
    try {
        read_weather("time,temperature,rain\n0,5,0\n2,3,1\n5,-2,1\n");
        FAIL() << "keys with the names of weather";
    } catch (const Error& e) {
        EXPECT_NE(e.fix().find("time_s,temperature_c,rainfall"), std::string::npos) << e.fix();
    }
}

TEST(Join, FilesFollowEachOtherInTime)
{
    const auto month = [](int m, int days) {
        std::string text = "time,air_temp_c,precip_mm\n";
        for (int d = 1; d <= days; ++d) {
            for (int h = 0; h < 24; ++h) {
                char line[80];
                std::snprintf(line, sizeof line, "2020-%02d-%02dT%02d:00Z,%d,%d\n", m, d, h,
                              m + h % 5, h % 2);
                text += line;
            }
        }
        return text;
    };
    const std::string january = month(1, 31), february = month(2, 29);
    const auto both = read_weather_files({{"feb.csv", february}, {"jan.csv", january}});
    EXPECT_EQ(both.table.rows(), 60u * 24u);
    EXPECT_EQ(iso_from_us(both.table.time_us.front()), "2020-01-01T00:00:00Z");
    EXPECT_EQ(both.report.rows, 60u * 24u);
    EXPECT_EQ(report_of(both.report, "air_temp").present, 60u * 24u);
    const auto alone = read_weather_files({{"jan.csv", january}});
    for (std::size_t i = 0; i < 30 * 24; ++i)
        EXPECT_EQ(both.table[Field::Precip][i], alone.table[Field::Precip][i]);
    EXPECT_THROW(read_weather_files({{"a.csv", january}, {"b.csv", january}}), Error);
    EXPECT_THROW(read_weather_files({}), Error);
    try {
        read_weather_files({{"good.csv", january}, {"bad.csv", "nothing"}});
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("bad.csv"), std::string::npos);
    }
}

}  // namespace
}  // namespace petrichor::weather
