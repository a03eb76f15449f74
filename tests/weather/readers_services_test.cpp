// Files of services that people order weather from: each read as its provider describes it, or refused by name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "tests/weather/archive_samples.h"
#include "tests/weather/sample_texts.h"
#include "weather/readers/air_scale.h"

namespace petrichor::weather {
namespace {

using namespace archive_samples;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(AirScale, HumidityTellsTheScale)
{
    using Scale = AirScale::Scale;
    AirScale c, f, k, saturated, wrong;
    for (int i = 0; i < 6; ++i) {
        c.add(20.0 + i, 10.0, 52.5 - 3.0 * i);
        // The same air in F and K.
        f.add(68.0 + 1.8 * i, 50.0, 52.5 - 3.0 * i);
        k.add(293.15 + i, 283.15, 52.5 - 3.0 * i);
        saturated.add(20.0, 19.5, 97.0);
        wrong.add(20.0 + i, 10.0, 90.0);
    }
    EXPECT_EQ(c.scale(), Scale::Celsius);
    EXPECT_EQ(f.scale(), Scale::Fahrenheit);
    EXPECT_EQ(k.scale(), Scale::Kelvin);
    EXPECT_EQ(saturated.scale(), Scale::Unknown);
    EXPECT_EQ(wrong.scale(), Scale::Unknown);
}

TEST(VisualCrossing, HoursInFahrenheitAreTheUnitGroupOfTheStates)
{
    ReadOptions options;
    options.site = {.latitude_deg = 40.0, .longitude_deg = -105.3, .elevation_m = 1655.0};
    options.utc_offset_h = -7.0;
    const auto [table, report] = sample("visual_crossing.csv", options);
    EXPECT_EQ(report.format, "Visual Crossing CSV");
    EXPECT_EQ(report.rows, 6u);
    const std::string eight = "2024-01-16T15:00Z";
    EXPECT_NEAR(at(table, Field::AirTemp, eight), 272.15, 1e-9);
    EXPECT_NEAR(at(table, Field::RelHumidity, eight), 47.11, 1e-9);
    EXPECT_NEAR(at(table, Field::Wind, eight), 6.9 * 0.44704, 1e-9);
    EXPECT_NEAR(at(table, Field::SnowDepth, eight), 0.0762, 1e-9);
    EXPECT_NEAR(at(table, Field::Visibility, eight), 5.1 * 1609.344, 1e-6);
    EXPECT_NEAR(at(table, Field::Precip, eight) * 3600.0, 0.508, 1e-9);
    EXPECT_EQ(at(table, Field::SnowShare, eight), 1.0);
    EXPECT_EQ(at(table, Field::SnowShare, "2024-01-16T16:00Z"), 0.5);
    EXPECT_LT(at(table, Field::Pressure, eight), 85000.0) << "at the station, not at the sea";
    EXPECT_TRUE(std::isnan(at(table, Field::Precip, "2024-01-16T17:00Z")));
    EXPECT_THAT(notes(report), AllOf(HasSubstr("unit group us"), HasSubstr("not read: name")));
    EXPECT_THAT(notes(sample("visual_crossing.csv").report), HasSubstr("--file-zone"));
}

TEST(VisualCrossing, JsonHasItsTimesAndIsMetric)
{
    const auto [table, report] = sample("visual_crossing.json");
    EXPECT_EQ(report.format, "Visual Crossing JSON");
    EXPECT_EQ(report.rows, 5u);
    EXPECT_EQ(table.site.utc_offset_h, 1.0);
    EXPECT_NEAR(table.site.latitude_deg, 46.8, 1e-12);
    const std::string one = "2024-01-16T00:00Z";  // one o'clock there
    EXPECT_NEAR(at(table, Field::AirTemp, one), 267.75, 1e-9);
    EXPECT_NEAR(at(table, Field::Wind, one), 10.1 / 3.6, 1e-9);
    EXPECT_NEAR(at(table, Field::Precip, one) * 3600.0, 0.4, 1e-9);
    EXPECT_NEAR(at(table, Field::SnowDepth, one), 0.624, 1e-9);
    EXPECT_EQ(at(table, Field::SnowShare, one), 1.0);
    EXPECT_NEAR(at(table, Field::Pressure, one), 101120.0, 1e-6) << "of the sea: no elevation is known";
    EXPECT_THAT(notes(report), HasSubstr("group uk"));
}

TEST(VisualCrossing, DaysAndFilesWhoseUnitsNothingTellsAreRefused)
{
    const std::string hours = corpus("visual_crossing.csv");
    EXPECT_THAT(refusal(with(hours, ",temp,", ",tempmax,tempmin,temp,")), HasSubstr("days, no hours"));
    EXPECT_THAT(refusal(with(hours, ",dew,", ",other,")), HasSubstr("names no units"));
    EXPECT_THAT(refusal(with(corpus("visual_crossing.json"), "\"hours\"", "\"none\"")),
                HasSubstr("days, no hours"));
}

TEST(VisualCrossing, AFewChosenColumnsAreKnownAsItsOwn)
{
    const std::string text =
        "datetime,temp,dew,humidity,windspeed,preciptype\n2024-01-16T06:00:00,33,23,66.3,9,\n"
        "2024-01-16T07:00:00,34,23,63.7,9,\n2024-01-16T08:00:00,35,23,61.2,9,\n"
        "2024-01-16T09:00:00,36,23,58.8,9,\n2024-01-16T10:00:00,37,23,56.5,9,\n";
    EXPECT_EQ(raw(text).report.format, "Visual Crossing CSV");
    EXPECT_NEAR(raw(text).table[Field::AirTemp][0], 273.71, 0.01);
    // No column is its own: a table of no units, whose temperatures cannot be Celsius.
    const std::string plain = with(with(text, "preciptype", "note"), "dew,", "dew_point,");
    EXPECT_THAT(refusal(plain), HasSubstr("fit Fahrenheit"));
    EXPECT_EQ(refusal(with(with(plain, "temp,", "temp_f,"), "dew_point,", "dew_point_f,")), "read");
}

TEST(OpenWeather, CsvInCelsius)
{
    ReadOptions options;
    options.site.elevation_m = 574.0;
    const auto [table, report] = sample("openweather.csv", options);
    EXPECT_EQ(report.format, "OpenWeather CSV");
    EXPECT_EQ(report.bad_rows, 0u) << "an hour with two kinds of weather stands there twice";
    EXPECT_NEAR(table.site.latitude_deg, 47.2627, 1e-12);
    EXPECT_EQ(table.site.utc_offset_h, 1.0);
    EXPECT_NEAR(at(table, Field::AirTemp, "2024-01-16T01:00Z"), 274.75, 1e-9);
    EXPECT_NEAR(at(table, Field::Wind, "2024-01-16T01:00Z"), 2.3, 1e-9);
    EXPECT_NEAR(at(table, Field::Visibility, "2024-01-16T02:00Z"), 4000.0, 1e-9);
    EXPECT_LT(at(table, Field::Pressure, "2024-01-16T02:00Z"), 96000.0);
    EXPECT_NEAR(total(table, Field::Precip), 0.4 + 0.6 + 0.4, 1e-9);
    // What fell before 02:00 is in the row of 01:00.
    EXPECT_NEAR(at(table, Field::Precip, "2024-01-16T01:00Z") * 3600.0, 0.6, 1e-9);
    EXPECT_NEAR(at(table, Field::SnowShare, "2024-01-16T01:00Z"), 1.0, 1e-12);
    EXPECT_NEAR(at(table, Field::SnowShare, "2024-01-16T02:00Z"), 0.75, 1e-12);
    EXPECT_THAT(notes(report), HasSubstr("C and m/s"));
}

TEST(OpenWeather, JsonInKelvin)
{
    const auto [table, report] = sample("openweather.json");
    EXPECT_EQ(report.format, "OpenWeather JSON");
    EXPECT_NEAR(at(table, Field::AirTemp, "2024-01-16T01:00Z"), 274.75, 1e-9);
    EXPECT_NEAR(at(table, Field::Cloud, "2024-01-16T00:00Z"), 0.75, 1e-9);
    EXPECT_NEAR(total(table, Field::Precip), 1.0, 1e-9);
    EXPECT_NEAR(table.site.longitude_deg, 11.3945, 1e-12);
    // The list of a forecast, whose amounts are of three hours, and the hours of One Call.
    const auto forecast =
        raw("{\"cod\":\"200\",\"list\":[{\"dt\":1705363200,\"main\":{\"temp\":275,\"feels_like\":"
            "273,\"pressure\":1012,\"humidity\":74},\"weather\":[{\"id\":803}]},{\"dt\":1705374000,"
            "\"main\":{\"temp\":274,\"feels_like\":272,\"pressure\":1012,\"humidity\":74},"
            "\"weather\":[{\"id\":500}],\"rain\":{\"3h\":1.5}}],\"city\":{\"coord\":{\"lat\":47,"
            "\"lon\":11},\"timezone\":3600}}")
            .table;
    EXPECT_NEAR(total(forecast, Field::Precip), 1.5, 1e-9);
    EXPECT_EQ(forecast.site.latitude_deg, 47.0);
    const auto one_call =
        raw("{\"lat\":47,\"lon\":11,\"timezone\":\"Europe/Vienna\",\"timezone_offset\":3600,"
            "\"hourly\":[{\"dt\":1705363200,\"temp\":275,\"feels_like\":273,\"dew_point\":271,"
            "\"humidity\":74,\"clouds\":40,\"wind_speed\":2,\"rain\":{\"1h\":0.5}}]}")
            .table;
    EXPECT_EQ(one_call.site.utc_offset_h, 1.0);
    EXPECT_EQ(at(one_call, Field::Cloud, "2024-01-16T00:00Z"), 0.4);
}

TEST(OpenWeather, TemperaturesWithoutAScaleAndSeveralPlacesAreRefused)
{
    EXPECT_THAT(refusal(with(corpus("openweather.csv"), "dew_point", "dew")),
                HasSubstr("names no units"));
    EXPECT_THAT(refusal(with(corpus("openweather.json"), "\"lat\":47.2627,\"lon\":11.3945,\"main\":{\"temp\":274.75",
                             "\"lat\":48.0,\"lon\":11.3945,\"main\":{\"temp\":274.75")),
                HasSubstr("several places"));
}

TEST(NasaPower, CsvByItsOwnUnitsInSolarTime)
{
    const auto [table, report] = sample("nasa_power.csv");
    EXPECT_EQ(report.format, "NASA POWER CSV");
    EXPECT_NEAR(table.site.elevation_m, 1847.3, 1e-9);
    EXPECT_EQ(table.site.utc_offset_h, -7.0);
    // The mean of 5 to 6 o'clock and that of 6 to 7 meet at 6.
    EXPECT_NEAR(at(table, Field::AirTemp, "2023-06-15T13:00Z"), 273.15 + 0.5 * (11.52 + 13.33), 1e-9);
    EXPECT_NEAR(at(table, Field::Shortwave, "2023-06-15T13:00Z"), 0.5 * (41.2 + 170.5), 1e-9);
    EXPECT_NEAR(at(table, Field::Precip, "2023-06-15T13:00Z") * 3600.0, 0.36, 1e-9);
    EXPECT_NEAR(at(table, Field::Pressure, "2023-06-15T11:00Z"), 81640.0, 1e-6);
    EXPECT_TRUE(std::isnan(at(table, Field::Longwave, "2023-06-15T14:00Z")));
    EXPECT_THAT(notes(report), AllOf(HasSubstr("UTC-7 h"), HasSubstr("not read: QV2M\n")));
    const auto utc = raw(with(corpus("nasa_power.csv"), "in LST", "in UTC")).table;
    EXPECT_EQ(utc.time_us.front(), us_from_iso("2023-06-15T04:00Z").value());
}

TEST(NasaPower, JsonAndWhatIsRefused)
{
    const auto [table, report] = sample("nasa_power.json");
    EXPECT_EQ(report.format, "NASA POWER JSON");
    EXPECT_EQ(report.rows, 3u);
    EXPECT_EQ(table.site.wind_height_m, 2.0);
    EXPECT_NEAR(table.site.elevation_m, 1502.4, 1e-9);
    EXPECT_NEAR(at(table, Field::AirTemp, "2024-01-16T01:00Z"), 273.15 - 3.5, 1e-9);
    EXPECT_NEAR(at(table, Field::Precip, "2024-01-16T01:00Z") * 3600.0, 0.72, 1e-9);
    EXPECT_TRUE(std::isnan(at(table, Field::RelHumidity, "2024-01-16T02:00Z")));
    const std::string csv = corpus("nasa_power.csv");
    EXPECT_THAT(refusal(with(csv, "(mm/hour)", "(mm/day)")), HasSubstr("'mm/day' of PRECTOTCORR"));
    EXPECT_THAT(refusal(with(csv, ",HR,", ",OTHER,")), HasSubstr("days or months"));
    EXPECT_THAT(refusal(with(csv, " in LST", "")), HasSubstr("standard of its times"));
    EXPECT_THAT(refusal(with(corpus("nasa_power.json"), "20240116", "2024011")),
                HasSubstr("days or months"));
}

TEST(Fluxnet, HalfHoursOfTheSubset)
{
    ReadOptions options;
    options.utc_offset_h = 1.0;
    const auto [table, report] = sample("fluxnet_hh.csv", options);
    EXPECT_EQ(report.format, "FLUXNET");
    EXPECT_EQ(report.rows, 4u);
    const std::string half_past = "2013-06-15T08:30Z";
    EXPECT_NEAR(at(table, Field::AirTemp, half_past), 273.15 + 0.5 * (14.2 + 14.9), 1e-9);
    EXPECT_NEAR(at(table, Field::Precip, half_past) * 1800.0, 0.2, 1e-9);
    EXPECT_NEAR(total(table, Field::Precip), 0.8, 1e-9);
    EXPECT_NEAR(at(table, Field::Pressure, "2013-06-15T08:00Z"), 95610.0, 1e-6);
    EXPECT_NEAR(at(table, Field::Reflected, "2013-06-15T08:00Z"), 82.2, 1e-9);
    EXPECT_TRUE(std::isnan(at(table, Field::WindFrom, "2013-06-15T09:30Z")));
    EXPECT_THAT(notes(sample("fluxnet_hh.csv").report), HasSubstr("--file-zone"));
    // Humidity from the deficit where there is no other: the sample's own, within its digits.
    std::string deficit = with(corpus("fluxnet_hh.csv"), ",RH,", ",Q,");
    EXPECT_NEAR(at(raw(deficit, options).table, Field::RelHumidity, "2013-06-15T08:00Z"), 80.01, 0.1);
}

TEST(Fluxnet, AmeriFluxHasPositionsAndDaysAreRefused)
{
    const auto [table, report] = sample("ameriflux.csv");
    EXPECT_EQ(table.site.name, "US-Xyz");
    EXPECT_NEAR(at(table, Field::AirTemp, "2024-02-10T00:00Z"), 270.65, 1e-9);
    EXPECT_NEAR(at(table, Field::SnowDepth, "2024-02-10T00:00Z"), 0.245, 1e-9);
    EXPECT_NEAR(total(table, Field::Precip), 0.3, 1e-9);
    EXPECT_TRUE(std::isnan(at(table, Field::RelHumidity, "2024-02-10T01:00Z")));
    EXPECT_THAT(refusal("TIMESTAMP,TA_F,TA_F_QC,SW_IN_F,VPD_F,P_F\n20130615,14.2,1,200,3,0\n"),
                HasSubstr("holds days"));
}

TEST(MeteoFrance, HoursOfTheClimateBase)
{
    const auto [table, report] = sample("meteo_france_hourly.csv");
    EXPECT_EQ(report.format, "Meteo-France");
    EXPECT_EQ(table.site.name, "CHAMROUSSE");
    EXPECT_NEAR(table.site.elevation_m, 1730.0, 1e-9);
    const std::string seven = "2024-01-16T07:00Z";
    EXPECT_NEAR(at(table, Field::AirTemp, seven), 270.05, 1e-9);
    EXPECT_NEAR(at(table, Field::Pressure, seven), 82290.0, 1e-6);
    EXPECT_NEAR(at(table, Field::SnowDepth, seven), 0.63, 1e-9);
    EXPECT_EQ(at(table, Field::Cloud, seven), 1.0) << "9 oktas: the sky is hidden";
    // J/cm2 of the hour before: what was measured by 7 and by 8 o'clock meets at 7.
    EXPECT_NEAR(at(table, Field::Shortwave, seven), 0.5 * (10.0 + 50.0), 1e-9);
    EXPECT_NEAR(at(table, Field::Longwave, seven), 300.0, 1e-9);
    EXPECT_NEAR(at(table, Field::Precip, "2024-01-16T06:00Z") * 3600.0, 1.2, 1e-9);
    EXPECT_TRUE(std::isnan(at(table, Field::AirTemp, "2024-01-16T08:00Z"))) << "called doubtful";
    EXPECT_THAT(notes(report), AllOf(HasSubstr("1 values that their code calls doubtful"),
                                     HasSubstr("glo")));
    EXPECT_THAT(refusal(with(corpus("meteo_france_hourly.csv"), "AAAAMMJJHH", "AAAAMMJJ")),
                HasSubstr("days or minutes"));
}

TEST(MeteoFrance, SynopMessagesOfOneStation)
{
    const auto [table, report] = sample("meteo_france_synop.csv");
    EXPECT_EQ(report.format, "Meteo-France SYNOP");
    const std::string three = "2024-01-16T03:00Z";
    EXPECT_NEAR(at(table, Field::AirTemp, three), 274.65, 1e-9);
    EXPECT_NEAR(at(table, Field::Pressure, three), 98730.0, 1e-6);
    EXPECT_NEAR(at(table, Field::Cloud, "2024-01-16T00:00Z"), 0.75, 1e-9);
    EXPECT_NEAR(at(table, Field::SnowDepth, "2024-01-16T06:00Z"), 0.02, 1e-9);
    EXPECT_NEAR(total(table, Field::Precip), 4.2, 0.05) << "a trace in its last hour";
    const std::string text = corpus("meteo_france_synop.csv");
    const std::string two = text + with(text.substr(text.find('\n') + 1), "07481;", "07005;");
    EXPECT_THAT(refusal(two), AllOf(HasSubstr("2 stations"), HasSubstr("07005"),
                                    HasSubstr("--station")));
    ReadOptions options;
    options.station = "07481";
    EXPECT_EQ(raw(two, options).table.time_us, table.time_us);
    options.station = "07999";
    EXPECT_THAT(refusal(two, options), HasSubstr("'07999' is not in the file"));
}

TEST(MeteoSwiss, HoursBeginAndTenMinutesEndAtTheirRows)
{
    const auto hours = sample("meteoswiss_hours.csv").table;
    EXPECT_NEAR(at(hours, Field::AirTemp, "2024-01-15T23:00Z"), 273.15 - 11.7, 1e-9);
    EXPECT_NEAR(at(hours, Field::Precip, "2024-01-15T23:00Z") * 3600.0, 0.6, 1e-9);
    EXPECT_NEAR(at(hours, Field::Pressure, "2024-01-15T22:00Z"), 73640.0, 1e-6);
    EXPECT_TRUE(std::isnan(at(hours, Field::RelHumidity, "2024-01-16T00:00Z")));
    const auto [now, report] = sample("meteoswiss_now.csv");
    EXPECT_EQ(report.format, "MeteoSwiss");
    EXPECT_EQ(now.site.name, "TAE");
    EXPECT_NEAR(at(now, Field::AirTemp, "2024-01-16T13:00Z"), 273.55, 1e-9);
    EXPECT_NEAR(at(now, Field::Wind, "2024-01-16T13:00Z"), 7.6 / 3.6, 1e-9);
    EXPECT_NEAR(at(now, Field::Shortwave, "2024-01-16T13:00Z"), 119.0, 1e-9);
    EXPECT_NEAR(total(now, Field::Precip), 0.1, 1e-9);
    EXPECT_TRUE(std::isnan(at(now, Field::WindFrom, "2024-01-16T13:10Z")));
}

TEST(MeteoSwiss, WhatIsNotSureIsRefusedByName)
{
    EXPECT_THAT(refusal("stn;time;tre200h0;rre150h0\nDAV;2024011600;-5.0;0.0\n"),
                AllOf(HasSubstr("IDAweb"), HasSubstr("beginnings or the ends")));
    std::string days = "station_abbr;reference_timestamp;tre200d0;rre150d0\nDAV;16.01.2024 "
                       "00:00;-5.0;0.0\n";
    EXPECT_THAT(refusal(days), HasSubstr("holds days"));
    const std::string text = corpus("meteoswiss_now.csv");
    EXPECT_THAT(refusal(text + "DAV;202401161320;0.5;0;0;0;80;-2;1;1;1;800;1015\n"),
                HasSubstr("several stations"));
}

TEST(Gsod, DaysSayThatTheyAreDays)
{
    const auto [table, report] = sample("gsod.csv");
    EXPECT_EQ(report.format, "GSOD");
    EXPECT_EQ(table.rows(), 24u);
    EXPECT_THAT(notes(report), AllOf(HasSubstr("daily values"), HasSubstr("days are those of UTC"),
                                     HasSubstr("1 days of which no amount")));
    // 6 and 15 o'clock in Denver: -4 and 10 F.
    EXPECT_NEAR(at(table, Field::AirTemp, "2024-01-14T13:00Z"), 253.15, 1e-9);
    EXPECT_NEAR(at(table, Field::AirTemp, "2024-01-14T22:00Z"), 273.15 - 12.2222, 1e-3);
    EXPECT_NEAR(at(table, Field::Pressure, "2024-01-14T13:00Z"), 83840.0, 1e-6);
    EXPECT_NEAR(at(table, Field::Pressure, "2024-01-15T13:00Z"), 101350.0, 1e-6);
    EXPECT_NEAR(at(table, Field::SnowDepth, "2024-01-14T13:00Z"), 0.0508, 1e-9);
    EXPECT_NEAR(at(table, Field::Precip, "2024-01-14T13:00Z") * 86400.0, 2.54, 1e-9);
    EXPECT_EQ(at(table, Field::SnowShare, "2024-01-14T13:00Z"), 1.0);
    EXPECT_TRUE(std::isnan(at(table, Field::Precip, "2024-01-15T13:00Z")));
    EXPECT_TRUE(std::isnan(at(table, Field::Visibility, "2024-01-16T13:00Z")));
}

TEST(WeatherLink, UnitsStandBehindTheNames)
{
    ReadOptions options;
    options.utc_offset_h = -5.0;
    options.site.elevation_m = 300.0;
    options.date_order = DateOrder::MonthFirst;
    const auto [table, report] = sample("weatherlink.csv", options);
    EXPECT_EQ(report.format, "WeatherLink CSV");
    EXPECT_EQ(table.site.name, "Hill Station");
    const std::string quarter = "2024-01-16T05:15Z";
    EXPECT_NEAR(at(table, Field::AirTemp, quarter), 273.15 + 8.6 / 1.8, 1e-9);
    EXPECT_NEAR(at(table, Field::Wind, quarter), 3 * 0.44704, 1e-9);
    EXPECT_NEAR(at(table, Field::WindFrom, quarter), 225.0, 1e-9);
    EXPECT_LT(at(table, Field::Pressure, quarter), 98500.0) << "brought up from the sea";
    EXPECT_NEAR(total(table, Field::Precip), 0.07 * 25.4, 1e-9);
    EXPECT_NEAR(at(table, Field::Precip, quarter) * 900.0, 0.05 * 25.4, 1e-9);
    EXPECT_TRUE(std::isnan(at(table, Field::Wind, "2024-01-16T05:30Z")));
    EXPECT_THAT(notes(report), HasSubstr("inside temp"));
    options.date_order = DateOrder::Unknown;
    EXPECT_EQ(sample("weatherlink.csv", options).table.time_us, table.time_us) << "16 is no month";
    EXPECT_THAT(refusal(with(corpus("weatherlink.csv"), "1/16/24", "1/6/24"), options),
                HasSubstr("--date-order"));
    EXPECT_THAT(refusal(with(corpus("weatherlink.csv"), "- mph", "- furlongs"), options),
                HasSubstr("'furlongs'"));
}

TEST(WeatherLink, TextWithoutUnitsIsRefusedByName)
{
    EXPECT_THAT(
        refusal("                  Temp     Hi    Low   Out    Dew  Wind  Wind   Wind    Hi    Hi   "
                "Wind          Rain    Solar\n"
                "  Date    Time     Out   Temp   Temp   Hum    Pt. Speed   Dir    Run Speed   Dir  "
                "Chill   Bar    Rain  Rad.\n"
                "--------------------------------------------------------------------\n"
                "01/16/24  12:15a   40.6   41.0   40.6    83   35.7   3.0    SW   0.75   8.0   SW   "
                "38.7  30.01  0.02     0\n"),
        HasSubstr("WeatherLink program, which names no units"));
}

// People's tables stand newest first, or with rows that were saved twice.
TEST(Services, NewestFirstAndRowsTwiceAreReadTheSame)
{
    struct Sample {
        const char* name;
        std::size_t header_lines;
    };
    for (const auto& [name, header_lines] :
         {Sample{"visual_crossing.csv", 1}, Sample{"openweather.csv", 1}, Sample{"nasa_power.csv", 18},
          Sample{"fluxnet_hh.csv", 1}, Sample{"meteo_france_hourly.csv", 1},
          Sample{"meteoswiss_hours.csv", 1}, Sample{"weatherlink.csv", 3}, Sample{"meteostat.csv", 1}}) {
        const std::string text = corpus(name);
        std::string head, newest_first, twice;
        std::size_t number = 0;
        Lines lines(text);
        while (const auto line = lines.next()) {
            const std::string whole = std::string(*line) + "\n";
            if (number++ < header_lines) {
                head += whole;
            } else if (!trimmed(*line).empty()) {
                newest_first = whole + newest_first;
                twice += whole + whole;
            }
        }
        const ForcingTable was = raw(text).table;
        ASSERT_GT(was.rows(), 2u) << name;
        for (const std::string& changed : {head + newest_first, head + twice}) {
            const ForcingTable is = raw(changed).table;
            ASSERT_EQ(is.time_us, was.time_us) << name;
            for (std::size_t f = 0; f < kFieldCount; ++f)
                for (std::size_t i = 0; i < was.columns[f].size(); ++i)
                    EXPECT_THAT(is.columns[f].at(i), testing::NanSensitiveDoubleEq(was.columns[f][i]))
                        << name << ' ' << field_info(static_cast<Field>(f)).name << ' ' << i;
        }
    }
}

// JSON of nobody that is known is not called Open-Meteo's: what it is, and what is read.
TEST(UnknownJson, IsToldWhatItIs)
{
    EXPECT_THAT(refusal(R"({"station":1,"values":[1,2],"a":0,"b":0,"c":0,"d":0,"e":0,"f":0})"),
                AllOf(HasSubstr("an object with 'station', 'values', 'a', 'b', 'c', 'd' and 2 more"),
                      HasSubstr("of no kind that is known")));
    EXPECT_THAT(refusal(R"([{"date":"2024-01-01T00:00Z","temperature":3},{}])"),
                HasSubstr("a list of 2, the first an object with 'date', 'temperature'"));
    EXPECT_THAT(refusal("[]"), HasSubstr("an empty list"));
    EXPECT_THAT(refusal("[[1,2],[3,4]]"), HasSubstr("a list of 2, the first a list"));
    EXPECT_THAT(refusal(R"({"hourly":3})"), HasSubstr("an object with 'hourly'"));
    for (const char* text : {"[]", R"({"hourly":3})", R"({"a":1})"})
        EXPECT_THAT(refusal(text), Not(HasSubstr("Open-Meteo response"))) << text;
    try {
        read_weather(R"({"a":1})");
        ADD_FAILURE();
    } catch (const Error& e) {
        for (const char* kind : {"Open-Meteo", "OpenWeather", "Visual Crossing", "NASA POWER",
                                 "PVGIS", "Weather Underground"})
            EXPECT_THAT(e.fix(), HasSubstr(kind));
    }
    // Open-Meteo's own answers that hold no hours.
    EXPECT_THAT(refusal(R"({"latitude":51.2,"generationtime_ms":0.1,"daily":{"time":[]}})"),
                AllOf(HasSubstr("Open-Meteo response without an object 'hourly'"),
                      HasSubstr("'daily'")));
    EXPECT_THAT(refusal(R"({"reason":"Daily API request limit exceeded.","error":true})"),
                HasSubstr("a service's refusal: 'Daily API request limit exceeded.'"));
}

}  // namespace
}  // namespace petrichor::weather
