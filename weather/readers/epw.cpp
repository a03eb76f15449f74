// EnergyPlus weather: 8 header lines, then 35 columns. Hour 1 is 00:00 to 01:00 local standard
// time: its values hold at 01:00, its sums for the hour before. Each column has its own code for
// "missing"; an empty cell is missing, too.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/table_rows.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

struct Column {
    Field field;
    std::size_t index;
    double missing;  // the code for no value; larger numbers of nines mean the same
    double scale, offset;
};
constexpr Column kColumns[] = {
    {Field::AirTemp, 6, 99.9, 1.0, kZeroCelsiusK},
    {Field::DewPoint, 7, 99.9, 1.0, kZeroCelsiusK},
    {Field::RelHumidity, 8, 999.0, 1.0, 0.0},
    {Field::Pressure, 9, 999999.0, 1.0, 0.0},
    {Field::Longwave, 12, 9999.0, 1.0, 0.0},
    {Field::Shortwave, 13, 9999.0, 1.0, 0.0},
    {Field::Direct, 14, 9999.0, 1.0, 0.0},
    {Field::Diffuse, 15, 9999.0, 1.0, 0.0},
    {Field::WindFrom, 20, 999.0, 1.0, 0.0},
    {Field::Wind, 21, 999.0, 1.0, 0.0},
    {Field::Cloud, 22, 99.0, 0.1, 0.0},
    {Field::Visibility, 24, 9999.0, 1000.0, 0.0},
    {Field::SnowDepth, 30, 999.0, 0.01, 0.0},
};

// The column's code, or a longer row of nines: files disagree on how many.
bool is_missing_code(const Column& column, std::string_view text, double value)
{
    if (value <= -999.0 || std::abs(value - column.missing) < 1e-9) return true;
    const auto digits = trimmed(text);
    return value > column.missing &&
           std::all_of(digits.begin(), digits.end(),
                       [](char c) { return c == '9' || c == '.' || c == '0'; }) &&
           digits.front() == '9';
}

}  // namespace

static void read_epw(std::string_view text, RowCollector& rows, const ReadOptions&)
{
    Lines lines(text);
    const auto first = lines.next();
    const auto place = split(first.value_or(""), ',', 16);
    double zone_h = 0.0;
    if (place.size() >= 10) {
        rows.site().name = std::string(place[1]);
        rows.site().latitude_deg = to_number(place[6]).value_or(kMissing);
        rows.site().longitude_deg = to_number(place[7]).value_or(kMissing);
        rows.site().elevation_m = to_number(place[9]).value_or(kMissing);
    }
    const double zone = place.size() >= 10 ? to_number(place[8]).value_or(kMissing) : kMissing;
    if (zone >= -12.0 && zone <= 14.0)
        rows.site().utc_offset_h = zone_h = zone;
    else
        rows.note(ReadNote::Kind::Time, 1, "time",
                  "no time zone in the LOCATION line, taken as UTC");
    for (int i = 1; i < 8; ++i) lines.next();

    std::vector<std::string_view> f;
    const auto date_of = [&](std::string_view line) -> std::optional<RowDate> {
        split(line, ',', f, 5);
        RowDate date{};
        for (std::size_t i = 0; i < 5; ++i) {
            const auto n = i < f.size() ? to_integer(f[i]) : std::nullopt;
            if (!n && i < 4) return std::nullopt;
            // The minutes of a whole hour, which ends with them, are 0 in one file, 60 in another.
            date[i] = i == 4 && n.value_or(0) == 0 ? 60 : n.value_or(0);
        }
        return date;
    };
    const std::vector<TimedRow> table = oldest_first(lines, date_of, rows);
    TypicalYear typical;
    for (const TimedRow& row : table) {
        split(row.text, ',', f, 3);
        if (f.size() < 2) continue;
        const auto year = to_integer(f[0]), month = to_integer(f[1]);
        if (year && month && *month >= 1 && *month <= 12)
            typical.watch(*year, static_cast<int>(*month));
    }
    typical.decide(rows);
    rows.means_of_past(Field::Shortwave);
    rows.means_of_past(Field::Longwave);
    rows.means_of_past(Field::Direct);
    rows.means_of_past(Field::Diffuse);

    for (const TimedRow& row : table) {
        split(row.text, ',', f, 64);
        if (f.size() < 22) {
            rows.bad_row(
                row.line, "",
                "has " + std::to_string(f.size()) + " columns, 35 are usual and 22 needed");
            continue;
        }
        const auto year = to_integer(f[0]), month = to_integer(f[1]), day = to_integer(f[2]),
                   hour = to_integer(f[3]);
        const auto minute = to_integer(f[4]);
        if (!year || !month || !day || !hour || *hour < 1 || *hour > 24) {
            rows.bad_row(row.line, "time",
                         "'" + shown(row.text) + "' does not begin with year,month,day,hour 1..24");
            continue;
        }
        if (typical.typical && *month == 2 && *day == 29) {
            rows.leap_day_left_out(row.line);
            continue;
        }
        // Minutes are 0 or 60 for whole hours; other values end sub-hourly intervals.
        const bool part = minute && *minute > 0 && *minute < 60;
        const auto us = us_from_civil(
            {typical.of(*year), static_cast<int>(*month), static_cast<int>(*day),
             static_cast<int>(*hour) - (part ? 1 : 0), part ? static_cast<int>(*minute) : 0, 0.0});
        if (!us) {
            rows.bad_row(row.line, "time", "'" + shown(row.text) + "': there is no such day");
            continue;
        }
        if (!rows.begin_row(*us - static_cast<std::int64_t>(zone_h * 3600e6), row.line))
            continue;
        for (const Column& c : kColumns) {
            if (c.index >= f.size()) continue;
            if (trimmed(f[c.index]).empty()) {
                rows.missing(c.field);
                continue;
            }
            const auto value = to_number(f[c.index]);
            if (!value) rows.unreadable(c.field, f[c.index]);
            // 77777 is an unlimited ceiling elsewhere; visibility 777.7 km means unlimited.
            else if (is_missing_code(c, f[c.index], *value))
                rows.missing(c.field);
            else
                rows.set(c.field, *value * c.scale + c.offset);
        }
        // Liquid depth (mm) of the last `hours`; 99 hours is "unknown", then it is the hour's.
        if (f.size() >= 34) {
            const auto depth = to_number(f[33]);
            double hours = f.size() >= 35 ? to_number(f[34]).value_or(1.0) : 1.0;
            if (!(hours >= 1.0 && hours < 99.0)) hours = 1.0;
            if (trimmed(f[33]).empty())
                rows.missing(Field::Precip);
            else if (!depth)
                rows.unreadable(Field::Precip, f[33]);
            else if (*depth >= 999.0 || *depth < 0.0)
                rows.missing(Field::Precip);
            else
                rows.fell_before(Field::Precip, *depth, hours);
        }
    }
}

namespace {

bool recognise(const FileHead& head)
{
    return head.begins("LOCATION,");
}

}  // namespace

extern const Reader epw_reader;
const Reader epw_reader{"EPW", "EnergyPlus weather", recognise, read_epw};

}  // namespace petrichor::weather
