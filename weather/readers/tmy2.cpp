// NREL TMY2: a line about the place, then 8760 lines of fixed columns, each value with flags of its
// source and certainty. Hour 1 is 00:00 to 01:00 local standard time. No precipitation. Nines are
// missing. Source: Users Manual for TMY2s, NREL/SP-463-7668, tables 3-1 and 3-2.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

struct Column {
    Field field;
    std::size_t at, width;
    double missing, scale, offset;
};
// Positions from 0.
constexpr Column kColumns[] = {
    {Field::Shortwave, 17, 4, 9999, 1.0, 0.0},
    {Field::Direct, 23, 4, 9999, 1.0, 0.0},
    {Field::Diffuse, 29, 4, 9999, 1.0, 0.0},
    {Field::Cloud, 59, 2, 99, 0.1, 0.0},
    {Field::AirTemp, 67, 4, 9999, 0.1, kZeroCelsiusK},
    {Field::DewPoint, 73, 4, 9999, 0.1, kZeroCelsiusK},
    {Field::RelHumidity, 79, 3, 999, 1.0, 0.0},
    {Field::Pressure, 84, 4, 9999, 100.0, 0.0},
    {Field::WindFrom, 90, 3, 999, 1.0, 0.0},
    {Field::Wind, 95, 3, 999, 0.1, 0.0},
    {Field::Visibility, 100, 4, 9999, 100.0, 0.0},
    {Field::SnowDepth, 133, 3, 999, 0.01, 0.0},
};
constexpr std::size_t kLength = 142;

std::optional<long long> number_at(std::string_view line, std::size_t at, std::size_t width)
{
    return at + width <= line.size() ? to_integer(line.substr(at, width)) : std::nullopt;
}

struct When {
    long long year = 0;
    int month = 0, day = 0, hour = 0;
};
std::optional<When> when_of(std::string_view line)
{
    const auto year = number_at(line, 1, 2), month = number_at(line, 3, 2),
               day = number_at(line, 5, 2), hour = number_at(line, 7, 2);
    if (!year || !month || !day || !hour || *month < 1 || *month > 12 || *day < 1 || *day > 31 ||
        *hour < 1 || *hour > 24)
        return std::nullopt;
    return When{1900 + *year, static_cast<int>(*month), static_cast<int>(*day),
                static_cast<int>(*hour)};
}

// " 14739 BOSTON                 MA  -5 N 42 22 W  71  2     5"
bool read_place(std::string_view line, Site& site)
{
    const auto w = words(line, 32);
    if (w.size() < 10) return false;
    const std::size_t n = w.size();
    const auto zone = to_number(w[n - 8]), elevation = to_number(w[n - 1]);
    const auto angle = [&](std::size_t letter) -> double {
        const auto degrees = to_number(w[letter + 1]), minutes = to_number(w[letter + 2]);
        if (!degrees || !minutes) return kMissing;
        const double value = *degrees + *minutes / 60.0;
        return w[letter] == "S" || w[letter] == "W" ? -value : value;
    };
    const bool letters =
        (w[n - 7] == "N" || w[n - 7] == "S") && (w[n - 4] == "E" || w[n - 4] == "W");
    if (!zone || !elevation || !letters || w[0].size() != 5 || std::abs(*zone) > 14.0) return false;
    site.utc_offset_h = *zone;
    site.elevation_m = *elevation;
    site.latitude_deg = angle(n - 7);
    site.longitude_deg = angle(n - 4);
    site.name = shown(w[1]);
    return !std::isnan(site.latitude_deg) && !std::isnan(site.longitude_deg);
}

void read(std::string_view text, RowCollector& rows, const ReadOptions&)
{
    Lines lines(text);
    std::optional<std::string_view> place = lines.next();
    while (place && trimmed(*place).empty()) place = lines.next();
    if (!place || !read_place(*place, rows.site()))
        throw Error("weather: TMY2: line " + std::to_string(lines.number()) + ": '" +
                        shown(place.value_or("")) + "' does not say where the station is",
                    "Give the whole file, with its line of the station.");
    const double zone_h = rows.site().utc_offset_h;
    TypicalYear typical;
    Lines again = lines;
    while (const auto line = again.next()) {
        if (const auto when = when_of(*line)) typical.watch(when->year, when->month);
    }
    typical.decide(rows);
    for (const Field f : {Field::Shortwave, Field::Direct, Field::Diffuse}) rows.means_of_past(f);
    rows.note(ReadNote::Kind::Info, 0, "precip", "TMY2 has no precipitation");
    while (const auto line = lines.next()) {
        if (trimmed(*line).empty()) continue;
        const auto when = when_of(*line);
        const auto us = when && line->size() + 4 >= kLength
                            ? us_from_civil({typical.of(when->year), when->month, when->day,
                                             when->hour, 0, 0.0})
                            : std::nullopt;
        if (!us) {
            rows.bad_row(lines.number(), when ? "" : "time",
                         "'" + shown(*line) + "' is not a line of TMY2");
            continue;
        }
        if (!rows.begin_row(*us - static_cast<std::int64_t>(zone_h * 3600e6), lines.number()))
            continue;
        for (const Column& c : kColumns) {
            const auto value = number_at(*line, c.at, c.width);
            if (!value)
                rows.unreadable(c.field, c.at < line->size() ? line->substr(c.at, c.width) : "");
            else if (static_cast<double>(*value) == c.missing)
                rows.missing(c.field);
            else
                rows.set(c.field, static_cast<double>(*value) * c.scale + c.offset);
        }
    }
}

bool recognise(const FileHead& head)
{
    Site site;
    return head.lines.size() >= 2 && head.lines[1].size() + 4 >= kLength &&
           when_of(head.lines[1]) && read_place(head.lines[0], site);
}

}  // namespace

extern const Reader tmy2_reader;
const Reader tmy2_reader{"TMY2", "NREL typical year, fixed columns", recognise, read};

}  // namespace petrichor::weather
