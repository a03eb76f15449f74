#include "weather/readers/csv_times.h"

#include <algorithm>

#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

constexpr std::int64_t kSecond_us = 1000000, kDay_us = 86400 * kSecond_us;

bool is_one_of(std::string_view name, std::initializer_list<const char*> words)
{
    const std::string low = lower(trimmed(name));
    return std::any_of(words.begin(), words.end(), [&](const char* word) { return low == word; });
}
bool is_stamp_name(std::string_view name)
{
    return is_one_of(
        name, {"time", "time_utc", "datetime", "timestamp", "date_time", "time(utc)", "time (utc)",
               "timestamp_utc", "datetime_utc", "valid_time", "date time"});
}
bool is_clock_name(std::string_view name)
{
    return is_one_of(name, {"hour", "hr", "time", "time_utc", "hour_utc", "time (utc)"});
}
bool is_part_name(std::string_view name, CsvTimes::Part part)
{
    switch (part) {
        case CsvTimes::Year:
            return is_one_of(name, {"year", "yyyy", "yr"});
        case CsvTimes::Month:
            return is_one_of(name, {"month", "mo"});
        case CsvTimes::Day:
            return is_one_of(name, {"day", "dd"});
        case CsvTimes::DayOfYear:
            return is_one_of(name, {"doy", "day_of_year", "jday", "julian_day"});
        case CsvTimes::Hour:
            return is_one_of(name, {"hour", "hr", "hh"});
        case CsvTimes::Minute:
            return is_one_of(name, {"minute", "min"});
        default:
            return is_one_of(name, {"second", "sec"});
    }
}

// 31.12.2024 with 13:00 or 13:00:00 behind it.
std::optional<std::int64_t> time_with_dots(std::string_view text)
{
    text = trimmed(text);
    if (text.size() < 10 || text[2] != '.' || text[5] != '.') return std::nullopt;
    const std::string iso = std::string(text.substr(6, 4)) + "-" + std::string(text.substr(3, 2)) +
                            "-" + std::string(text.substr(0, 2)) + std::string(text.substr(10));
    return us_from_iso(iso);
}

// Time of day: 13:30, 13:30:15, 1330, 13 or 13.5; 24 is the end of the day.
std::optional<std::int64_t> clock_of_cell(std::string_view text)
{
    text = trimmed(text);
    if (text.find(':') != std::string_view::npos) {
        // "9:05" is 09:05
        const std::string two = text.size() > 1 && text[1] == ':' ? "0" : "";
        const auto us = us_from_iso("1970-01-01 " + two + std::string(text));
        return us && *us >= 0 && *us <= kDay_us ? us : std::nullopt;
    }
    const auto number = to_number(text);
    if (!number || *number < 0.0) return std::nullopt;
    if (text.size() >= 3 && text.find('.') == std::string_view::npos) {
        const auto hhmm = static_cast<int>(std::min(*number, 1e6));
        if (hhmm > 2400 || hhmm % 100 > 59) return std::nullopt;
        return (hhmm / 100 * 60 + hhmm % 100) * 60 * kSecond_us;
    }
    if (*number > 24.0) return std::nullopt;
    return static_cast<std::int64_t>(*number * 3600.0 + 0.5) * kSecond_us;
}

std::optional<int> whole(std::string_view cell, int low, int high)
{
    const auto number = to_number(cell);
    if (!number || *number < low || *number > high) return std::nullopt;
    const int value = static_cast<int>(*number);
    if (static_cast<double>(value) != *number) return std::nullopt;
    return value;
}

}  // namespace

std::optional<std::int64_t> time_of_cell(std::string_view text)
{
    if (const auto us = us_from_iso(text)) return us;
    if (const auto us = time_with_dots(text)) return us;
    const auto count = to_integer(text);
    const auto length = trimmed(text).size();
    if (!count || *count < 0 || (length != 9 && length != 10 && length != 13)) return std::nullopt;
    if (length == 13) return *count * 1000;
    // Ten digits may be 2024010106: when they begin with a year they are no count of seconds.
    const long long year = *count / 1000000;
    if (length == 10 && year >= 1900 && year <= 2099) {
        return us_from_civil({year, static_cast<int>(*count / 10000 % 100),
                              static_cast<int>(*count / 100 % 100), static_cast<int>(*count % 100),
                              0, 0.0});
    }
    return *count * kSecond_us;
}

