// The ways in which tables say when their rows are.
#include "weather/readers/csv_times.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "weather/readers/read_weather.h"
#include "weather/readers/text.h"

namespace petrichor::weather {
namespace {

// The time of a row under a header, as text; "-" when it is none.
std::string time_of(const char* header, const char* row)
{
    const auto names = split(header, ','), cells = split(row, ',');
    const auto us = find_csv_times(names, cells).time_of(cells);
    return us ? iso_from_us(*us) : "-";
}

TEST(CsvTimes, OneColumn)
{
    for (const char* name : {"time", "Time_UTC", "datetime", "timestamp", "date", "valid_time"})
        EXPECT_EQ(time_of(name, "2024-02-29T06:30"), "2024-02-29T06:30:00Z") << name;
    EXPECT_EQ(time_of("time", "2024-02-29 06:30:15+02:00"), "2024-02-29T04:30:15Z");
    EXPECT_EQ(time_of("time", "29.02.2024 06:30"), "2024-02-29T06:30:00Z");
    EXPECT_EQ(time_of("time", "1704067200"), "2024-01-01T00:00:00Z");
    EXPECT_EQ(time_of("time", "1704067200000"), "2024-01-01T00:00:00Z");
    EXPECT_EQ(time_of("time", "2024010106"), "2024-01-01T06:00:00Z");
    EXPECT_EQ(time_of(",temp", "2024-01-01 06:00,3"), "2024-01-01T06:00:00Z") << "without a name";
    EXPECT_EQ(time_of("time", "01/02/2024 00:00"), "-") << "January or February";
    EXPECT_EQ(time_of("time", "30.02.2024"), "-");
}

TEST(CsvTimes, DateAndClock)
{
    for (const char* clock : {"6", "06", "6.0", "06:00", "6:00", "06:00:00", "0600", "600"})
        EXPECT_EQ(time_of("date,hour", (std::string("2024-02-29,") + clock).c_str()),
                  "2024-02-29T06:00:00Z")
            << clock;
    EXPECT_EQ(time_of("Time,Date", "13:45,2024-02-29"), "2024-02-29T13:45:00Z");
    EXPECT_EQ(time_of("date,hour", "2024-02-29,24"), "2024-03-01T00:00:00Z");
    EXPECT_EQ(time_of("date,hour", "2024-02-29,6.5"), "2024-02-29T06:30:00Z");
    for (const char* clock : {"25", "-1", "61:00", "0661", "2430", "", "noon", "1e300"})
        EXPECT_EQ(time_of("date,hour", (std::string("2024-02-29,") + clock).c_str()), "-") << clock;
    // A stamp that is whole needs neither.
    EXPECT_EQ(time_of("date,hour,time", "2024-02-29,7,2024-02-29T05:00"), "2024-02-29T05:00:00Z");
    EXPECT_EQ(time_of("date,hour", "2024-02-29 05:00,5"), "2024-02-29T05:00:00Z");
}

TEST(CsvTimes, Parts)
{
    EXPECT_EQ(time_of("year,month,day,hour", "2024,2,29,23"), "2024-02-29T23:00:00Z");
    EXPECT_EQ(time_of("YEAR,MO,DAY,HR,MIN", "2024,02,29,23,15"), "2024-02-29T23:15:00Z");
    EXPECT_EQ(time_of("hour,day,month,year", "24,29,2,2024"), "2024-03-01T00:00:00Z");
    EXPECT_EQ(time_of("year,month,day", "2024,2,29"), "2024-02-29T00:00:00Z");
    EXPECT_EQ(time_of("year,doy,hour", "2024,366,1"), "2024-12-31T01:00:00Z");
    EXPECT_EQ(time_of("year,doy,hour", "2023,366,1"), "-");
    for (const char* row :
         {"2023,2,29,0", "2024,13,1,0", "2024,0,1,0", "2024,1.5,1,0", "2024,1,,0", "24,1,1,0"})
        EXPECT_EQ(time_of("year,month,day,hour", row), "-") << row;
}

TEST(CsvTimes, WhatIsNone)
{
    EXPECT_FALSE(find_csv_times(split("year,month", ','), {}).found());
    EXPECT_FALSE(find_csv_times(split("hour,air_temp_c", ','), {}).found());
    EXPECT_FALSE(find_csv_times(split("", ','), {}).found());
    const auto parts = find_csv_times(split("year,month,day,hour,temp", ','), {});
    EXPECT_TRUE(parts.uses(3));
    EXPECT_FALSE(parts.uses(4));
}

// --file-zone is of times that name no zone; others are not moved by it, and it is said.
TEST(CsvTimes, TheZoneOfAFileIsItsOwn)
{
    for (const char* zoned : {"2024-02-27T06:00Z", "2024-02-27 06:00 UTC", "2024-02-27T07:00+01:00",
                              "1709013600", "1709013600000"})
        EXPECT_TRUE(names_zone(zoned)) << zoned;
    for (const char* bare : {"2024-02-27T06:00", "27.02.2024 06:00", "2024022706", "2024-02-27"})
        EXPECT_FALSE(names_zone(bare)) << bare;
    const auto read = [](const std::string& header, const std::string& time, double zone_h) {
        ReadOptions options;
        options.utc_offset_h = zone_h;
        const auto r = read_weather(header + ",air_temp_c\n" + time + ",1\n", options);
        return std::pair(r.table.time_us.front(), to_text(r.report));
    };
    const std::int64_t six = us_from_iso("2024-02-27T06:00Z").value();
    const std::int64_t two_h = 7200000000LL;
    const auto has = [](const std::string& text, const char* part) {
        return text.find(part) != std::string::npos;
    };
    const auto [bare_us, bare] = read("time", "2024-02-27T06:00", kMissing);
    EXPECT_EQ(bare_us, six);
    EXPECT_TRUE(has(bare, "name no zone: taken as UTC")) << bare;
    const auto [moved_us, moved] = read("time", "2024-02-27T06:00", 2.0);
    EXPECT_EQ(moved_us, six - two_h);
    EXPECT_FALSE(has(moved, "zone")) << moved;
    for (const auto& [header, time] :
         {std::pair("time", "2024-02-27T06:00Z"), std::pair("time", "2024-02-27T07:00+01:00"),
          std::pair("time", "1709013600"), std::pair("time_utc", "2024-02-27T06:00")}) {
        const auto [us, text] = read(header, time, 2.0);
        EXPECT_EQ(us, six) << time;
        EXPECT_TRUE(has(text, "--file-zone is not used")) << text;
        EXPECT_FALSE(has(read(header, time, kMissing).second, "zone")) << time;
    }
}

}  // namespace
}  // namespace petrichor::weather
