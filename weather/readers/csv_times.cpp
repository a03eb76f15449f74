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
// "Date/Time", "date time", "Time (UTC)" as date_time, time_utc.
std::string plain_name(std::string_view name)
{
    std::string out;
    for (const char c : lower(trimmed(name))) {
        const bool word = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        if (word)
            out += c;
        else if (!out.empty() && out.back() != '_')
            out += '_';
    }
    while (!out.empty() && out.back() == '_') out.pop_back();
    return out;
}
bool is_stamp_name(std::string_view name)
{
    return is_one_of(plain_name(name),
                     {"time", "time_utc", "datetime", "timestamp", "date_time", "timestamp_utc",
                      "datetime_utc", "date_time_utc", "valid_time", "local_time", "time_local",
                      "observation_time", "obs_time", "time_stamp", "date_utc", "zeitstempel", "zeitpunkt",
                      "datum_zeit", "datum_uhrzeit"});
}
bool is_clock_name(std::string_view name)
{
    return is_one_of(plain_name(name), {"hour", "hr", "time", "time_utc", "hour_utc", "uhrzeit", "zeit", "stunde"});
}
bool is_part_name(std::string_view name, CsvTimes::Part part)
{
    switch (part) {
        case CsvTimes::Year:
            return is_one_of(name, {"year", "yyyy", "yr", "jahr"});
        case CsvTimes::Month:
            return is_one_of(name, {"month", "mo", "monat"});
        case CsvTimes::Day:
            return is_one_of(name, {"day", "dd", "tag"});
        case CsvTimes::DayOfYear:
            return is_one_of(name, {"doy", "day_of_year", "jday", "julian_day"});
        case CsvTimes::Hour:
            return is_one_of(name, {"hour", "hr", "hh", "stunde"});
        case CsvTimes::Minute:
            return is_one_of(name, {"minute", "min"});
        default:
            return is_one_of(name, {"second", "sec"});
    }
}

// 1 to 12 of an English name or its beginning of three letters ("Sept" too); 0 of anything else.
int month_of_name(std::string_view word)
{
    constexpr const char* kMonths[] = {"january",   "february", "march",    "april",
                                       "may",       "june",     "july",     "august",
                                       "september", "october",  "november", "december"};
    const std::string low = lower(word);
    if (low.size() < 3) return 0;
    for (int m = 0; m < 12; ++m) {
        const std::string_view name = kMonths[m];
        if (low == name || low == name.substr(0, 3) || (m == 8 && low == "sept")) return m + 1;
    }
    return 0;
}

// A date of three parts and what comes behind it.
struct DateParts {
    std::array<std::string_view, 3> part;
    char separator = ' ';
    std::string_view rest;
};
bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}
bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
std::optional<DateParts> date_parts(std::string_view text)
{
    text = trimmed(text);
    DateParts d;
    std::size_t at = 0;
    for (std::size_t i = 0; i < d.part.size(); ++i) {
        const std::size_t begin = at;
        if (at >= text.size()) return std::nullopt;
        const bool letters = is_letter(text[at]);
        while (at < text.size() && (letters ? is_letter(text[at]) : is_digit(text[at]))) ++at;
        if (at == begin || at - begin > 9) return std::nullopt;
        d.part[i] = text.substr(begin, at - begin);
        if (i == 2) break;
        const std::size_t gap = at;
        while (at < text.size() && (text[at] == ' ' || text[at] == ',')) ++at;
        if (at == gap && at < text.size() &&
            (text[at] == '/' || text[at] == '-' || text[at] == '.'))
            ++at;
        if (at == gap) return std::nullopt;
        if (i == 0) d.separator = text[gap];
        // One kind of separator, but for "Jan 2, 2021".
        if (i == 1 && text[gap] != d.separator && (text[gap] != ',' || d.separator != ' '))
            return std::nullopt;
    }
    d.rest = text.substr(at);
    return d;
}
// 1/2/2021, 1-2-2021 and 1/2/21: the order of day and month is nowhere said.
bool has_no_order(const DateParts& d)
{
    return (d.separator == '/' || d.separator == '-') && d.part[0].size() <= 2 &&
           d.part[1].size() <= 2 && (d.part[2].size() == 4 || d.part[2].size() == 2) &&
           is_digit(d.part[0][0]) && is_digit(d.part[1][0]) && is_digit(d.part[2][0]);
}