bool names_zone(std::string_view text)
{
    const auto here = us_from_iso(text), east = us_from_iso(text, 3600.0);
    if (here) return here == east;
    const auto length = trimmed(text).size();
    const bool count = to_integer(text) && time_of_cell(text);
    // Ten digits that begin with a year are a date.
    return count && (length != 10 || time_of_cell(text) == *to_integer(text) * kSecond_us);
}

bool CsvTimes::name_zone(const std::vector<std::string_view>& names,
                         const std::vector<std::string_view>& cells) const
{
    for (std::size_t i = 0; i < names.size(); ++i)
        if (uses(i) && lower(names[i]).find("utc") != std::string::npos) return true;
    return stamp != kNone && names_zone(cells[stamp]);
}

bool CsvTimes::uses(std::size_t column) const
{
    return column == stamp || column == clock ||
           std::find(part.begin(), part.end(), column) != part.end();
}

std::optional<std::int64_t> CsvTimes::time_of(const std::vector<std::string_view>& cells) const
{
    if (stamp != kNone) {
        const auto us = time_of_cell(cells[stamp]);
        if (!us || clock == kNone) return us;
        // A date that brings its own time needs no clock.
        if (*us % kDay_us != 0) return us;
        const auto of_day = clock_of_cell(cells[clock]);
        return of_day ? std::optional(*us + *of_day) : std::nullopt;
    }
    const auto cell = [&](Part p, int low, int high, int without) {
        return part[p] == kNone ? std::optional(without) : whole(cells[part[p]], low, high);
    };
    const auto year = cell(Year, 1500, 2600, 0), month = cell(Month, 1, 12, 1);
    const auto day = cell(Day, 1, 31, 1), day_of_year = cell(DayOfYear, 1, 366, 1);
    const auto minute = cell(Minute, 0, 59, 0), second = cell(Second, 0, 59, 0);
    const auto of_day =
        part[Hour] == kNone ? std::optional<std::int64_t>(0) : clock_of_cell(cells[part[Hour]]);
    if (!year || !month || !day || !day_of_year || !minute || !second || !of_day)
        return std::nullopt;
    if (part[DayOfYear] != kNone && *day_of_year == 366 && !is_leap_year(*year))
        return std::nullopt;
    const auto midnight = us_from_civil({*year, *month, *day, 0, 0, 0.0});
    if (!midnight) return std::nullopt;
    return *midnight + (*day_of_year - 1) * kDay_us + *of_day +
           (*minute * 60 + *second) * kSecond_us;
}

std::string CsvTimes::shown_cells(const std::vector<std::string_view>& cells) const
{
    std::string out;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (uses(i)) out.append(out.empty() ? "" : " ").append(shown(cells[i]));
    }
    return out;
}

CsvTimes find_csv_times(const std::vector<std::string_view>& names,
                        const std::vector<std::string_view>& first_row)
{
    CsvTimes times;
    const auto first_where = [&](auto accepts) {
        const auto at = std::find_if(names.begin(), names.end(), accepts);
        return at == names.end() ? CsvTimes::kNone : static_cast<std::size_t>(at - names.begin());
    };
    // Programs that write tables put the times first and often leave their name out.
    if (names.front().empty() && !first_row.empty() && time_of_cell(first_row.front())) {
        times.stamp = 0;
        return times;
    }
    const std::size_t date = first_where([](auto n) { return is_one_of(n, {"date"}); });
    const std::size_t clock = first_where(is_clock_name);
    const std::size_t stamp = first_where(is_stamp_name);
    // "date,time": unless that time is whole by itself.
    const bool whole_stamp = stamp < first_row.size() &&
                             time_of_cell(first_row[stamp]).has_value() &&
                             trimmed(first_row[stamp]).size() >= 8;
    if (date != CsvTimes::kNone && !whole_stamp) {
        times.stamp = date;
        times.clock = clock;
        return times;
    }
    if (stamp != CsvTimes::kNone) {
        times.stamp = stamp;
        return times;
    }
    std::array<std::size_t, CsvTimes::kParts> part{};
    for (std::size_t p = 0; p < part.size(); ++p) {
        part[p] =
            first_where([&](auto n) { return is_part_name(n, static_cast<CsvTimes::Part>(p)); });
    }
    const bool day =
        (part[CsvTimes::Month] != CsvTimes::kNone && part[CsvTimes::Day] != CsvTimes::kNone) ||
        part[CsvTimes::DayOfYear] != CsvTimes::kNone;
    if (part[CsvTimes::Year] != CsvTimes::kNone && day) times.part = part;
    return times;
}

}  // namespace petrichor::weather
