// Stations at home, services of Austria and Norway, and archives whose newest row stands first.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "tests/weather/archive_samples.h"
#include "tests/weather/sample_texts.h"

namespace petrichor::weather {
namespace {

using namespace archive_samples;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// The lines after the first `head` the other way round.
std::string newest_first(const std::string& text, std::size_t head)
{
    std::istringstream in(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    std::reverse(lines.begin() + static_cast<std::ptrdiff_t>(head), lines.end());
    std::string out;
    for (const std::string& line : lines) out += line + "\n";
    return out;
}
// Of the same file in its order.
void expect_same(const ReadResult& a, const ReadResult& b)
{
    ASSERT_EQ(a.table.time_us, b.table.time_us);
    EXPECT_EQ(a.report.bad_rows, b.report.bad_rows);
    for (std::size_t f = 0; f < kFieldCount; ++f) {
        const auto &x = a.table.columns[f], &y = b.table.columns[f];
        ASSERT_EQ(x.size(), y.size()) << f;
        for (std::size_t i = 0; i < x.size(); ++i)
            EXPECT_TRUE(x[i] == y[i] || (std::isnan(x[i]) && std::isnan(y[i])))
                << f << " row " << i;
    }
}

TEST(Ecowitt, CountsOfRainBecomeWhatFell)
{
    ReadOptions options;
    options.utc_offset_h = 1.0;
    const auto [table, report] = sample("ecowitt.csv", options);
    EXPECT_EQ(report.format, "Ecowitt");
    EXPECT_EQ(report.rows, 6u);
    EXPECT_EQ(report.bad_rows, 0u);
    const std::string five_to = "2024-10-31T22:55Z";
    EXPECT_NEAR(at(table, Field::AirTemp, five_to), 281.25, 1e-9);
    EXPECT_NEAR(at(table, Field::RelHumidity, five_to), 93.0, 1e-9) << "that of the air outside";
    EXPECT_NEAR(at(table, Field::Wind, five_to), 2.0, 1e-9);
    EXPECT_NEAR(at(table, Field::WindFrom, five_to), 251.0, 1e-9);
    EXPECT_NEAR(at(table, Field::Pressure, five_to), 96240.0, 1e-6)
        << "of the station, not of the sea";
    // 812.4 to 812.7 in the five minutes before 23:55: in the row of 23:50.
    EXPECT_NEAR(at(table, Field::Precip, "2024-10-31T22:50Z") * 300.0, 0.3, 1e-9);
    EXPECT_NEAR(total(table, Field::Precip), 0.9, 1e-9);
    EXPECT_TRUE(std::isnan(at(table, Field::AirTemp, "2024-10-31T23:10Z")));
    EXPECT_THAT(notes(report), AllOf(HasSubstr("'yearly rain'"), HasSubstr("gust")));
    EXPECT_THAT(notes(sample("ecowitt.csv").report), HasSubstr("--file-zone"));
}

TEST(Ecowitt, ACountThatBeginsAgainBeginsFromNothing)
{
    // Without the longer counts that of the day is what is left: 5.4 before midnight, 0.3 after it.
    std::string text = corpus("ecowitt.csv");
    for (const char* name : {"Weekly Rain(mm)", "Monthly Rain(mm)", "Yearly Rain(mm)"})
        text = with(text, name, std::string("Other ") + name);
    const auto [table, report] = raw(text);
    EXPECT_THAT(notes(report), HasSubstr("'daily rain'"));
    EXPECT_NEAR(at(table, Field::Precip, "2024-10-31T23:55Z") * 300.0, 0.3, 1e-9);
    EXPECT_NEAR(total(table, Field::Precip), 0.3, 1e-9);
}

TEST(Ecowitt, UnitsAreThoseOfTheNamesAndUnknownOnesAreRefused)
{
    const std::string text = corpus("ecowitt.csv");
    const std::string f =
        with(text, "Outdoor Temperature(\xE2\x84\x83)", "Outdoor Temperature(\xE2\x84\x89)");
    EXPECT_NEAR(raw(f).table[Field::AirTemp][0], 273.15 + (8.1 - 32.0) / 1.8, 1e-9);
    EXPECT_NEAR(raw(with(text, "Wind(km/h)", "Wind(m/s)")).table[Field::Wind][0], 10.8, 1e-9);
    EXPECT_NEAR(raw(with(text, "Wind(km/h)", "Wind(knots)")).table[Field::Wind][0], 5.556, 1e-9);
    EXPECT_NEAR(total(raw(with(text, "Yearly Rain(mm)", "Yearly Rain(in)")).table, Field::Precip),
                0.9 * 25.4, 1e-9);
    EXPECT_THAT(refusal(with(text, "Wind(km/h)", "Wind(bft)")), HasSubstr("unit 'bft'"));
    const auto lux = raw(with(text, "Solar Rad(w/m2)", "Solar Rad(Klux)"));
    EXPECT_FALSE(lux.table.has(Field::Shortwave));
    EXPECT_THAT(notes(lux.report), HasSubstr("solar rad(klux)"));
}

// Tables of ecowitt.net: sensors over what they measure.
TEST(Ecowitt, TwoLinesOfNamesAreOne)
{
    ReadOptions options;
    options.utc_offset_h = 1.0;
    const auto [table, report] = sample("ecowitt_net.csv", options);
    EXPECT_EQ(report.format, "Ecowitt");
    EXPECT_EQ(report.rows, 6u);
    EXPECT_EQ(report.bad_rows, 0u);
    const std::string five_to = "2025-10-31T22:55Z";
    EXPECT_NEAR(at(table, Field::AirTemp, five_to), 281.25, 1e-9) << "not that of the room";
    EXPECT_NEAR(at(table, Field::DewPoint, five_to), 280.15, 1e-9);
    EXPECT_NEAR(at(table, Field::Wind, five_to), 2.0, 1e-9) << "neither the gust";
    EXPECT_NEAR(at(table, Field::WindFrom, five_to), 251.0, 1e-9);
    EXPECT_NEAR(at(table, Field::Pressure, five_to), 96240.0, 1e-6);
    EXPECT_NEAR(total(table, Field::Precip), 0.9, 1e-9);
    EXPECT_TRUE(std::isnan(at(table, Field::AirTemp, "2025-10-31T23:10Z")));
    EXPECT_THAT(notes(report), AllOf(HasSubstr("'rainfall yearly'"), HasSubstr("wind wind gust")));
    const std::string text = corpus("ecowitt_net.csv");
    EXPECT_NEAR(raw(with(text, "Wind Speed(km/h)", "Wind Speed(mph)")).table[Field::Wind][0],
                10.8 * 0.44704, 1e-9);
    EXPECT_THAT(refusal(with(text, "Wind Speed(km/h)", "Wind Speed(bft)")), HasSubstr("unit 'bft'"));
    // A name over every column, and none of quotes.
    std::string full = with(text, "\"Outdoor\",\"\",\"\",\"\",\"\"",
                            "Outdoor,Outdoor,Outdoor,Outdoor,Outdoor");
    full = with(full, "\"Indoor\",\"\"", "Indoor,Indoor");
    full.erase(std::remove(full.begin(), full.end(), '"'), full.end());
    expect_same(raw(full, options), raw(text, options));
}

TEST(Ecowitt, TheAirOutsideMayHaveANameOfItsOwner)
{
    const std::string text = corpus("ecowitt_net.csv");
    const auto named = raw(with(text, "\"Outdoor\"", "\"Orchard\""));
    expect_same(named, raw(text));
    EXPECT_THAT(notes(named.report), HasSubstr("'orchard'"));
    // Two that could be it: nobody guesses.
    std::string two = with(text, "\"Outdoor\"", "\"Orchard\"");
    two = with(two, "\"Indoor\",\"\"", "\"Shed\",\"\"");
    two = with(two, "\"VPD(kPa)\",\"Temperature(\xE2\x84\x83)\"", "\"VPD(kPa)\",\"Dew Point(\xE2\x84\x83)\"");
    EXPECT_THAT(refusal(two), AllOf(HasSubstr("no sensor is called 'Outdoor'"), HasSubstr("2 others")));
}

TEST(WeatherUndergroundJson, MinutesInTheUnitsOfTheirObject)
{
    const auto [table, report] = sample("wunderground_history.json");
    EXPECT_EQ(report.format, "Weather Underground JSON");
    EXPECT_EQ(report.rows, 5u);
    EXPECT_EQ(report.bad_rows, 0u);
    EXPECT_EQ(table.site.name, "IEXAMPL12");
    EXPECT_EQ(table.site.latitude_deg, 42.43);
    EXPECT_EQ(table.site.utc_offset_h, 1.0);
    EXPECT_EQ(table.time_us.front(), us_from_iso("2025-03-05T22:44:58Z"));
    EXPECT_NEAR(table[Field::AirTemp][0], 277.25, 1e-9);
    EXPECT_NEAR(table[Field::DewPoint][0], 275.35, 1e-9);
    EXPECT_NEAR(table[Field::RelHumidity][0], 87.0, 1e-9);
    EXPECT_NEAR(table[Field::Wind][2], 2.0, 1e-9);
    EXPECT_TRUE(std::isnan(table[Field::Wind][3]));
    EXPECT_EQ(table[Field::Shortwave][0], 0.0);
    // 7.1 to 7.6 before midnight, 0.3 after it.
    EXPECT_NEAR(total(table, Field::Precip), 0.8, 1e-9);
    EXPECT_NEAR(table[Field::Precip][0] * 300.0, 0.3, 1e-9);
    EXPECT_THAT(notes(report), AllOf(HasSubstr("give the elevation"), Not(HasSubstr("--file-zone"))));
    ReadOptions high;
    high.site.elevation_m = 1180.0;
    EXPECT_NEAR(sample("wunderground_history.json", high).table[Field::Pressure][0], 88200.0, 600.0);

    const std::string text = corpus("wunderground_history.json");
    const auto in = [&](const char* units) { return raw(with(text, "\"metric\"", units)).table; };
    EXPECT_NEAR(in("\"metric_si\"")[Field::Wind][2], 7.2, 1e-9);
    EXPECT_NEAR(in("\"uk_hybrid\"")[Field::Wind][2], 7.2 * 0.44704, 1e-9);
    EXPECT_NEAR(in("\"uk_hybrid\"")[Field::AirTemp][0], 277.25, 1e-9);
    EXPECT_THAT(refusal(with(text, "\"metric\"", "\"mixed\"")), HasSubstr("of no kind that is known"));
}

TEST(WeatherUndergroundJson, HoursAndWhatIsRefused)
{
    const auto [table, report] = sample("wunderground_hours.json");
    ASSERT_EQ(report.rows, 3u);
    EXPECT_NEAR(table[Field::AirTemp][0], 295.15, 1e-9);
    EXPECT_NEAR(table[Field::Wind][0], 4.5 * 0.44704, 1e-9);
    EXPECT_NEAR(total(table, Field::Precip), 2.54, 1e-9);
    EXPECT_EQ(table.site.utc_offset_h, -7.0);
    // The highest sun of an hour is not its mean.
    EXPECT_FALSE(table.has(Field::Shortwave));
    EXPECT_THAT(notes(report), HasSubstr("solarRadiationHigh: is the highest of rows of 60 min"));
    const std::string text = corpus("wunderground_hours.json");
    EXPECT_THAT(refusal(with(text, "observations", "summaries")), HasSubstr("holds days"));
    std::string two = text;
    two.replace(two.rfind("KCAEXAMP7"), 9, "KCAEXAMP8");
    EXPECT_THAT(refusal(two), AllOf(HasSubstr("several stations"), HasSubstr("stationID")));
    ReadOptions options;
    options.station = "KCAEXAMP7";
    EXPECT_EQ(raw(two, options).report.rows, 2u);
    EXPECT_THAT(refusal(R"({"observations":[],"stationID":"x","metric":{}})"),
                HasSubstr("no observations"));
    // What stands now, as many programs gather it.
    const auto now = raw(
        R"([{"stationID":"I1","obsTimeUtc":"2022-06-09T13:32:48Z","solarRadiation":132.1,"lon":17.2,)"
        R"("lat":68.9,"winddir":302,"humidity":77,"metric":{"temp":6.7,"dewpt":3,"windSpeed":11.2,)"
        R"("pressure":1010.3,"precipTotal":0,"elev":14.6}}])");
    EXPECT_NEAR(now.table[Field::Shortwave][0], 132.1, 1e-9);
    EXPECT_EQ(now.table.site.elevation_m, 14.6);
    EXPECT_NEAR(now.table[Field::Pressure][0], 100850.0, 60.0);
}

TEST(WeatherUnderground, ADayOfAStation)
{
    ReadOptions options;
    options.site.elevation_m = 120.0;
    const auto [table, report] = sample("wunderground.csv", options);
    EXPECT_EQ(report.format, "Weather Underground");
    EXPECT_EQ(report.rows, 5u);
    EXPECT_EQ(report.bad_rows, 0u);
    const std::string ten_to = "2016-03-06T07:50Z";
    EXPECT_NEAR(at(table, Field::AirTemp, ten_to), 273.15 + 17.8 / 1.8, 1e-9);
    EXPECT_NEAR(at(table, Field::Wind, ten_to), 4.0 * 0.44704, 1e-9);
    EXPECT_LT(at(table, Field::Pressure, ten_to), 101000.0) << "brought down from the sea's 101625";
    // The count of the day: .48 to .50 inch, then .01 since midnight, then .02 more.
    EXPECT_NEAR(total(table, Field::Precip), 0.05 * 25.4, 1e-9);
    EXPECT_NEAR(at(table, Field::Precip, ten_to) * 600.0, 0.254, 1e-9);
    EXPECT_TRUE(std::isnan(at(table, Field::DewPoint, "2016-03-06T08:10Z")));
    EXPECT_TRUE(std::isnan(at(table, Field::Wind, "2016-03-06T08:10Z")));
    EXPECT_THAT(notes(report), Not(HasSubstr("--file-zone")));
}

TEST(WeatherUnderground, WithoutTheClockOfGreenwichItsOwnCounts)
{
    const std::string text = with(corpus("wunderground.csv"), ",DateUTC", ",Other");
    EXPECT_EQ(raw(text).table.time_us[0], us_from_iso("2016-03-05T23:40Z").value());
    EXPECT_THAT(notes(raw(text).report), HasSubstr("--file-zone"));
    ReadOptions options;
    options.utc_offset_h = -8.0;
    EXPECT_EQ(raw(text, options).table.time_us, sample("wunderground.csv").table.time_us);
    // Metric tables of the same page.
    const std::string metric =
        with(with(with(text, "TemperatureF", "TemperatureC"), "WindSpeedMPH", "WindSpeedKMH"),
             "dailyrainin", "dailyrainMM");
    EXPECT_NEAR(raw(metric).table[Field::AirTemp][0], 323.15, 1e-9);
    EXPECT_NEAR(raw(metric).table[Field::Wind][0], 5.0 / 3.6, 1e-9);
    EXPECT_NEAR(total(raw(metric).table, Field::Precip), 0.05, 1e-9);
}

TEST(GeoSphere, HoursEndAtTheirTimes)
{
    const auto [table, report] = sample("geosphere_hours.csv");
    EXPECT_EQ(report.format, "GeoSphere Austria");
    EXPECT_EQ(table.site.name, "11803");
    EXPECT_NEAR(at(table, Field::AirTemp, "2024-01-16T12:00Z"), 272.55, 1e-9);
    EXPECT_NEAR(at(table, Field::Wind, "2024-01-16T12:00Z"), 2.4, 1e-9);
    EXPECT_NEAR(at(table, Field::Pressure, "2024-01-16T12:00Z"), 94840.0, 1e-9);
    EXPECT_NEAR(at(table, Field::SnowDepth, "2024-01-16T13:00Z"), 0.08, 1e-9);
    // 1.2 mm fell and 41 W/m2 shone from 12:00 to 13:00.
    EXPECT_NEAR(at(table, Field::Precip, "2024-01-16T12:00Z") * 3600.0, 1.2, 1e-9);
    EXPECT_THAT(notes(report), AllOf(Not(HasSubstr("_flag")), HasSubstr("so_h")));
    EXPECT_TRUE(std::isnan(at(table, Field::Wind, "2024-01-16T14:00Z")));
    const std::string text = corpus("geosphere_hours.csv");
    const std::string two = with(text, "T11:00+00:00,11803", "T11:00+00:00,11804");
    EXPECT_THAT(refusal(two), HasSubstr("several stations"));
    ReadOptions options;
    options.station = "11803";
    EXPECT_EQ(raw(two, options).report.rows, 4u);
    std::string days = text;
    for (int day = 0; day < 5; ++day)
        days = with(days, "16T1" + std::to_string(day), std::to_string(16 + day) + "T00");
    EXPECT_THAT(refusal(days), HasSubstr("days or months"));
}

TEST(Seklima, NorwegianHoursOfNormalTime)
{
    const auto [table, report] = sample("seklima.csv");
    EXPECT_EQ(report.format, "seklima");
    EXPECT_EQ(report.bad_rows, 0u) << "the line of the licence is no row";
    EXPECT_EQ(table.site.name, "Oslo - Blindern");
    EXPECT_EQ(table.site.utc_offset_h, 1.0);
    const std::string seven = "2024-01-16T06:00Z";
    EXPECT_NEAR(at(table, Field::AirTemp, seven), 262.35, 1e-9);
    EXPECT_NEAR(at(table, Field::Wind, seven), 1.7, 1e-9);
    EXPECT_NEAR(at(table, Field::Pressure, seven), 98710.0, 1e-6);
    EXPECT_NEAR(at(table, Field::SnowDepth, seven), 0.24, 1e-9);
    EXPECT_EQ(at(table, Field::SnowDepth, "2024-01-16T09:00Z"), 0.0) << "-1 is no snow";
    EXPECT_NEAR(at(table, Field::Precip, seven) * 3600.0, 0.4, 1e-9);
    EXPECT_TRUE(std::isnan(at(table, Field::Wind, "2024-01-16T08:00Z")));
    std::string english = corpus("seklima.csv");
    english = with(
        english, "Navn;Stasjon;Tid(norsk normaltid);Lufttemperatur;Nedb\xC3\xB8r (1 t);Middelvind",
        "Name;Station;Time(norwegian mean time);Air temperature;Precipitation (1 h);Mean wind "
        "speed");
    EXPECT_NEAR(at(raw(english).table, Field::Precip, seven) * 3600.0, 0.4, 1e-9);
    EXPECT_NEAR(at(raw(english).table, Field::Wind, seven), 1.7, 1e-9);
    const std::string days = with(with(with(corpus("seklima.csv"), "(1 t)", "(d\xC3\xB8gn)"),
                                       "Lufttemperatur;", "Middeltemperatur (d\xC3\xB8gn);"),
                                  "Middelvind", "Middelvind (d\xC3\xB8gn)");
    EXPECT_FALSE(raw(days).table.has(Field::AirTemp)) << "a mean of a day is no hour's";
}

TEST(NewestFirst, ArchivesAreReadFromTheirEnd)
{
    struct File {
        const char* name;
        std::size_t head;
    };
    for (const File& file : {File{"isd_lite.txt", 0},
                             {"snow_station.smet", 0},
                             {"typical_year.epw", 8},
                             {"nsrdb.csv", 3}}) {
        std::string text = corpus(file.name);
        // The sample's two rows are of a typical year.
        if (file.head == 3)
            text = text.substr(0, text.find("2009,")) +
                   "2017,2,1,0,0,0,-9,781,0.5,0,,\n"
                   "2018,1,31,23,30,0,-8,780,0.3,0,,\n";
        std::size_t head = file.head;
        if (std::string(file.name).ends_with("smet")) {
            const std::string above = text.substr(0, text.find("[DATA]"));
            head = static_cast<std::size_t>(std::count(above.begin(), above.end(), '\n')) + 1;
        }
        const ReadResult as_it_is = raw(text), turned = raw(newest_first(text, head));
        EXPECT_THAT(notes(turned.report), HasSubstr("newest row stands first")) << file.name;
        EXPECT_THAT(notes(as_it_is.report), Not(HasSubstr("newest row"))) << file.name;
        expect_same(as_it_is, turned);
    }
}

// Months of different years, the newest first: their days alone tell.
TEST(NewestFirst, ATypicalYearIsTurnedByItsDays)
{
    std::string head;
    {
        std::istringstream in(corpus("typical_year.epw"));
        for (int i = 0; i < 8; ++i) {
            std::string line;
            std::getline(in, line);
            head += line + "\n";
        }
    }
    std::vector<std::string> rows;
    for (const char* day : {"2004,2,27", "2004,2,28", "1998,3,1", "2011,4,1"}) {
        for (int hour = 1; hour <= 24; ++hour)
            rows.push_back(std::string(day) + "," + std::to_string(hour) + ",60,?9,1." +
                           std::to_string(hour) +
                           ",0.5,90,95000,0,0,300,0,0,0,0,0,0,0,180,2,5,5,10.0\n");
    }
    std::string down = head, up = head;
    for (const std::string& row : rows) down += row;
    for (auto row = rows.rbegin(); row != rows.rend(); ++row) up += *row;
    const ReadResult a = raw(down), b = raw(up);
    EXPECT_TRUE(a.report.typical_year);
    EXPECT_TRUE(b.report.typical_year);
    expect_same(a, b);
    // Two rows over New Year's Eve in their order are in order.
    const std::string eve =
        head +
        "2004,12,31,24,60,?9,1,0.5,90,95000,0,0,300,0,0,0,0,0,0,0,180,2,5,5,10.0\n"
        "2005,1,1,1,60,?9,2,0.5,90,95000,0,0,300,0,0,0,0,0,0,0,180,2,5,5,10.0\n";
    EXPECT_NEAR(raw(eve).table[Field::AirTemp][0], 274.15, 1e-9);
}

TEST(Surfrad, TheSampleHasItsColumnsInTheOrderOfTheReadme)
{
    const auto [table, report] = sample("radiation.dat");
    EXPECT_EQ(report.format, "SURFRAD");
    EXPECT_EQ(report.rows, 12u);
    EXPECT_EQ(report.bad_rows, 0u);
    const std::string noon = "2016-06-01T17:00Z";
    EXPECT_NEAR(at(table, Field::Shortwave, noon), 862.2, 1e-9);
    EXPECT_NEAR(at(table, Field::Longwave, noon), 349.2, 1e-9) << "not the temperature of the dome";
    EXPECT_NEAR(at(table, Field::AirTemp, noon), 297.75, 1e-9);
    EXPECT_NEAR(at(table, Field::Wind, noon), 3.1, 1e-9);
    EXPECT_NEAR(at(table, Field::Pressure, noon), 99120.0, 1e-6);
    EXPECT_TRUE(std::isnan(at(table, Field::Pressure, "2016-06-01T17:04Z")));
    EXPECT_EQ(table.site.longitude_deg, -88.373);
}

// What the name of a column says cannot be checked, but winds that nowhere blow and steps that are
// those of another unit can.
TEST(WindUnit, KilometresAnHourUnderMetresASecondAreWarnedOf)
{
    const auto notes_of = [](const char* name, double scale, double digit, double mean) {
        std::string text = std::string("time,air_temp_c,") + name + "\n";
        for (int h = 0; h < 144; ++h) {
            const double whole = std::round(mean * (1.0 + 0.8 * std::sin(0.37 * h)));
            char row[80];
            std::snprintf(row, sizeof row, "2024-03-%02dT%02d:00Z,8.0,%.1f\n", 1 + h / 24, h % 24,
                          std::round(whole * scale / digit) * digit);
            text += row;
        }
        return notes(raw(text).report);
    };
    const auto warned = HasSubstr("its name must say so");
    EXPECT_THAT(notes_of("wind_m_s", 1.0, 1.0, 5.0), Not(warned)) << "whole m/s";
    EXPECT_THAT(notes_of("wind_m_s", 1852.0 / 3600.0, 0.1, 12.0), Not(warned)) << "of whole knots";
    EXPECT_THAT(notes_of("wind_m_s", 0.1, 0.1, 60.0), Not(warned)) << "tenths of m/s";
    EXPECT_THAT(notes_of("wind_m_s", 3.6, 0.1, 4.0), warned) << "whole m/s in km/h";
    EXPECT_THAT(notes_of("wind_m_s", 1.852, 1.0, 6.0), warned) << "whole knots in whole km/h";
    EXPECT_THAT(notes_of("wind_m_s", 0.36, 0.1, 45.0), warned) << "16 m/s for six days";
    EXPECT_THAT(notes_of("wind_kmh", 3.6, 0.1, 4.0), Not(warned));
    EXPECT_THAT(notes_of("wind_kmh", 0.36, 0.1, 45.0), Not(warned));
}

TEST(Nsrdb, AllCellsMayBeQuoted)
{
    const std::string text = corpus("nsrdb.csv");
    std::string quoted;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        quoted += "\"" + with(line + ",", ",", "\",\"");
        quoted.resize(quoted.size() - 2);
        quoted += "\n";
    }
    const ReadResult a = raw(text), b = raw(quoted);
    EXPECT_EQ(b.report.format, "NSRDB CSV");
    expect_same(a, b);
}

}  // namespace
}  // namespace petrichor::weather
