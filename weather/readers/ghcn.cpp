// NOAA GHCN-daily: .dly (fixed columns, a line a month and element), CSV by year or station
// (ID,YYYYMMDD,ELEMENT,VALUE) and the access CSV with a column an element. Tenths of C, of mm and
// of m/s; snow depth in mm. A value with a quality flag has failed a check and is left out. A file
// with a column an element whose temperatures have decimals was ordered in C and mm.
//
// A day becomes eight rows: temperature swings between its minimum at 6 and its maximum at 15
// o'clock, the rest is spread evenly. Times are taken as UTC unless the site's longitude is given.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/error.h"
#include "weather/readers/days.h"
#include "weather/readers/formats.h"
#include "weather/readers/tables.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

struct Day {
    double low_c = kMissing, high_c = kMissing, mean_c = kMissing, precip_mm = kMissing,
           wind_m_s = kMissing, depth_m = kMissing, fresh_mm = kMissing;
    double total_mm = kMissing, total_days = kMissing;  ///< of several days that end with this one
    std::size_t line = 0;
};
using Days = std::map<std::int64_t, Day>;

// Columns of the access CSV that mean something here; flags of values with them.
bool is_read(std::string_view name)
{
    constexpr std::string_view kFlags = "_ATTRIBUTES";
    if (name.ends_with(kFlags)) name.remove_suffix(kFlags.size());
    for (const char* known :
         {"STATION", "NAME", "DATE", "LATITUDE", "LONGITUDE", "ELEVATION", "TMIN", "TMAX", "TAVG",
          "PRCP", "AWND", "SNWD", "SNOW", "MDPR", "DAPR"}) {
        if (name == known) return true;
    }
    return false;
}

// One value of a day; what is not possible or given twice is noted.
// `whole_units`: C, mm and m/s instead of their tenths.
void put(RowCollector& rows, Day& day, std::size_t line, std::string_view element,
         std::string_view text, bool whole_units = false)
{
    struct Element {
        const char* name;
        double Day::*member;
        double scale, low, high;
    };
    constexpr Element kElements[] = {
        {"TMIN", &Day::low_c, 0.1, -100, 65},  {"TMAX", &Day::high_c, 0.1, -100, 65},
        {"TAVG", &Day::mean_c, 0.1, -100, 65}, {"PRCP", &Day::precip_mm, 0.1, 0, 2000},
        {"AWND", &Day::wind_m_s, 0.1, 0, 110}, {"SNWD", &Day::depth_m, 0.001, 0, 30},
        {"SNOW", &Day::fresh_mm, 1, 0, 5000},  {"MDPR", &Day::total_mm, 0.1, 0, 5000},
        {"DAPR", &Day::total_days, 1, 1, 100}};
    const auto known = std::find_if(std::begin(kElements), std::end(kElements),
                                    [&](const Element& e) { return element == e.name; });
    if (known == std::end(kElements) || trimmed(text).empty()) return;
    const auto number = to_number(text);
    if (number && *number == -9999.0) return;
    const bool tenths = known->scale == 0.1;
    const double value = number ? *number * (tenths && whole_units ? 1.0 : known->scale) : kMissing;
    if (!(value >= known->low && value <= known->high)) {
        rows.note(ReadNote::Kind::OutOfRange, line, known->name,
                  std::string("'")
                      .append(shown(trimmed(text)))
                      .append("' is not possible, taken as missing"));
        return;
    }
    if (!std::isnan(day.*known->member))
        rows.note(ReadNote::Kind::Time, line, known->name,
                  "second value for the same day, the last one holds");
    day.*known->member = value;
    day.line = line;
}

constexpr std::size_t kMostDays = 400000;

// "T,,N": measurement, quality and source flag. Any quality flag means that a check failed.
bool failed_check_of(std::string_view attributes)
{
    const auto first = attributes.find(',');
    if (first == std::string_view::npos) return false;
    const auto rest = attributes.substr(first + 1);
    return !trimmed(rest.substr(0, rest.find(','))).empty();
}

