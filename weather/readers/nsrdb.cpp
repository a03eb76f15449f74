// NSRDB CSV (National Solar Radiation Database, and its typical years): a line of names and one of
// values about the place and the units, then a table of Year, Month, Day, Hour, Minute and columns
// whose units stand above. No precipitation; wind is that at 2 m.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "weather/readers/csv_times.h"
#include "weather/readers/formats.h"
#include "weather/readers/table_rows.h"
#include "weather/readers/text.h"
#include "weather/readers/units.h"

namespace petrichor::weather {

namespace {

constexpr std::size_t kMostColumns = 256;

// The two lines about the place and the units.
struct About {
    std::vector<std::string_view> names, values;

    std::string_view of(std::string_view name) const
    {
        const auto at = std::find(names.begin(), names.end(), name);
        const auto i = static_cast<std::size_t>(at - names.begin());
        return i < names.size() && i < values.size() ? values[i] : std::string_view{};
    }
    double number_of(std::string_view name) const { return to_number(of(name)).value_or(kMissing); }
};

struct Table {
    std::vector<std::string_view> names;
    CsvTimes times;
    std::vector<std::optional<ColumnMeaning>> meaning;
};

Table read_names(std::string_view line, std::size_t number, const About& about)
{
    Table t;
    t.names = split(line, ',', kMostColumns);
    while (!t.names.empty() && trimmed(t.names.back()).empty()) t.names.pop_back();
    if (t.names.empty() || !(t.times = find_csv_times(t.names, {})).found() ||
        t.times.part[CsvTimes::Year] == CsvTimes::kNone) {
        throw Error("weather: NSRDB: line " + std::to_string(number) +
                        " does not name Year, Month, Day, Hour, Minute",
                    "Download the file again as CSV.");
    }
    t.meaning.resize(t.names.size());
    for (std::size_t i = 0; i < t.names.size(); ++i) {
        const std::string unit(about.of(std::string(t.names[i]) + " Units"));
        if (!t.times.uses(i) && !unit.empty() && unit != "N/A")
            t.meaning[i] = column_meaning(t.names[i], unit);
    }
    return t;
}

}  // namespace

static void read_nsrdb(std::string_view text, RowCollector& rows, const ReadOptions&)
{
    Lines lines(text);
    About about;
    about.names = split(lines.next().value_or(""), ',', kMostColumns);
    about.values = split(lines.next().value_or(""), ',', kMostColumns);
    Site& site = rows.site();
    site.latitude_deg = about.number_of("Latitude");
    site.longitude_deg = about.number_of("Longitude");
    site.elevation_m = about.number_of("Elevation");
    site.wind_height_m = 2.0;
    double zone_h = about.number_of("Time Zone");
    if (std::isnan(zone_h) || std::abs(zone_h) > 14.0) {
        rows.note(ReadNote::Kind::Warning, 2, "time", "no time zone in the file, taken as UTC");
        zone_h = 0.0;
    }
    site.utc_offset_h = zone_h;
    const std::string_view header = lines.next().value_or("");
    const Table table = read_names(header, lines.number(), about);
    rows.note(ReadNote::Kind::Info, 0, "precip", "NSRDB has no precipitation");
    std::vector<std::string> unread;
    for (std::size_t i = 0; i < table.names.size(); ++i)
        if (!table.meaning[i] && !table.times.uses(i)) unread.emplace_back(table.names[i]);
    rows.unread_columns(unread);

    const auto year_of = [&](const std::vector<std::string_view>& cells) {
        return to_integer(cells[table.times.part[CsvTimes::Year]]).value_or(0);
    };
    const auto month_of = [&](const std::vector<std::string_view>& cells) {
        return static_cast<int>(civil_from_us(table.times.time_of(cells).value()).month);
    };
    std::vector<std::string_view> cells;
    const auto date_of = [&](std::string_view line) -> std::optional<RowDate> {
        split(line, ',', cells, kMostColumns);
        const auto us = cells.size() >= table.names.size() ? table.times.time_of(cells) : std::nullopt;
        if (!us) return std::nullopt;
        const CivilTime t = civil_from_us(*us);
        return RowDate{t.year, t.month, t.day, t.hour, t.minute};
    };
    const std::vector<TimedRow> below = oldest_first(lines, date_of, rows);
    TypicalYear typical;
    for (const TimedRow& row : below) {
        split(row.text, ',', cells, kMostColumns);
        if (cells.size() >= table.names.size() && table.times.time_of(cells))
            typical.watch(year_of(cells), month_of(cells));
    }
    typical.decide(rows);

    for (const TimedRow& row : below) {
        split(row.text, ',', cells, kMostColumns);
        if (cells.size() < table.names.size()) {
            rows.bad_row(row.line, "",
                         "has " + std::to_string(cells.size()) + " columns, the header names " +
                             std::to_string(table.names.size()));
            continue;
        }
        auto us = table.times.time_of(cells);
        if (!us) {
            rows.bad_row(
                row.line, "time",
                "'" + table.times.shown_cells(cells) + "' is not a year, month, day and hour");
            continue;
        }
        if (typical.typical) {
            CivilTime when = civil_from_us(*us);
            if (when.month == 2 && when.day == 29) {
                rows.leap_day_left_out(row.line);
                continue;
            }
            when.year = typical.of(when.year);
            us = us_from_civil(when);
        }
        if (!us) continue;
        if (!rows.begin_row(*us - static_cast<std::int64_t>(zone_h * 3600e6), row.line))
            continue;
        for (std::size_t i = 0; i < table.names.size(); ++i) {
            if (!table.meaning[i]) continue;
            const ColumnMeaning& m = *table.meaning[i];
            if (const auto value = to_number(cells[i]))
                rows.set(m.field, *value * m.scale + m.offset);
            else if (trimmed(cells[i]).empty())
                rows.missing(m.field);
            else
                rows.unreadable(m.field, cells[i]);
        }
    }
}

namespace {

bool recognise(const FileHead& head)
{
    return head.first.rfind("source,location id,", 0) == 0;
}

}  // namespace

extern const Reader nsrdb_reader;
const Reader nsrdb_reader{"NSRDB CSV", "NREL solar radiation database, also its typical years",
                          recognise, read_nsrdb};

}  // namespace petrichor::weather
