// Readers on the real files (when PETRICHOR_ASSETS names them) and on small texts made to go wrong.
#include "weather/readers/read_weather.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "tests/weather/reading.h"
#include "weather/physics/constants.h"
#include "weather/readers/metar.h"
#include "weather/readers/text.h"
#include "weather/readers/units.h"

namespace petrichor::weather {
namespace {

using namespace testing_reading;

std::string why(std::string_view text, const ReadOptions& options = {})
{
    try {
        read_weather(text, options);
    } catch (const Error& e) {
        return std::string(e.what()) + " | " + e.fix();
    }
    return "";
}

const FieldReport* report_of(const ReadReport& r, const std::string& name)
{
    for (const auto& f : r.fields) {
        if (f.name == name) return &f;
    }
    return nullptr;
}

// ---- the real files

TEST(Fsm, ColDePorte)
{
    READ_ASSET(text, "met_CdP_0506.txt");
    const auto r = read_weather(text);
    EXPECT_EQ(r.report.format, "FSM 12 columns");
    EXPECT_EQ(r.table.rows(), 6552u);
    EXPECT_EQ(r.report.bad_rows, 0u);
    EXPECT_EQ(iso_from_us(r.table.time_us.front()), "2005-10-01T00:00:00Z");
    EXPECT_EQ(iso_from_us(r.table.time_us.back()), "2006-06-30T23:00:00Z");
    EXPECT_DOUBLE_EQ(r.table[Field::AirTemp][0], 277.8);
    EXPECT_DOUBLE_EQ(r.table[Field::Pressure][0], 87480);
    expect_complete(r.table);
}

TEST(ForcingCsv, ColDePorte)
{
    READ_ASSET(text, "col_de_porte_2001_02_met_hourly.csv");
    const auto r = read_weather(text);
    EXPECT_EQ(r.report.format, "forcing CSV");
    EXPECT_EQ(r.report.bad_rows, 0u);
    EXPECT_FALSE(r.table.has(Field::Snow));
    EXPECT_DOUBLE_EQ(r.table[Field::Precip][1], 2.737e-4);
    EXPECT_DOUBLE_EQ(r.table[Field::AirTemp][0], 281.63);
    expect_complete(r.table);
}

TEST(ForcingCsv, SnobalInputs)
{
    READ_ASSET(text, "central_sierra_2022_23_snobal_inputs.csv");
    const auto r = read_weather(
        text, {.site = {.latitude_deg = 39.3, .longitude_deg = -120.4, .elevation_m = 2103}});
    EXPECT_NEAR(r.table[Field::AirTemp][0], 13.3683 + 273.15, 1e-9);
    // Vapour pressure becomes humidity; percent_snow splits the 6-hour amounts.
    EXPECT_NEAR(r.table[Field::RelHumidity][0], 100 * 681.57038 / 1534.2, 0.3);
    EXPECT_GT(sum_mm(r.table, Field::Snow), 1000);
    expect_complete(r.table);
}

TEST(Epw, Denver)
{
    READ_ASSET(text, "USA_CO_Denver.Intl.AP.725650_TMY3.epw");
    const auto r = read_weather(text);
    EXPECT_EQ(r.report.format, "EPW");
    EXPECT_EQ(r.report.bad_rows, 0u);
    EXPECT_EQ(r.table.rows(), 8760u);  // the first hour has no amount, so no row is put before it
    EXPECT_NEAR(r.table.site.elevation_m, 1650, 1e-9);
    // Hour 1 local (UTC-7) ends at 08:00 UTC.
    EXPECT_EQ(iso_from_us(r.table.time_us[0]), "1995-01-01T08:00:00Z");
    EXPECT_NEAR(r.table[Field::AirTemp][0], 255.15, 1e-9);
    EXPECT_NEAR(r.table[Field::Pressure][0], 83700, 1e-9);
    // All amounts of the file, each once: 1, 3, 6 and 24 hour totals.
    double listed = 0;
    Lines lines(text);
    while (const auto line = lines.next()) {
        const auto f = split(*line, ',', 64);
        if (lines.number() <= 8 || f.size() < 35) continue;
        const double mm = *to_number(f[33]);
        if (mm < 999) listed += mm;
    }
    EXPECT_GT(listed, 100);
    EXPECT_NEAR(sum_mm(r.table, Field::Precip), listed,
                4.5);  // 6-hour totals contain some of the hours
    expect_complete(r.table);
    EXPECT_NE(to_text(r.report).find("typical year"), std::string::npos);
}

TEST(Tmy3, Greensboro)
{
    READ_ASSET(text, "723170TYA.CSV");
    const auto r = read_weather(text);
    EXPECT_EQ(r.report.format, "TMY3 CSV");
    EXPECT_EQ(r.report.bad_rows, 0u);
    EXPECT_EQ(r.table.rows(), 8761u);
    EXPECT_EQ(iso_from_us(r.table.time_us[1]),
              "1989-01-01T06:00:00Z");  // 1988 is a leap year; UTC-5
    EXPECT_NEAR(r.table[Field::AirTemp][1], 283.15, 1e-9);
    EXPECT_NEAR(r.table[Field::Pressure][1], 99300, 1e-9);
    expect_complete(r.table);
}

TEST(Pvgis, TypicalYear)
{
    READ_ASSET(text, "pvgis_tmy_45.000_8.000.csv");
    const auto r = read_weather(text);
    EXPECT_EQ(r.report.format, "PVGIS CSV");
    EXPECT_EQ(r.table.rows(), 8760u);
    EXPECT_EQ(r.report.bad_rows, 0u);
    EXPECT_NEAR(r.table.site.elevation_m, 250, 1e-9);
    EXPECT_EQ(iso_from_us(r.table.time_us.back()), "2018-12-31T23:00:00Z");
    EXPECT_DOUBLE_EQ(r.table[Field::Longwave][0], 283.58);
    EXPECT_EQ(sum_mm(r.table, Field::Precip), 0);
    EXPECT_NE(to_text(r.report).find("no precipitation"), std::string::npos);
    expect_complete(r.table);
}

TEST(OpenMeteo, Json)
{
    READ_ASSET(text, "open_meteo_2023-07-29_51.2N_3.2E.json");
    const auto r = read_weather(text);
    EXPECT_EQ(r.report.format, "Open-Meteo JSON");
    EXPECT_EQ(r.table.rows(), 25u);  // 24 hours and the one before, which holds the first sum
    EXPECT_EQ(iso_from_us(r.table.time_us[1]), "2023-07-28T22:00:00Z");  // local midnight is UTC+2
    EXPECT_NEAR(r.table[Field::Wind][1], 17.8 / 3.6, 1e-9);
    EXPECT_NEAR(r.table[Field::AirTemp][1], 290.45, 1e-9);
    EXPECT_NEAR(sum_mm(r.table, Field::Rain), 1.3, 1e-9);
    // 0.2 mm at 08:00 local fell in the hour before it.
    EXPECT_NEAR(r.table[Field::Rain][8] * 3600, 0.2, 1e-9);
    EXPECT_LT(r.table[Field::Pressure][1], 100780);  // brought from sea level to 10 m
    expect_complete(r.table);
}

TEST(Metar, Bulletin)
{
    READ_ASSET(text, "metar_2020-01-06_0000z_sample.txt");
    const auto r = read_weather(
        text,
        {.site = {.latitude_deg = 32, .longitude_deg = 36, .elevation_m = 0}, .station = "ubbl"});
    EXPECT_EQ(r.table.rows(), 1u);
    EXPECT_NEAR(r.table[Field::AirTemp][0], 274.15, 1e-9);
    EXPECT_NE(to_text(r.report).find("runway 33: cleared"), std::string::npos);
    const auto all = read_weather(text);
    EXPECT_NE(to_text(all.report).find("several stations"), std::string::npos);
    EXPECT_EQ(all.report.bad_rows, 0u);
    EXPECT_NE(why(text, {.station = "XXXX"}).find("Choose one of"), std::string::npos);
    // Wind in MPS, visibility with a direction, a wrapped remark.
    const auto mongolia = read_weather(text, {.station = "ZMUB"});
    EXPECT_NEAR(mongolia.table[Field::Wind][0], 1.0, 1e-9);
    EXPECT_NEAR(mongolia.table[Field::Visibility][0], 8000, 1e-9);
    // M41/ without a dew point.
    const auto alaska = read_weather(text, {.station = "PAKU"});
    EXPECT_NEAR(alaska.table[Field::AirTemp][0], 232.15, 1e-9);
}

TEST(Metar, Series)
{
    READ_ASSET(text, "metar_series_short.txt");
    const auto r = read_weather(text, {.station = "KBOS", .year = 2024, .month = 2});
    EXPECT_EQ(r.table.rows(), 4u);
    EXPECT_EQ(iso_from_us(r.table.time_us[0]), "2024-02-23T16:54:00Z");
    EXPECT_NEAR(r.table[Field::AirTemp][0], 273.15 + 12.8, 1e-9);  // the remark has tenths
    expect_complete(r.table);
}

// ---- groups of METAR

TEST(Metar, Groups)
{
    const auto r = parse_metar(
        "LSZH 101250Z 24015G25KT 210V270 1 1/2SM R14/P2000N +SHSN BKN008 OVC020 M01/M02 Q0998 "
        "88290050 "
        "TEMPO 0800 RMK P0009 60012 T10061017 4/012=");
    ASSERT_TRUE(r);
    EXPECT_NEAR(r->wind_m_s, 15 * 1852.0 / 3600, 1e-9);
    EXPECT_NEAR(r->gust_m_s, 25 * 1852.0 / 3600, 1e-9);
    EXPECT_NEAR(r->visibility_m, 1.5 * 1609.344, 1e-9);
    EXPECT_EQ(r->cloud, 1.0);
    EXPECT_NEAR(r->temp_c, -0.6, 1e-9);
    EXPECT_NEAR(r->dew_c, -1.7, 1e-9);
    EXPECT_NEAR(r->snow_mm_h, 3.0, 1e-12);
    EXPECT_NEAR(r->hour_precip_mm, 2.286, 1e-9);
    EXPECT_NEAR(r->six_hour_precip_mm, 12 * 0.254, 1e-9);
    EXPECT_NEAR(r->snow_depth_m, 12 * 0.0254, 1e-9);
    ASSERT_EQ(r->runways.size(), 1u);
    EXPECT_EQ(r->runways[0].deposit, 2);
    EXPECT_EQ(r->runways[0].extent, 9);
    EXPECT_NEAR(r->runways[0].friction, 0.5, 1e-9);
    EXPECT_TRUE(r->not_understood.empty());
    EXPECT_TRUE(
        parse_metar("KABC 101250Z /////KT //// // ////// 12/ A////")->not_understood.empty());
    EXPECT_TRUE(parse_metar("HLLT NIL=")->nil);
    EXPECT_FALSE(parse_metar("KABC 991250Z"));
    EXPECT_NEAR(parse_metar("KABC 101250Z R88/292050")->runways[0].depth_mm, 20, 1e-9);
    EXPECT_NEAR(parse_metar("EDDF 101250Z -RASN 01/00 Q1000")->snow_mm_h, 0.25, 1e-12);
    EXPECT_EQ(parse_metar("EDDF 101250Z VCSH BLSN 01/00 Q1000")->weather_seen, false);
}

TEST(Metar, RunwaysAreRoadsThatSomebodySaw)
{
    const auto condition = [](const std::string& group) {
        const auto report = parse_metar("KABC 101250Z 24010KT 01/00 Q1000 " + group);
        return report && report->runways.size() == 1 ? condition_of(report->runways[0])
                                                     : std::nullopt;
    };
    EXPECT_EQ(condition("R33/0///70"), RoadCondition::Dry);
    EXPECT_EQ(condition("R33/190170"), RoadCondition::Wet);
    EXPECT_EQ(condition("R33/390135"), RoadCondition::Frost);
    EXPECT_EQ(condition("R33/790120"), RoadCondition::IceOrSnow);
    EXPECT_EQ(condition("R33/690430"), RoadCondition::WaterAndSnow);
    EXPECT_FALSE(condition("R33/720120"));  // ice on a quarter of it
    EXPECT_FALSE(condition("R33/CLRD70"));
    EXPECT_FALSE(condition("R33////99//"));
}

TEST(Metar, MonthsTurnAndForecastsFollow)
{
    const std::string text =
        "METAR EDDF 312350Z 24010KT 9999 FEW030 02/01 Q1010=\n"
        "METAR EDDF 010050Z 24010KT 9999 -SN OVC030 01/00 Q1010=\n"
        "TAF EDDF 312300Z 0100/0106 24010KT 9999 BKN020 TX03/0103Z\n"
        "   FM010300 20005KT 4000 RA OVC010\n   TEMPO 0103/0105 +RA=\n";
    const auto r = read_weather(text, {.year = 2023, .month = 12, .taf = TafUse::Prevailing});
    ASSERT_EQ(r.table.rows(), 8u);  // two reports, then 01..06 UTC after the last report
    EXPECT_EQ(iso_from_us(r.table.time_us[1]), "2024-01-01T00:50:00Z");
    EXPECT_EQ(iso_from_us(r.table.time_us[2]), "2024-01-01T01:00:00Z");
    EXPECT_NEAR(r.table[Field::Snow][1] * 3600, 0.5, 1e-9);
    EXPECT_NEAR(r.table[Field::Rain][5] * 3600, 4.5, 1e-9);  // 04 UTC
    EXPECT_NEAR(r.table[Field::AirTemp][4], 276.15, 1e-9);   // TX at 03 UTC
    EXPECT_NE(to_text(r.report).find("1 TEMPO or PROB groups, these not used"), std::string::npos);
    const auto expected = read_weather(text, {.year = 2023, .month = 12});
    EXPECT_NEAR(expected.table[Field::Rain][5] * 3600, 0.5 * (4.5 + 12.0), 1e-9);
}

// ---- formats without a real file at hand

TEST(Smet, HeaderUnitsAndZone)
{
    const std::string text =
        "SMET 1.1 ASCII\n[HEADER]\nstation_id = TEST\nlatitude = 46.8\nlongitude = 9.8\naltitude = "
        "2540\nnodata = -999\n"
        "tz = 1\nfields = timestamp TA RH VW ISWR ILWR PSUM HS XX\nunits_offset = 0 273.15 0 0 0 0 "
        "0 0 0\n"
        "units_multiplier = 1 1 0.01 1 1 1 1 0.01 1\n[DATA]\n"
        "2020-01-01T01:00 -5.0 80 2.0 0 240 0.0 100 1\n2020-01-01T02:00 -5.5 82 2.0 0 -999 1.2 101 "
        "1\n"
        "2020-01-01T03:00 -6.0 84 2.0 0 250 0.6 102 1\n";
    const auto r = read_weather(text);
    EXPECT_EQ(r.report.format, "SMET");
    EXPECT_EQ(iso_from_us(r.table.time_us[1]), "2020-01-01T00:00:00Z");
    EXPECT_NEAR(r.table[Field::AirTemp][1], 268.15, 1e-9);
    EXPECT_NEAR(r.table[Field::RelHumidity][1], 80, 1e-9);
    EXPECT_NEAR(r.table[Field::SnowDepth][1], 1.0, 1e-9);
    EXPECT_NEAR(r.table[Field::Longwave][2], 245, 1e-9);  // bridged
    EXPECT_NEAR(sum_mm(r.table, Field::Precip), 1.8, 1e-9);
    EXPECT_EQ(report_of(r.report, "lw_down")->missing, 1u);
}

TEST(OpenMeteo, Csv)
{
    const std::string text =
        "latitude,longitude,elevation,utc_offset_seconds,timezone,timezone_abbreviation\n52.5,13.4,"
        "38.0,0,GMT,GMT\n\n"
        "time,temperature_2m (°F),relative_humidity_2m (%),precipitation (inch),snowfall "
        "(inch),wind_speed_10m (mp/h),shortwave_radiation (W/m²)\n"
        "2024-01-01T00:00,32.0,90,0.0,0.0,10.0,0\n2024-01-01T01:00,33.8,90,0.1,0.0,NaN,0\n2024-01-"
        "01T02:00,32.0,90,0.0,0.0,10.0,0\n";
    const auto r = read_weather(text);
    EXPECT_NEAR(r.table[Field::AirTemp][1], 273.15, 1e-9);
    EXPECT_NEAR(r.table[Field::Wind][1], 4.4704, 1e-9);
    EXPECT_NEAR(sum_mm(r.table, Field::Rain), 2.54, 1e-9);
}

TEST(ForcingCsv, UnitsZonesAndMissingValues)
{
    const auto r = read_weather(
        "# a comment\nTime;AIR_TEMP_C;Wind (km/h);rel_humidity_pct;precip_mm;Pressure_hPa\n"
        "2024-01-01T00:00+01:00;1.5;36;80;0.6;950\n2024-01-01T00:30+01:00;;36;;0.0;950\n2024-01-"
        "01T01:00+01:00;2.5;18;90;1.2;951\n");
    EXPECT_EQ(iso_from_us(r.table.time_us[0]), "2023-12-31T23:00:00Z");
    EXPECT_NEAR(r.table[Field::AirTemp][1], 275.15, 1e-9);
    EXPECT_NEAR(r.table[Field::RelHumidity][1], 85, 1e-9);
    EXPECT_NEAR(r.table[Field::Wind][0], 10, 1e-9);
    EXPECT_NEAR(r.table[Field::Precip][0], 0.6 / 1800, 1e-12);  // the interval is half an hour
    EXPECT_NEAR(r.table[Field::Pressure][0], 95000, 1e-9);
    EXPECT_NE(why("time,air_temp_c,temperature_2m_f\n2024-01-01T00:00,1,2\n").find("same quantity"),
              std::string::npos);
    EXPECT_NE(why("time,air_temp_parsec\n2024-01-01T00:00,1\n").find("no known weather column"),
              std::string::npos);
    EXPECT_NE(why("time,wind (furlong)\n2024-01-01T00:00,1\n").find("furlong"), std::string::npos);
}

// ---- damage

TEST(BadInput, OneBadRowIsBridgedAndNamed)
{
    std::string text = "time,air_temp_c,precip_mm\n";
    for (int h = 0; h < 24; ++h) {
        char row[64];
        std::snprintf(row, sizeof row, "2024-01-01T%02d:00,%d,1\n", h, h);
        text += h == 7 ? "2024-01-01T07:00,what\n" : row;
    }
    const auto r = read_weather(text);
    EXPECT_EQ(r.report.bad_rows, 1u);
    EXPECT_EQ(r.table.rows(), 24u);  // the hour is put back, empty, and bridged
    EXPECT_NEAR(r.table[Field::AirTemp][7], 273.15 + 7, 1e-9);
    EXPECT_EQ(r.table[Field::Precip][7], 0.0);
    EXPECT_NE(to_text(r.report).find("line 9"), std::string::npos);
    EXPECT_NE(to_json(r.report).find("\"line\":9"), std::string::npos);
}

TEST(BadInput, DuplicateAndUnorderedTimes)
{
    std::string text = "time,air_temp_c\n";
    for (int h = 0; h < 20; ++h) {
        char row[64];
        std::snprintf(row, sizeof row, "2024-01-01T%02d:00,%d\n", h, h);
        text += row;
        if (h == 5) text += row;
        if (h == 9) text += "2024-01-01T03:00,50\n";
    }
    const auto r = read_weather(text);
    EXPECT_EQ(r.report.bad_rows, 1u) << "a second 3 h says something else";
    EXPECT_NE(to_text(r.report).find("line 13 time: duplicate of 2024-01-01T03:00:00Z"), std::string::npos)
        << to_text(r.report);
    EXPECT_NE(to_text(r.report).find("1 row stands behind a later one"), std::string::npos);
    EXPECT_NE(to_text(r.report).find("1 row stands in the file again"), std::string::npos);
    for (int h = 0; h < 20; ++h)
        EXPECT_NEAR(r.table[Field::AirTemp][static_cast<std::size_t>(h)], 273.15 + h, 1e-9);
}

TEST(BadInput, AbsurdValuesAreRefusedOneByOne)
{
    const auto r = read_weather(
        "time,air_temp_c,wind_m_s,precip_mm,rel_humidity_pct\n2024-01-01T00:00,5,2,0,80\n"
        "2024-01-01T01:00,500,-3,1e9,nan\n2024-01-01T02:00,7,2,0,80\n");
    EXPECT_NEAR(r.table[Field::AirTemp][1], 279.15, 1e-9);
    EXPECT_EQ(report_of(r.report, "air_temp")->out_of_range, 1u);
    EXPECT_EQ(report_of(r.report, "wind")->out_of_range, 1u);
    EXPECT_EQ(report_of(r.report, "precip")->out_of_range, 1u);
    EXPECT_EQ(report_of(r.report, "rel_humidity")->missing, 1u);
}

TEST(BadInput, HopelessFilesListTheirLines)
{
    const std::string many = why("time,air_temp_c\na,1\nb,2\nc,3\n2024-01-01T00:00,4\n");
    EXPECT_NE(many.find("line 2 time"), std::string::npos) << many;
    EXPECT_NE(many.find("line 4 time"), std::string::npos) << many;
    EXPECT_NE(why("").find("empty"), std::string::npos);
    EXPECT_NE(why("   \n\n ").find("empty"), std::string::npos);
    EXPECT_NE(why("hello world\nthis is prose\n").find("EPW"), std::string::npos);
    EXPECT_NE(why(std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16)).find("binary"),
              std::string::npos);
    EXPECT_NE(why("{\"hourly\":{\"time\":[\"2024-01-01T00:00\"").find("JSON line 1"),
              std::string::npos);
    EXPECT_NE(why(std::string(100, '[')).find("nested"), std::string::npos);
    EXPECT_NE(why("time,air_temp_c\n2024-01-01T00:00,nan\n").find("no air temperature"),
              std::string::npos);
    EXPECT_NE(why("LOCATION,x\n").find("no row follows"), std::string::npos);
}

TEST(BadInput, AGigabyteOfZerosIsRefused)
{
    std::vector<char> zeros;
    try {
        zeros.resize(std::size_t{1} << 30);
    } catch (const std::bad_alloc&) {
        GTEST_SKIP() << "less than a gigabyte of memory";
    }
    EXPECT_NE(why({zeros.data(), zeros.size()}).find("binary"), std::string::npos);
}

// Truncated anywhere, every real file is read or refused with a message; nothing else is thrown.
TEST(BadInput, TruncatedRealFiles)
{
    for (const char* name :
         {"met_CdP_0506.txt", "col_de_porte_2001_02_met_hourly.csv",
          "open_meteo_2023-07-29_51.2N_3.2E.json", "metar_2020-01-06_0000z_sample.txt",
          "metar_series_short.txt", "pvgis_tmy_45.000_8.000.csv", "723170TYA.CSV",
          "USA_CO_Denver.Intl.AP.725650_TMY3.epw"}) {
        READ_ASSET(text, name);
        for (std::size_t n = 0; n < 25; ++n) {
            const std::size_t length = std::min(text.size() * n / 25, std::size_t{4000} * n);
            try {
                read_weather(std::string_view(text).substr(0, length));
            } catch (const Error& e) {
                EXPECT_FALSE(e.fix().empty());
            }
        }
    }
}

// Seeded mutations of small samples of every format: flips, cuts, repeats, splices.
TEST(BadInput, Mutations)
{
    std::vector<std::string> seeds = {
        "2005 10 1 0 0.0 283.1 .0E+00 .0E+00 277.8 78.2 0.6 87480.\n2005 10 1 1 0.0 284.7 .1E-03 "
        ".0E+00 278.0 73.1 0.0 87430.\n",
        "time,air_temp_c,wind (km/h),precip_mm\n2024-01-01T00:00,1,2,3\n2024-01-01T01:00,1,2,3\n",
        "LOCATION,D,CO,USA,TMY3,725650,39.83,-104.65,-7.0,1650.0\na\nb\nc\nd\ne\nf\ng\n1995,1,1,1,"
        "0,x,-18.0,-19.7,85,83700,0,0,181,0,0,0,0,0,0,0,0,0.0,2,2,777.7,20306,9,999999999,30,0."
        "0440,0,88,0.220,2.0,6.0\n"
        "1995,1,1,2,0,x,-18.0,-19.7,85,83700,0,0,181,0,0,0,0,0,0,0,0,0.0,2,2,777.7,20306,9,"
        "999999999,30,0.0440,0,88,0.220,2.0,1.0\n",
        "METAR LSZH 101250Z 24015G25KT 1 1/2SM R14/P2000N +SHSN BKN008 M01/M02 Q0998 88290050 RMK "
        "P0009 T10061017=\nTAF LSZH 101100Z 1012/1118 24010KT 9999 BKN020 TX03/1103Z FM110300 "
        "20005KT RA OVC010=\n",
        "SMET 1.1 ASCII\n[HEADER]\nnodata = -999\ntz = 1\nfields = timestamp TA RH "
        "PSUM\n[DATA]\n2020-01-01T01:00 270 0.8 0.5\n2020-01-01T02:00 270 0.8 0.5\n",
        "2020 01 01 00   -50   -70 10200   180    30     8     0 -9999\n2020 01 01 01   -52   -72 "
        "10201   180    31     4    -1    20\n",
        "{\"latitude\":51.2,\"utc_offset_seconds\":7200,\"hourly_units\":{\"temperature_2m\":\"C\"}"
        ",\"hourly\":{\"time\":[\"2023-07-29T00:00\",\"2023-07-29T01:00\"],\"temperature_2m\":[17."
        "3,null],\"rain\":[0.1,0.2]}}",
        "USC00012345202001TMAX   50     60  \nUSC00012345202001TMIN  -50    -10  \n",
        "Latitude (decimal degrees): "
        "45.000\ntime(UTC),T2m,RH\n20180101:0000,2.04,94.38\n20180101:0100,2.04,94.38\n\nfooter\n",
    };
    std::uint64_t state = 12345;
    const auto random = [&] {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        return static_cast<std::size_t>(state >> 11);
    };
    std::size_t refused = 0, read = 0;
    for (int round = 0; round < 4000; ++round) {
        std::string text = seeds[random() % seeds.size()];
        for (std::size_t n = random() % 6 + 1; n > 0 && !text.empty(); --n) {
            const std::size_t at = random() % text.size();
            switch (random() % 6) {
                case 0:
                    text[at] = static_cast<char>(random() % 256);
                    break;
                case 1:
                    text.erase(at, random() % 20);
                    break;
                case 2:
                    text.insert(at, text.substr(random() % text.size(), random() % 40));
                    break;
                case 3:
                    text[at] = "0123456789-.,;/ \n\"EMPTZ"[random() % 23];
                    break;
                case 4:
                    text.insert(at, std::to_string(state));
                    break;
                default: {
                    const std::string& other = seeds[random() % seeds.size()];
                    text += other.substr(random() % other.size());
                }
            }
        }
        try {
            const auto r = read_weather(text, {.most_bytes = 1 << 20});
            expect_complete(r.table);
            ASSERT_LT(r.table.rows(), 100000u);
            ++read;
        } catch (const Error& e) {
            ASSERT_FALSE(e.fix().empty());
            ++refused;
        }
    }
    EXPECT_GT(read, 300u);
    EXPECT_GT(refused, 300u);
}

TEST(Text, CalendarRoundTrips)
{
    for (std::int64_t day = -100000; day < 200000; day += 37) {
        const auto c = civil_from_us(day * 86400000000LL + 12345678901LL);
        EXPECT_EQ(us_from_civil(c), day * 86400000000LL + 12345678901LL);
        EXPECT_EQ(us_from_iso(iso_from_us(day * 86400000000LL + 12345678901LL)),
                  day * 86400000000LL + 12345678901LL);
    }
    EXPECT_FALSE(us_from_iso("2023-02-29"));
    EXPECT_TRUE(us_from_iso("2024-02-29"));
    EXPECT_EQ(us_from_iso("2024-02-29 12:00:00.5+05:30"), us_from_iso("2024-02-29T06:30:00.5Z"));
    EXPECT_FALSE(us_from_iso("2024-02-29T12:00 nonsense"));
}

}  // namespace
}  // namespace petrichor::weather