// A total of several days (MDPR over DAPR days) goes evenly to those of them without their own.
void share_totals(RowCollector& rows, Days& days)
{
    constexpr std::int64_t kDay_us = 86400000000LL;
    std::size_t shared = 0, unknown = 0;
    std::vector<std::pair<std::int64_t, Day>> totals;
    for (const auto& [us, day] : days) {
        if (!std::isnan(day.total_mm)) totals.emplace_back(us, day);
    }
    for (const auto& [us, total] : totals) {
        if (std::isnan(total.total_days)) {
            ++unknown;
            continue;
        }
        std::vector<std::int64_t> open;
        for (int back = 0; back < static_cast<int>(total.total_days); ++back) {
            const auto at = days.find(us - back * kDay_us);
            if (at == days.end() || std::isnan(at->second.precip_mm))
                open.push_back(us - back * kDay_us);
        }
        for (const std::int64_t day_us : open) {
            Day& day = days[day_us];
            if (day.line == 0) day.line = total.line;
            day.precip_mm = total.total_mm / static_cast<double>(open.size());
        }
        shared += !open.empty();
    }
    if (shared)
        rows.note(ReadNote::Kind::Info, 0, "MDPR",
                  std::to_string(shared) + " totals of several days shared evenly among them");
    if (unknown)
        rows.note(ReadNote::Kind::Warning, 0, "MDPR",
                  std::to_string(unknown) +
                      " totals of several days without their number (DAPR), not used");
}

void read_fixed(std::string_view text, RowCollector& rows, Days& days)
{
    Lines lines(text);
    while (const auto line = lines.next()) {
        if (trimmed(*line).empty()) continue;
        const auto year = line->size() >= 21 ? to_integer(line->substr(11, 4)) : std::nullopt;
        const auto month = line->size() >= 21 ? to_integer(line->substr(15, 2)) : std::nullopt;
        if (!year || !month || *month < 1 || *month > 12 || *year < 1500 || *year > 2600) {
            rows.bad_row(lines.number(), "time",
                         "'" + shown(*line) + "' has no year and month in columns 12 to 17");
            continue;
        }
        const auto element = line->substr(17, 4);
        for (int d = 0; d < 31; ++d) {
            const std::size_t at = 21 + static_cast<std::size_t>(d) * 8;
            if (at + 5 > line->size()) break;
            const auto cell = line->substr(at, 5);
            const bool failed_check = at + 6 < line->size() && line->substr(at + 6, 1) != " ";
            if (trimmed(cell) == "-9999" || failed_check) continue;
            const auto us = us_from_civil({*year, static_cast<int>(*month), d + 1, 0, 0, 0.0});
            if (!us || days.size() > kMostDays) continue;
            put(rows, days[*us], lines.number(), element, cell);
        }
    }
}

// Whether a table with a column an element is in whole C and mm: the archive's own tenths never
// have decimals.
//   throws  Error for the units of the other kind of order
bool whole_units_of(std::string_view text)
{
    Lines lines(text);
    const auto names = split(lines.next().value_or(""), ',', 256);
    bool temperatures = false, amounts = false;
    std::vector<std::string_view> f;
    for (auto line = lines.next(); line && lines.number() < 4000; line = lines.next()) {
        split(*line, ',', f, 256);
        for (std::size_t i = 0; i < f.size() && i < names.size(); ++i) {
            const bool point = to_number(f[i]) && f[i].find('.') != std::string_view::npos;
            if (names[i] == "TMAX" || names[i] == "TMIN" || names[i] == "TAVG")
                temperatures = temperatures || point;
            if (names[i] == "PRCP") amounts = amounts || point;
        }
    }
    if (amounts && !temperatures) {
        throw Error(
            "weather: GHCN-daily: precipitation has decimals and temperatures have none: this "
            "table "
            "is in inches and Fahrenheit",
            "Order it with metric units, or take the station's file from the archive.");
    }
    return temperatures;
}

