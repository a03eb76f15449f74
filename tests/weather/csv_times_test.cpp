// The ways in which tables say when their rows are.
#include "weather/readers/csv_times.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

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

}  // namespace
}  // namespace petrichor::weather