// "1:00 PM", "12:30:15 a.m.", "1 pm" by 24 hours; other texts as they are.
std::optional<std::string> by_24_hours(std::string_view text)
{
    text = trimmed(text);
    std::string low = lower(text);
    for (const char* dotted : {"a.m.", "p.m."})
        if (low.ends_with(dotted)) low.replace(low.size() - 4, 4, {dotted[0], 'm'});
    if (!low.ends_with("am") && !low.ends_with("pm")) return std::string(text);
    const bool afternoon = low[low.size() - 2] == 'p';
    const std::string_view clock = trimmed(std::string_view(low).substr(0, low.size() - 2));
    const std::size_t colon = std::min(clock.find(':'), clock.size());
    const auto hour = to_integer(clock.substr(0, colon));
    if (!hour || *hour < 1 || *hour > 12 || colon > 2) return std::nullopt;
    const auto h = static_cast<int>(*hour % 12 + (afternoon ? 12 : 0));
    const std::string two = (h < 10 ? "0" : "") + std::to_string(h);
    return two + (colon < clock.size() ? std::string(clock.substr(colon)) : std::string(":00"));
}

// The same date and time as ISO 8601; nothing where it is no date of words, dots or an order that
// is known, nor one with AM or PM.
std::optional<std::string> iso_of_date(std::string_view text, DateOrder order)
{
    const auto d = date_parts(text);
    if (!d) return std::nullopt;
    std::string_view year = d->part[2], month, day;
    const int first_month = month_of_name(d->part[0]), second_month = month_of_name(d->part[1]);
    int named = 0;
    if (d->part[0].size() == 4 && is_digit(d->part[0][0])) {
        year = d->part[0];
        month = d->part[1];
        day = d->part[2];
        named = second_month;
    } else if (first_month > 0) {
        named = first_month;
        day = d->part[1];
    } else if (second_month > 0) {
        named = second_month;
        day = d->part[0];
    } else if (d->separator == '.' || (has_no_order(*d) && order == DateOrder::DayFirst)) {
        day = d->part[0];
        month = d->part[1];
    } else if (has_no_order(*d) && order == DateOrder::MonthFirst) {
        month = d->part[0];
        day = d->part[1];
    } else {
        return std::nullopt;
    }
    const auto two = [](std::string_view digits) {
        return digits.size() == 1 ? "0" + std::string(digits) : std::string(digits);
    };
    // 31.12.24, and 1/2/24 in an order that is known: 1970 to 2069.
    std::string whole_year(year);
    if (named == 0 && year.size() == 2 && is_digit(year[0]))
        whole_year.insert(0, year[0] < '7' ? "20" : "19");
    if (whole_year.size() != 4 || !is_digit(year[0]) || day.empty() || day.size() > 2 ||
        !is_digit(day[0]))
        return std::nullopt;
    std::string iso = whole_year + "-" +
                      (named > 0 ? two(std::to_string(named)) : two(month)) + "-" + two(day);
    std::string_view rest = d->rest;
    while (!rest.empty() && (is_blank(rest.front()) || rest.front() == ',')) rest.remove_prefix(1);
    if (!rest.empty() && (rest.front() == 'T' || rest.front() == 't')) rest.remove_prefix(1);
    if (rest.empty()) return iso;
    const auto clock = by_24_hours(rest);
    if (!clock) return std::nullopt;
    // "9:05" is 09:05
    return iso + (clock->size() > 1 && (*clock)[1] == ':' ? " 0" : " ") + *clock;
}

