// The ways in which tables say when their rows are.
#include "weather/readers/csv_times.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <initializer_list>
#include <string>
#include <vector>

#include "base/error.h"
#include "weather/readers/read_weather.h"
#include "weather/readers/text.h"

namespace petrichor::weather {
namespace {

// The time of a row under a header, as text; "-" when it is none.
std::string time_of(const char* header, const char* row, DateOrder order = DateOrder::Unknown)
{
    const auto names = split(header, ','), cells = split(row, ',');
    auto times = find_csv_times(names, cells);
    times.order = order;
    const auto us = times.time_of(cells);
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

TEST(CsvTimes, DigitsInARow)
{
    EXPECT_EQ(time_of("time", "202401010630"), "2024-01-01T06:30:00Z");
    EXPECT_EQ(time_of("time", "20240101063015"), "2024-01-01T06:30:15Z");
    for (const char* none : {"202413010630", "202401320630", "202401010660", "170401010630", "20240101063075"})
        EXPECT_EQ(time_of("time", none), "-") << none;
    EXPECT_FALSE(names_zone("202401010630"));
    EXPECT_FALSE(names_zone("20240101063015"));
    EXPECT_TRUE(names_zone("1704067200000"));
}

TEST(CsvTimes, NamesOfTheColumn)
{
    for (const char* name : {"Date/Time", "Date Time", "Time (UTC)", "Local Time", "TIMESTAMP",
                             "Observation-Time", "time(utc)"})
        EXPECT_EQ(time_of(name, "2024-02-29T06:30"), "2024-02-29T06:30:00Z") << name;
}

TEST(CsvTimes, MonthsByName)
{
    for (const char* date : {"02-Jan-2021", "2-Jan-2021", "2 Jan 2021", "2 January 2021",
                             "Jan 2 2021", "\"Jan 2, 2021\"", "\"January 02, 2021\"", "jan-02-2021",
                             "2021-Jan-02", "2/JAN/2021", "2.1.2021", "02.01.2021"})
        EXPECT_EQ(time_of("time", date), "2021-01-02T00:00:00Z") << date;
    EXPECT_EQ(time_of("time", "30-Sept-2021 9:05"), "2021-09-30T09:05:00Z");
    EXPECT_EQ(time_of("time", "29-Feb-2024T23:59:30"), "2024-02-29T23:59:30Z");
    EXPECT_EQ(time_of("time", "5 May 2021 13:00+02:00"), "2021-05-05T11:00:00Z");
    for (const char* none :
         {"29-Feb-2023", "02-Jan-21", "2-Ja-2021", "Jan-Feb-2021", "02-Janx-2021", "32 Jan 2021",
          "0-Jan-2021", "Jan 2", "2-Jan/2021", "2 Jan 2021 25:00", "2 Jan 2021 noon", "May 2021 5"})
        EXPECT_EQ(time_of("time", none), "-") << none;
    const char* months[] = {"jan", "feb", "mar", "apr", "may", "jun",
                            "jul", "aug", "sep", "oct", "nov", "dec"};
    for (int m = 0; m < 12; ++m) {
        char iso[32];
        std::snprintf(iso, sizeof iso, "2021-%02d-07T00:00:00Z", m + 1);
        EXPECT_EQ(time_of("time", (std::string("7-") + months[m] + "-2021").c_str()), iso);
    }
}

TEST(CsvTimes, MorningAndAfternoon)
{
    const char* const cases[][2] = {{"12:00 AM", "00:00:00"},    {"12:30 am", "00:30:00"},
                                    {"1:00 AM", "01:00:00"},     {"11:59 a.m.", "11:59:00"},
                                    {"12:00 PM", "12:00:00"},    {"1:00PM", "13:00:00"},
                                    {"01:05:09 pm", "13:05:09"}, {"11 P.M.", "23:00:00"}};
    for (const auto& [clock, shows] : cases) {
        for (const char* date : {"2021-01-02", "02-Jan-2021", "02.01.2021", "2021/01/02"}) {
            const std::string cell = std::string(date) + " " + clock,
                              expected = std::string("2021-01-02T") + shows + "Z";
            EXPECT_EQ(time_of("time", cell.c_str()), expected) << cell;
            EXPECT_EQ(time_of("date,time", (std::string(date) + "," + clock).c_str()), expected)
                << cell;
        }
    }
    for (const char* clock : {"13:00 PM", "0:00 AM", "1:00 XM", "PM", ":30 PM", "123 PM"})
        EXPECT_EQ(time_of("time", (std::string("2021-01-02 ") + clock).c_str()), "-") << clock;
}

TEST(CsvTimes, DayOrMonthFirst)
{
    for (const char* cell : {"1/2/2024 6:00", "01/02/2024 06:00", "01-02-2024 6:00 AM"}) {
        EXPECT_EQ(time_of("time", cell), "-") << cell;
        EXPECT_EQ(time_of("time", cell, DateOrder::DayFirst), "2024-02-01T06:00:00Z") << cell;
        EXPECT_EQ(time_of("time", cell, DateOrder::MonthFirst), "2024-01-02T06:00:00Z") << cell;
    }
    EXPECT_EQ(time_of("time", "13/01/2024", DateOrder::MonthFirst), "-");
    EXPECT_EQ(time_of("date,hour", "1/2/2024,6", DateOrder::MonthFirst), "2024-01-02T06:00:00Z");
    for (const char* cell : {"1/2/24", "01-02-24"}) {
        EXPECT_EQ(time_of("time", cell), "-") << "1924 or 2024, February or the 24th";
        EXPECT_EQ(time_of("time", cell, DateOrder::MonthFirst), "2024-01-02T00:00:00Z") << cell;
        EXPECT_EQ(time_of("time", cell, DateOrder::DayFirst), "2024-02-01T00:00:00Z") << cell;
    }
    EXPECT_EQ(time_of("time", "1/2/70", DateOrder::DayFirst), "1970-02-01T00:00:00Z");
    EXPECT_EQ(time_of("time", "1/2/69", DateOrder::DayFirst), "2069-02-01T00:00:00Z");
    EXPECT_EQ(time_of("time", "31.12.24 23:00"), "2024-12-31T23:00:00Z");
    DateOrders orders;
    orders.add("1/2/2024");
    orders.add("2024-02-01");
    orders.add("2.1.2024");
    EXPECT_EQ(orders.order(), DateOrder::Unknown);
    EXPECT_EQ(orders.either(), "1/2/2024");
    orders.add("1/13/2024 00:00");
    EXPECT_EQ(orders.order(), DateOrder::MonthFirst);
    orders.add("13/1/2024");
    EXPECT_EQ(orders.order(), DateOrder::Unknown) << "both";
}

// What a file of a date in each row says; or the error.
std::string read_dates(std::initializer_list<const char*> dates,
                       DateOrder order = DateOrder::Unknown)
{
    std::string text = "time,air_temp_c\n";
    for (const char* date : dates) text += std::string(date) + ",1\n";
    ReadOptions options;
    options.date_order = order;
    try {
        const auto r = read_weather(text, options);
        return iso_from_us(r.table.time_us.front()) + " " + iso_from_us(r.table.time_us.back()) +
               " " + to_text(r.report);
    } catch (const Error& error) {
        return std::string("error ") + error.what() + " | " + error.fix();
    }
}

TEST(CsvTimes, AFileShowsItsOrderOrIsAsked)
{
    const auto has = [](const std::string& text, const char* part) {
        EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
    };
    const std::string us = read_dates({"1/12/2024 23:00", "1/13/2024 00:00"});
    EXPECT_EQ(us.substr(0, 41), "2024-01-12T23:00:00Z 2024-01-13T00:00:00Z");
    has(us, "dates are read as month/day/year, as '1/13/2024 00:00' can only be");
    const std::string eu = read_dates({"12/01/2024 11:00 PM", "13/01/2024 12:00 AM"});
    EXPECT_EQ(eu.substr(0, 41), "2024-01-12T23:00:00Z 2024-01-13T00:00:00Z");
    has(eu, "dates are read as day/month/year");
    const std::string unknown = read_dates({"01/02/2024 00:00", "02/02/2024 00:00"});
    has(unknown,
        "error weather: column 'time' has dates as '01/02/2024 00:00', and no row shows whether");
    has(unknown, "--date-order dmy or mdy");
    EXPECT_EQ(
        read_dates({"01/02/2024 00:00", "02/02/2024 00:00"}, DateOrder::DayFirst).substr(0, 31),
        "2024-02-01T00:00:00Z 2024-02-02");
    EXPECT_EQ(
        read_dates({"01/02/2024 00:00", "02/02/2024 00:00"}, DateOrder::MonthFirst).substr(0, 31),
        "2024-01-02T00:00:00Z 2024-02-02");
    has(read_dates({"13/01/2024 00:00", "01/14/2024 00:00"}), "not always in the same place");
    // What was said against what is there: no row is turned round in silence.
    has(read_dates({"13/01/2024 00:00", "14/01/2024 00:00"}, DateOrder::MonthFirst),
        "'13/01/2024 00:00' is not a date and time as 2005-10-01T06:00 (month/day/year)");
}

TEST(CsvTimes, YearsOfTwoDigitsAreAskedFor)
{
    EXPECT_NE(read_dates({"20/02/04 00:00", "20/02/04 01:00"}).find("'20/02/04 00:00', whose year has two digits"),
              std::string::npos);
    EXPECT_EQ(read_dates({"20/02/04 00:00", "20/02/04 01:00"}, DateOrder::DayFirst)
                  .rfind("2004-02-20T00:00:00Z 2004-02-20T01:00:00Z", 0),
              0u);
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

// Times of which some alone name their zone are an hour or more apart from what they seem to be.
TEST(CsvTimes, ZonesOfSomeRowsAloneAreTold)
{
    std::string some = "time,air_temp_c\n", all = some;
    for (int h = 0; h < 12; ++h) {
        const std::string time = "2024-01-15T" + std::to_string(h + 10) + ":00";
        some += time + (h < 5 ? "+01:00" : "") + ",4\n";
        all += time + (h < 5 ? "+01:00" : "+00:00") + ",4\n";
    }
    EXPECT_NE(to_text(read_weather(some).report).find("7 of 12 times name no zone"), std::string::npos);
    EXPECT_EQ(to_text(read_weather(all).report).find("name no zone"), std::string::npos);
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
    EXPECT_TRUE(us_from_iso("2024-02-27T06:00+14:00") && us_from_iso("2024-02-27T06:00-12:00"));
    for (const char* nowhere : {"2024-02-27T06:00+26:00", "2024-02-27T06:00+02:75", "2024-02-27T06:00-99"})
        EXPECT_FALSE(us_from_iso(nowhere)) << nowhere;
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
