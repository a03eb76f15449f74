// NREL TMY3 CSV: a station line, a line of column names with units, 8760 rows. Time 01:00..24:00
// local standard, the end of the hour; -9900 is missing; months come from different years.
#include <algorithm>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

struct Column {
    const char* name;
    Field field;
    double scale, offset;
};
constexpr Column kColumns[] = {
    {"ghi (w/m^2)", Field::Shortwave, 1, 0},
    {"dni (w/m^2)", Field::Direct, 1, 0},
    {"dhi (w/m^2)", Field::Diffuse, 1, 0},
    {"totcld (tenths)", Field::Cloud, 0.1, 0},
    {"dry-bulb (c)", Field::AirTemp, 1, kZeroCelsiusK},
    {"dew-point (c)", Field::DewPoint, 1, kZeroCelsiusK},
    {"rhum (%)", Field::RelHumidity, 1, 0},
    {"pressure (mbar)", Field::Pressure, 100, 0},
    {"wdir (degrees)", Field::WindFrom, 1, 0},
    {"wspd (m/s)", Field::Wind, 1, 0},
    {"hvis (m)", Field::Visibility, 1, 0},
};

struct When {
    long long year = 0;
    int month = 0, day = 0, hour = 0, minute = 0;
};
bool parse_when(std::string_view date, std::string_view time, When& when)
{
    const auto slash = date.find('/');
    const auto second = slash == std::string_view::npos ? slash : date.find('/', slash + 1);
    const auto colon = time.find(':');
    if (second == std::string_view::npos || colon == std::string_view::npos) return false;
    const auto month = to_integer(date.substr(0, slash)),
               day = to_integer(date.substr(slash + 1, second - slash - 1)),
               year = to_integer(date.substr(second + 1));
    const auto after = time.substr(colon + 1);
    const auto hour = to_integer(time.substr(0, colon)),
               minute = to_integer(after.substr(0, after.find(':')));
    if (!month || !day || !year || !hour || !minute) return false;
    if (*month < 1 || *month > 12 || *day < 1 || *day > 31 || *hour < 0 || *hour > 24) return false;
    when = {*year, static_cast<int>(*month), static_cast<int>(*day), static_cast<int>(*hour),
            static_cast<int>(*minute)};
    return true;
}

}  // namespace

static void read_tmy3(std::string_view text, RowCollector& rows, const ReadOptions&)
{
    Lines lines(text);
    const auto place = split(lines.next().value_or(""), ',', 16);
    const auto of_place = [&](std::size_t i) {
        return i < place.size() ? to_number(place[i]).value_or(kMissing) : kMissing;
    };
    if (place.size() > 1) rows.site().name = std::string(place[1]);
    double zone_h = of_place(3);
    rows.site().latitude_deg = of_place(4);
    rows.site().longitude_deg = of_place(5);
    rows.site().elevation_m = of_place(6);
    if (!(zone_h >= -12.0 && zone_h <= 14.0)) {
        rows.note(ReadNote::Kind::Warning, 1, "time",
                  "the line of the place names no time zone: taken as UTC");
        zone_h = 0.0;
    }
    rows.site().utc_offset_h = zone_h;
    const auto names = split(lines.next().value_or(""), ',', 256);
    std::vector<std::size_t> index(std::size(kColumns), names.size());
    std::size_t depth_at = names.size(), hours_at = names.size();
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string name = lower(names[i]);
        for (std::size_t c = 0; c < std::size(kColumns); ++c) {
            if (name == kColumns[c].name) index[c] = i;
        }
        if (name == "lprecip depth (mm)") depth_at = i;
        if (name == "lprecip quantity (hr)") hours_at = i;
    }
    std::vector<std::string> unread;
    for (std::size_t i = 2; i < names.size(); ++i) {
        const bool read = i == depth_at || i == hours_at ||
                          std::find(index.begin(), index.end(), i) != index.end();
        const std::string name = lower(names[i]);
        // Each value has its source and its uncertainty beside it.
        if (!read && !name.ends_with(" source") && name.find("uncert") == std::string::npos)
            unread.emplace_back(names[i]);
    }
    rows.unread_columns(unread);
    std::vector<std::string_view> f;
    Lines again = lines;
    TypicalYear typical;
    while (const auto line = again.next()) {
        split(*line, ',', f, 3);
        When when;
        if (f.size() >= 2 && parse_when(f[0], f[1], when)) typical.watch(when.year, when.month);
    }
    typical.decide(rows);
    for (const Field sun : {Field::Shortwave, Field::Direct, Field::Diffuse})
        rows.means_of_past(sun);

    while (const auto line = lines.next()) {
        if (trimmed(*line).empty()) continue;
        split(*line, ',', f, 256);
        When when;
        if (f.size() < 2 || !parse_when(f[0], f[1], when)) {
            rows.bad_row(lines.number(), "time",
                         "'" + shown(*line) + "' does not begin with MM/DD/YYYY,HH:MM");
            continue;
        }
        if (f.size() < names.size() / 2) {
            rows.wrong_columns(lines.number(), f.size(), names.size());
            continue;
        }
        if (typical.typical && when.month == 2 && when.day == 29) {
            rows.leap_day_left_out(lines.number());
            continue;
        }
        const auto us = us_from_civil(
            {typical.of(when.year), when.month, when.day, when.hour, when.minute, 0.0});
        if (!us) {
            rows.bad_row(lines.number(), "time", "'" + shown(*line) + "': there is no such day");
            continue;
        }
        if (!rows.begin_row(*us - static_cast<std::int64_t>(zone_h * 3600e6), lines.number()))
            continue;
        for (std::size_t c = 0; c < std::size(kColumns); ++c) {
            if (index[c] >= f.size()) continue;
            const auto value = to_number(f[index[c]]);
            if (!value)
                rows.unreadable(kColumns[c].field, f[index[c]]);
            else if (*value <= -9900.0)
                rows.missing(kColumns[c].field);
            else
                rows.set(kColumns[c].field, *value * kColumns[c].scale + kColumns[c].offset);
        }
        if (depth_at < f.size()) {
            const auto depth = to_number(f[depth_at]);
            double hours = hours_at < f.size() ? to_number(f[hours_at]).value_or(1.0) : 1.0;
            if (!(hours >= 1.0 && hours <= 24.0)) hours = 1.0;
            if (!depth)
                rows.unreadable(Field::Precip, f[depth_at]);
            else if (*depth < 0.0)
                rows.missing(Field::Precip);
            else
                rows.fell_before(Field::Precip, *depth, hours);
        }
    }
}

namespace {

bool recognise(const FileHead& head)
{
    return head.lines.size() >= 2 && trimmed(head.lines[1]).rfind("Date (MM/DD/YYYY)", 0) == 0;
}

}  // namespace

extern const Reader tmy3_reader;
const Reader tmy3_reader{"TMY3 CSV", "NREL typical year", recognise, read_tmy3};

}  // namespace petrichor::weather