// Time of day: 13:30, 13:30:15, 1330, 13 or 13.5; 24 is the end of the day.
std::optional<std::int64_t> clock_of_cell(std::string_view text)
{
    const auto by_24 = by_24_hours(text);
    if (!by_24) return std::nullopt;
    text = trimmed(*by_24);
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

std::optional<std::int64_t> time_of_cell(std::string_view text, DateOrder order)
{
    if (const auto us = us_from_iso(text)) return us;
    if (const auto iso = iso_of_date(text, order)) return us_from_iso(*iso);
    const auto count = to_integer(text);
    const auto length = trimmed(text).size();
    if (!count || *count < 0) return std::nullopt;
    if (length == 12 || length == 14) {
        // 202401010630 and with seconds
        const long long second = length == 14 ? *count % 100 : 0;
        const long long to_minute = length == 14 ? *count / 100 : *count;
        const long long in_year = to_minute / 100000000;
        if (in_year < 1900 || in_year > 2099 || to_minute % 100 > 59) return std::nullopt;
        return us_from_civil({in_year, static_cast<int>(to_minute / 1000000 % 100),
                              static_cast<int>(to_minute / 10000 % 100),
                              static_cast<int>(to_minute / 100 % 100),
                              static_cast<int>(to_minute % 100), static_cast<double>(second)});
    }
    if (length != 9 && length != 10 && length != 13) return std::nullopt;
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

bool names_zone(std::string_view text, DateOrder order)
{
    const std::string iso =
        us_from_iso(text) ? std::string(text) : iso_of_date(text, order).value_or("");
    const auto here = us_from_iso(iso), east = us_from_iso(iso, 3600.0);
    if (here) return here == east;
    const auto length = trimmed(text).size();
    const bool count = to_integer(text) && time_of_cell(text);
    // Ten digits that begin with a year are a date, as twelve and fourteen are.
    return count && length != 12 && length != 14 && (length != 10 || time_of_cell(text) == *to_integer(text) * kSecond_us);
}

void DateOrders::add(std::string_view cell)
{
    const auto d = date_parts(cell);
    if (!d || !has_no_order(*d)) return;
    const bool day_first = *to_integer(d->part[0]) > 12, month_first = *to_integer(d->part[1]) > 12;
    std::string& example = day_first == month_first ? either_
                           : day_first              ? day_first_
                                                    : month_first_;
    if (example.empty()) example = shown(cell);
    if (short_year_.empty() && d->part[2].size() == 2) short_year_ = shown(cell);
}

DateOrder DateOrders::order() const
{
    if (day_first_.empty() == month_first_.empty()) return DateOrder::Unknown;
    return day_first_.empty() ? DateOrder::MonthFirst : DateOrder::DayFirst;
}

bool CsvTimes::name_zone(const std::vector<std::string_view>& names,
                         const std::vector<std::string_view>& cells) const
{
    for (std::size_t i = 0; i < names.size(); ++i)
        if (uses(i) && lower(names[i]).find("utc") != std::string::npos) return true;
    return stamp != kNone && names_zone(cells[stamp], order);
}

bool CsvTimes::uses(std::size_t column) const
{
    return column == stamp || column == clock ||
           std::find(part.begin(), part.end(), column) != part.end();
}

std::optional<std::int64_t> CsvTimes::time_of(const std::vector<std::string_view>& cells) const
{
    if (stamp != kNone) {
        const auto us = time_of_cell(cells[stamp], order);
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
    const auto holds_time = [](std::string_view cell) {
        return time_of_cell(cell, DateOrder::DayFirst) || time_of_cell(cell, DateOrder::MonthFirst);
    };
    if (names.front().empty() && !first_row.empty() && holds_time(first_row.front())) {
        times.stamp = 0;
        return times;
    }
    const std::size_t date = first_where([](auto n) { return is_one_of(n, {"date", "datum"}); });
    const std::size_t clock = first_where(is_clock_name);
    const std::size_t stamp = first_where(is_stamp_name);
    // "date,time": unless that time is whole by itself.
    const bool whole_stamp = stamp < first_row.size() && holds_time(first_row[stamp]) &&
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
