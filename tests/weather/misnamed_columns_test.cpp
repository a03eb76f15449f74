// Columns whose values cannot be what their name says are refused, never half read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>

#include "base/error.h"
#include "weather/readers/read_weather.h"

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

TEST(MisnamedColumns, ShortNamesAndUnitsOfWeatherAreNotDropped)
{
    for (const char* name :
         {"sw", "sw_w_m2", "LW", "Rg", "tair", "p_hPa", "sun (W/m2)", "x_mm_h"}) {
        EXPECT_THAT(refusal(table(std::string("air_temp_c,") + name, 24,
                                  [](int h, int c) { return c ? "3" : usual(h, c); })),
                    HasSubstr(name));
    }
    const auto r = read_weather(table("air_temp_c,sw_in_w_m2,lw_in_w_m2", 24, [](int h, int c) {
        return c == 0 ? usual(h, 0) : c == 1 ? number(h > 6 && h < 18 ? 200 : 0) : "280";
    }));
    EXPECT_EQ(r.table[Field::Shortwave][12], 200.0);
    EXPECT_EQ(r.table[Field::Longwave][12], 280.0);
    EXPECT_EQ(refusal(table("air_temp_c,station,remark", 24,
                            [](int h, int c) { return c ? "x" : usual(h, c); })),
              "");
}

TEST(MisnamedColumns, TextOfTwoBytesALetterIsNamed)
{
    EXPECT_THAT(refusal(std::string("\xFF\xFEt\0i\0m\0e\0", 10)), HasSubstr("UTF-16"));
}

}  // namespace
}  // namespace petrichor::weather
