// Columns whose values cannot be what their name says are refused, never half read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>

#include "base/error.h"
#include "weather/readers/formats.h"
#include "weather/readers/read_weather.h"
#include "weather/text/utf16.h"

namespace petrichor::weather {
namespace {

using testing::HasSubstr;

// `rows` hours of a table with these columns; cell(hour, column) from 0.
std::string table(const std::string& columns, int rows,
                  const std::function<std::string(int, int)>& cell)
{
    std::string text = "time," + columns + "\n";
    const auto count = static_cast<int>(std::count(columns.begin(), columns.end(), ',')) + 1;
    for (int h = 0; h < rows; ++h) {
        char time[40];
        std::snprintf(time, sizeof time, "2024-02-%02dT%02d:00Z", 27 + h / 24, h % 24);
        text += time;
        for (int c = 0; c < count; ++c) text += "," + cell(h, c);
        text += "\n";
    }
    return text;
}
std::string number(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", value);
    return text;
}
std::string refusal(const std::string& text, const ReadOptions& options = {})
{
    try {
        read_weather(text, options);
    } catch (const Error& e) {
        return std::string(e.what()) + " " + e.fix();
    }
    return "";
}

// -3, 80 %, 1013.25 hPa.
std::string usual(int hour, int column)
{
    return number(column == 0 ? -3.0 + 0.1 * hour : column == 1 ? 80.0 - hour % 24 : 1013.25);
}

TEST(MisnamedColumns, SwappedOnesAreRefused)
{
    EXPECT_EQ(refusal(table("air_temp_c,rel_humidity_pct", 48, usual)), "");
    EXPECT_THAT(refusal(table("rel_humidity_pct,air_temp_c", 48, usual)),
                testing::AllOf(HasSubstr("outside"), HasSubstr("name or the unit")));
}

TEST(MisnamedColumns, AnotherUnitIsRefusedAndCanBeLeftOut)
{
    EXPECT_EQ(refusal(table("air_temp_c,rel_humidity_pct,pressure_hpa", 48, usual)), "");
    const std::string pa = table("air_temp_c,rel_humidity_pct,pressure_pa", 48, usual);
    EXPECT_THAT(refusal(pa), HasSubstr("pressure: 48 of 48 values"));
    ReadOptions options;
    options.ignore = {"pressure_pa"};
    EXPECT_EQ(refusal(pa, options), "");
    const auto r = read_weather(pa, options);
    EXPECT_THAT(to_text(r.report), HasSubstr("left out as asked: pressure_pa"));
    EXPECT_NEAR(r.table[Field::Pressure][0], 101325.0, 1.0) << "of the height, not of the column";
    // A few odd values are those of a sensor.
    EXPECT_EQ(refusal(table("air_temp_c,rel_humidity_pct", 48,
                            [](int h, int c) {
                                return h < 12 && c == 0 ? std::string("120") : usual(h, c);
                            })),
              "");
}

TEST(MisnamedColumns, CellsThatAreMostlyNoNumbersAreRefused)
{
    const auto thousands = [](int h, int c) {
        return c == 2 ? std::string("\"101,325.0\"") : usual(h, c);
    };
    EXPECT_THAT(refusal(table("air_temp_c,rel_humidity_pct,pressure_pa", 48, thousands)),
                HasSubstr("'101,325.0' in line 2 and 47 more of 48 cells are not numbers"));
}

TEST(MisnamedColumns, HumidityAsAShareIsRefusedUnlessItsNameSaysSo)
{
    const auto share = [](int h, int c) {
        return c == 1 ? number(0.8 - 0.01 * (h % 24)) : usual(h, c);
    };
    EXPECT_THAT(refusal(table("air_temp_c,rel_humidity_pct", 48, share)), HasSubstr("shares of 1"));
    const auto r = read_weather(table("air_temp_c,rel_humidity_fraction", 48, share));
    EXPECT_NEAR(r.table[Field::RelHumidity][0], 80.0, 1e-9);
}

TEST(MisnamedColumns, ACountOfAGaugeIsNoAmountOfAnHour)
{
    const auto counted = [](int h, int c) {
        return c == 1 ? number(12.4 + 0.2 * (h / 3)) : usual(h, c);
    };
    EXPECT_THAT(refusal(table("air_temp_c,precip_mm", 60, counted)), HasSubstr("never falls"));
    ReadOptions options;
    options.ignore = {"precip_mm"};
    EXPECT_EQ(refusal(table("air_temp_c,precip_mm", 60, counted), options), "");
    // Rain that grows for a while is rain.
    const auto growing = [](int h, int c) {
        return c == 1 ? number(h > 20 && h < 40 ? 0.1 * (h - 20) : 0.0) : usual(h, c);
    };
    EXPECT_EQ(refusal(table("air_temp_c,precip_mm", 60, growing)), "");
    EXPECT_EQ(refusal(table("air_temp_c,precip_mm", 60,
                            [](int h, int c) { return c == 1 ? "0.2" : usual(h, c); })),
              "")
        << "steady drizzle";
}

// A short file with three spells of rain: what stands still above 0 for half a day is a count.
TEST(MisnamedColumns, ACountOfAFewSpellsIsNoAmountOfAnHour)
{
    const auto spells = [](int h) { return 0.3 * (h / 24 + (h % 24 > 5 ? 1 : 0)); };
    const auto counted = [&](int h, int c) { return c == 1 ? number(spells(h)) : usual(h, c); };
    EXPECT_THAT(refusal(table("air_temp_c,precip_mm", 72, counted)), HasSubstr("never falls"));
    const auto amounts = [&](int h, int c) {
        return c == 1 ? number(h > 0 ? spells(h) - spells(h - 1) : 0.0) : usual(h, c);
    };
    EXPECT_EQ(refusal(table("air_temp_c,precip_mm", 72, amounts)), "");
    // Rain that begins and grows to the end of a file.
    const auto begins = [](int h, int c) {
        return c == 1 ? number(h < 60 ? 0.0 : 0.1 * ((h - 60) / 2 + 1)) : usual(h, c);
    };
    EXPECT_EQ(refusal(table("air_temp_c,precip_mm", 72, begins)), "");
}

// 34 to 48 F that no name says: at their humidity no such air is on earth.
TEST(MisnamedColumns, AirDamperThanAnyIsInAnotherScale)
{
    const auto fahrenheit = [](int h, int c) {
        return number(c == 0 ? 34.0 + 14.0 * (h % 24) / 23.0 : 90.0 - h % 24);
    };
    EXPECT_THAT(refusal(table("temp,rh", 48, fahrenheit)),
                testing::AllOf(HasSubstr("damper than any on earth"), HasSubstr("air_temp_f")));
    const auto r = read_weather(table("temp_f,rh", 48, fahrenheit));
    EXPECT_NEAR(r.table[Field::AirTemp][0], 274.2611, 1e-3);
    // A desert's noon and a night of the Gulf are air.
    const auto hot = [](int h, int c) {
        return number(c == 0 ? 30.0 + 18.0 * (h % 24) / 23.0 : 95.0 - 3.2 * (h % 24));
    };
    EXPECT_EQ(refusal(table("air_temp_c,rel_humidity_pct", 48, hot)), "");
}

TEST(MisnamedColumns, ALoneZeroFarFromItsNeighboursIsMissing)
{
    const auto summer = [](int h, int c) {
        return number(c == 0 ? (h % 9 == 4 ? 0.0 : 18.0 + 0.3 * (h % 24)) : 60.0);
    };
    const auto r = read_weather(table("air_temp_c,rel_humidity_pct", 48, summer));
    EXPECT_THAT(to_text(r.report), HasSubstr("5 values of exactly 0"));
    for (const double air_k : r.table[Field::AirTemp]) EXPECT_GT(air_k, 290.0);
    // A winter's day through 0.
    const auto winter = [](int h, int c) {
        return number(c == 0 ? -7.0 + 7.0 * (h % 12) / 6.0 : 60.0);
    };
    EXPECT_THAT(to_text(read_weather(table("air_temp_c,rel_humidity_pct", 48, winter)).report),
                testing::Not(HasSubstr("exactly 0")));
}

TEST(MisnamedColumns, ATableWithoutRowsSaysSo)
{
    const std::string said = refusal("time,air_temp_c,rel_humidity_pct\n");
    EXPECT_THAT(said, testing::AllOf(HasSubstr("no row"), testing::Not(HasSubstr("lines listed"))));
}

// Names of ERA5 and Meteostat in a table of one's own.
TEST(MisnamedColumns, ShortNamesOfServicesAreNotLeftOutInSilence)
{
    for (const std::string name : {"tp", "ssrd", "u10", "d2m", "wspd", "rhum"})
        EXPECT_THAT(refusal(table("air_temp_c," + name, 24, usual)),
                    HasSubstr("not understood: " + name));
}

// Stations' displays count the rain of a day, by a clock of their own.
TEST(MisnamedColumns, ACountOfEachDayIsNoAmountOfAnHour)
{
    for (const int midnight : {0, 7}) {
        const auto of_day = [midnight](int h, int c) {
            const int hour = (h + 24 - midnight) % 24;
            return c == 1 ? number(0.2 * (hour < 15 ? hour : 14)) : usual(h, c);
        };
        EXPECT_THAT(refusal(table("air_temp_c,precip_mm", 72, of_day)),
                    HasSubstr("a total of the day"))
            << midnight;
    }
    // A file of one day that counts up, and one of days, whose rain may be any.
    EXPECT_THAT(refusal(table("air_temp_c,precip_mm", 24,
                              [](int h, int c) { return c == 1 ? number(0.2 * h) : usual(h, c); })),
                HasSubstr("a total since some beginning"));
    std::string days = "time,air_temp_c,precip_mm\n";
    for (int d = 1; d <= 30; ++d)
        days += "2024-04-" + std::string(d < 10 ? "0" : "") + std::to_string(d) + ",8," +
                std::to_string(d % 7) + "\n";
    EXPECT_EQ(refusal(days), "");
    // Showers of every afternoon that end at different hours.
    const auto showers = [](int h, int c) {
        const int hour = h % 24, end = 18 + h / 24 % 3;
        return c == 1 ? number(hour > 12 && hour < end ? 0.5 * (hour - 12) : 0.0) : usual(h, c);
    };
    EXPECT_EQ(refusal(table("air_temp_c,precip_mm", 72, showers)), "");
}

double fallen_mm(const std::string& text)
{
    const ForcingTable t = read_weather(text).table;
    const Field field = t.has(Field::Rain)   ? Field::Rain
                        : t.has(Field::Snow) ? Field::Snow
                                             : Field::Precip;
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < t.rows(); ++i)
        sum += t[field][i] * static_cast<double>(t.time_us[i + 1] - t.time_us[i]) * 1e-6;
    return sum;
}

// What fell is what the rows say, however long they are: all but the last, which no row ends.
TEST(Amounts, AddUpOverUnevenRows)
{
    const std::string head = "time,air_temp_c,precip_mm\n2024-01-01T";
    EXPECT_NEAR(fallen_mm(head + "00:00Z,1,1\n2024-01-01T01:00Z,1,3\n2024-01-01T02:00Z,1,1\n"
                                 "2024-01-01T03:00Z,1,0\n"),
                5.0, 1e-9);
    EXPECT_NEAR(fallen_mm(head + "00:00Z,1,1\n2024-01-01T03:00Z,1,3\n2024-01-01T04:00Z,1,1\n"
                                 "2024-01-01T05:00Z,1,0\n"),
                5.0, 1e-9)
        << "a gap first";
    EXPECT_NEAR(fallen_mm(head + "00:00Z,1,1\n2024-01-01T01:00Z,1,3\n2024-01-01T02:20Z,1,1\n"
                                 "2024-01-01T03:00Z,1,0\n2024-01-01T06:00Z,1,2\n"
                                 "2024-01-01T07:00Z,1,0\n"),
                7.0, 1e-9)
        << "80 and 40 minutes, then a gap";
}

// Inches and centimetres of snow are fresh snow; millimetres are water.
TEST(Amounts, OfSnowAreFreshSnowInCentimetresAndInches)
{
    const auto of = [](const char* name, const char* amount) {
        return fallen_mm(std::string("time,air_temp_c,") + name + "\n2024-01-01T00:00Z,-5," +
                         amount + "\n2024-01-01T01:00Z,-5,0\n");
    };
    EXPECT_NEAR(of("snowfall_mm", "2"), 2.0, 1e-9);
    EXPECT_NEAR(of("snowfall_cm", "2.54"), 25.4 / 7.0, 1e-9);
    EXPECT_NEAR(of("snowfall_inch", "1"), 25.4 / 7.0, 1e-9);
    EXPECT_NEAR(of("rain_inch", "1"), 25.4, 1e-9);
}

TEST(MisnamedColumns, ShortNamesAndUnitsOfWeatherAreNotDropped)
{
    for (const char* name :
         {"sw", "SW_in_x", "LW", "Rg", "tair", "p_hPa", "sun (W/m2)", "x_mm_h"}) {
        EXPECT_THAT(refusal(table(std::string("air_temp_c,") + name, 24,
                                  [](int h, int c) { return c ? "3" : usual(h, c); })),
                    HasSubstr(name));
    }
    const auto r = read_weather(table("air_temp_c,sw_in_w_m2,lw_in_w_m2", 24, [](int h, int c) {
        return c == 0 ? usual(h, 0) : c == 1 ? number(h > 6 && h < 18 ? 200 : 0) : "280";
    }));
    EXPECT_EQ(r.table[Field::Shortwave][12], 200.0);
    EXPECT_EQ(r.table[Field::Longwave][12], 280.0);
    // With a unit the short names are clear.
    const auto s = read_weather(table("tair_c,SW (W/m2),lw_w_m2", 24, [](int h, int c) {
        return c == 0 ? usual(h, 0) : c == 1 ? number(h > 6 && h < 18 ? 200 : 0) : "280";
    }));
    for (const Field f : {Field::AirTemp, Field::Shortwave, Field::Longwave})
        EXPECT_EQ(s.table[f], r.table[f]) << field_info(f).name;
    EXPECT_EQ(refusal(table("air_temp_c,station,remark", 24,
                            [](int h, int c) { return c ? "x" : usual(h, c); })),
              "");
}

// As "Unicode Text" of spreadsheets.
std::string in_utf16(const std::string& ascii, bool big)
{
    std::string out = big ? "\xFE\xFF" : "\xFF\xFE";
    for (const char c : ascii) {
        if (big) out += '\0';
        out += c;
        if (!big) out += '\0';
    }
    return out;
}

TEST(Utf16, IsReadAsTheSameTextInUtf8)
{
    const std::string text = table("air_temp_c,wind_m_s", 24, usual);
    const auto plain = read_weather(text);
    for (const bool big : {false, true}) {
        const auto wide = read_weather(in_utf16(text, big));
        EXPECT_EQ(wide.table.time_us, plain.table.time_us) << big;
        EXPECT_EQ(wide.table[Field::AirTemp], plain.table[Field::AirTemp]) << big;
        EXPECT_THAT(to_text(wide.report), HasSubstr("UTF-16"));
        EXPECT_STREQ(recognise_weather(in_utf16(text, big)).name, "forcing CSV");
    }
    EXPECT_THAT(refusal(in_utf16(text, false) + "x"), HasSubstr("middle of a character"));
    EXPECT_THAT(refusal("\xFF\xFE"), HasSubstr("empty"));
}

TEST(Utf16, LettersBeyondAscii)
{
    using namespace std::literals;
    EXPECT_EQ(utf8_of_utf16("\xFF\xFE\xB0\x00\xAC\x20\x3D\xD8\x27\xDC"s),
              "\xC2\xB0\xE2\x82\xAC\xF0\x9F\x90\xA7");
    EXPECT_EQ(utf8_of_utf16("\xFE\xFF\x00\xB0\x20\xAC\xD8\x3D\xDC\x27"s),
              "\xC2\xB0\xE2\x82\xAC\xF0\x9F\x90\xA7");
    // Halves of pairs.
    EXPECT_EQ(utf8_of_utf16("\xFE\xFF\xD8\x3D\x00\x61"s),
              "\xEF\xBF\xBD"
              "a");
    EXPECT_EQ(utf8_of_utf16("\xFE\xFF\xDC\x27\xD8\x3D"s), "\xEF\xBF\xBD\xEF\xBF\xBD");
}

}  // namespace
}  // namespace petrichor::weather