void read_table(std::string_view text, RowCollector& rows, Days& days)
{
    bool whole_units = false;
    Lines lines(text);
    std::vector<std::string> names;
    std::vector<std::size_t>
        flags_of;  // column of a column's attributes; as many as there are: none
    std::string station;
    bool others = false;
    std::vector<std::string_view> f;
    while (const auto line = lines.next()) {
        if (trimmed(*line).empty()) continue;
        split(*line, ',', f, 256);
        if (lines.number() == 1 && lower(*line).find("station") != std::string::npos) {
            for (const auto n : f) names.emplace_back(n);
            for (const std::string& n : names)
                flags_of.push_back(static_cast<std::size_t>(
                    std::find(names.begin(), names.end(), n + "_ATTRIBUTES") - names.begin()));
            std::vector<std::string> unread;
            for (const std::string& n : names)
                if (!is_read(n)) unread.push_back(n);
            rows.unread_columns(unread);
            whole_units = whole_units_of(text);
            if (whole_units)
                rows.note(ReadNote::Kind::Info, 1, "",
                          "temperatures have decimals: taken as C, mm and m/s, not tenths");
            continue;
        }
        if (!names.empty()) {
            std::optional<std::int64_t> us;
            for (std::size_t i = 0; i < f.size() && i < names.size(); ++i) {
                if (names[i] == "DATE") us = us_from_iso(f[i]);
                if (names[i] == "LATITUDE" && std::isnan(rows.site().latitude_deg))
                    rows.site().latitude_deg = to_number(f[i]).value_or(kMissing);
                if (names[i] == "LONGITUDE" && std::isnan(rows.site().longitude_deg))
                    rows.site().longitude_deg = to_number(f[i]).value_or(kMissing);
                if (names[i] == "ELEVATION" && std::isnan(rows.site().elevation_m))
                    rows.site().elevation_m = to_number(f[i]).value_or(kMissing);
            }
            if (!us) {
                rows.bad_row(lines.number(), "time", "'" + shown(*line) + "' has no DATE");
                continue;
            }
            if (days.size() > kMostDays) continue;
            for (std::size_t i = 0; i < f.size() && i < names.size(); ++i) {
                if (flags_of[i] < f.size() && failed_check_of(f[flags_of[i]])) continue;
                put(rows, days[*us], lines.number(), names[i], f[i], whole_units);
            }
            continue;
        }
        const auto date = f.size() >= 4 && f[1].size() == 8 ? us_from_iso(f[1]) : std::nullopt;
        if (!date) {
            rows.bad_row(lines.number(), "",
                         "'" + shown(*line) + "' is not ID,YYYYMMDD,ELEMENT,VALUE");
            continue;
        }
        if (station.empty()) station = std::string(f[0]);
        if (station != f[0]) {
            others = true;
            continue;
        }
        const bool failed_check = f.size() >= 6 && !f[5].empty();
        if (failed_check || days.size() > kMostDays) continue;
        put(rows, days[*date], lines.number(), f[2], f[3]);
    }
    if (others)
        rows.note(ReadNote::Kind::Info, 0, "station",
                  "several stations in the file, only " + shown(station) + " is used");
}

}  // namespace

static void read_ghcn_daily(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Days days;
    const auto first = Lines(text).next().value_or("");
    if (first.find(',') == std::string_view::npos)
        read_fixed(text, rows, days);
    else
        read_table(text, rows, days);
    share_totals(rows, days);
    const double longitude = std::isnan(options.site.longitude_deg) ? rows.site().longitude_deg
                                                                    : options.site.longitude_deg;
    const double zone_h = zone_of_longitude_h(longitude);
    DaysOfWeather of_days;
    for (const auto& [us, day] : days) {
        DayOfWeather& d = of_days[us];
        d.low_c = day.low_c;
        d.high_c = day.high_c;
        d.mean_c = day.mean_c;
        d.precip_mm = day.precip_mm;
        d.wind_m_s = day.wind_m_s;
        d.depth_m = day.depth_m;
        d.line = day.line;
        // Fresh snow: 10 mm of it hold about 1 mm of water, and no more than fell.
        if (day.precip_mm > 0.0 && !std::isnan(day.fresh_mm))
            d.snow_share = std::min(0.1 * day.fresh_mm / day.precip_mm, 1.0);
    }
    put_days(of_days, zone_h, rows);
}

namespace {

bool recognise(const FileHead& head)
{
    const auto line = head.lines.front();
    if (line.size() >= 21 && line.find(',') == std::string_view::npos &&
        to_integer(line.substr(11, 4)) && to_integer(line.substr(15, 2)) &&
        !to_number(line.substr(0, 3))) {
        return true;
    }
    const auto f = split(line, ',', 8);
    if (f.size() >= 4 && f[0].size() == 11 && f[1].size() == 8 && to_integer(f[1]) &&
        f[2].size() == 4) {
        return true;
    }
    return head.first.find("station") != std::string::npos &&
           head.first.find("tmax") != std::string::npos;
}

}  // namespace

extern const Reader ghcn_daily_reader;
const Reader ghcn_daily_reader{"GHCN-daily", "NOAA, .dly or CSV by station or year", recognise,
                               read_ghcn_daily};

}  // namespace petrichor::weather
