// NOAA SURFRAD daily files: a name, a line with the place, then rows of 48 numbers: year, day of
// year, month, day, hour, minute, decimal hour, zenith, then pairs of value and quality. -9999.9 is
// missing; quality 0 is good,
// anything else is impossible, doubtful or not there. A row a minute, before 2009 one every three.
// UTC.
#include <cmath>

#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

static void read_surfrad(std::string_view text, RowCollector& rows, const ReadOptions&)
{
    struct Column {
        Field field;
        std::size_t index;
        double scale, offset;
    };
    constexpr Column kColumns[] = {
        {Field::Shortwave, 8, 1, 0},
        {Field::Direct, 12, 1, 0},
        {Field::Diffuse, 14, 1, 0},
        {Field::Longwave, 16, 1, 0},
        {Field::AirTemp, 38, 1, kZeroCelsiusK},
        {Field::RelHumidity, 40, 1, 0},
        {Field::Wind, 42, 1, 0},
        {Field::WindFrom, 44, 1, 0},
        {Field::Pressure, 46, 100, 0},
    };
    Lines lines(text);
    rows.site().name = std::string(trimmed(lines.next().value_or("")));
    const auto place_line = lines.next().value_or("");
    const auto place = words(place_line, 8);
    if (place.size() >= 3) {
        rows.site().latitude_deg = to_number(place[0]).value_or(kMissing);
        // All stations are in the west; older files give west as positive.
        rows.site().longitude_deg = -std::abs(to_number(place[1]).value_or(kMissing));
        rows.site().elevation_m = to_number(place[2]).value_or(kMissing);
    }
    rows.site().temp_height_m = 10.0;
    rows.site().wind_height_m = 10.0;
    std::vector<std::string_view> w;
    while (const auto line = lines.next()) {
        words(*line, w, 96);
        // Days that were put into one file keep their headings.
        if (w.empty() || trimmed(*line) == rows.site().name || *line == place_line) continue;
        if (w.size() < 48) {
            rows.bad_row(lines.number(), "",
                         "has " + std::to_string(w.size()) + " columns, 48 are needed");
            continue;
        }
        const auto year = to_integer(w[0]), month = to_integer(w[2]), day = to_integer(w[3]),
                   hour = to_integer(w[4]), minute = to_integer(w[5]);
        std::optional<std::int64_t> us;
        if (year && month && day && hour && minute && *month >= 1 && *month <= 12 && *day >= 1 &&
            *day <= 31 && *hour >= 0 && *hour <= 24 && *minute >= 0 && *minute < 60) {
            us = us_from_civil({*year, static_cast<int>(*month), static_cast<int>(*day),
                                static_cast<int>(*hour), static_cast<int>(*minute), 0.0});
        }
        if (!us) {
            rows.bad_row(lines.number(), "time",
                         "'" + shown(*line) + "' does not begin with a time");
            continue;
        }
        if (!rows.begin_row(*us, lines.number())) continue;
        for (const Column& c : kColumns) {
            const auto value = to_number(w[c.index]);
            const auto quality = to_number(w[c.index + 1]);
            if (!value)
                rows.unreadable(c.field, w[c.index]);
            else if (*value <= -9999.0 || (quality && *quality != 0.0))
                rows.missing(c.field);
            else
                rows.set(c.field, *value * c.scale + c.offset);
        }
    }
    rows.note(ReadNote::Kind::Info, 0, "precip", "SURFRAD has no precipitation");
}

namespace {

bool recognise(const FileHead& head)
{
    if (head.lines.size() < 3) return false;
    const auto data = words(head.lines[2], 64);
    const auto place = words(head.lines[1], 8);
    return data.size() >= 40 && all_numbers(data) && place.size() >= 3 && to_number(place[0]) &&
           !all_numbers(words(head.lines[0], 8));
}

}  // namespace

extern const Reader surfrad_reader;
const Reader surfrad_reader{"SURFRAD", "NOAA, radiation stations", recognise, read_surfrad};

}  // namespace petrichor::weather
