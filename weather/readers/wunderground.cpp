// Weather Underground, the table of a private station's day (TemperatureF,DewpointF,PressureIn,..),
// as its page gave it and programs still write it: a <br> behind every row, rain as a count since
// midnight, pressure at sea level, the clock of the place and mostly that of Greenwich beside it.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/csv_times.h"
#include "weather/readers/formats.h"
#include "weather/readers/rain_count.h"
#include "weather/readers/table_rows.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

constexpr TableColumn kColumns[] = {
    {"temperaturef", Field::AirTemp, 5.0 / 9.0, kZeroCelsiusK - 32.0 * 5.0 / 9.0},
    {"temperaturec", Field::AirTemp, 1.0, kZeroCelsiusK},
    {"dewpointf", Field::DewPoint, 5.0 / 9.0, kZeroCelsiusK - 32.0 * 5.0 / 9.0},
    {"dewpointc", Field::DewPoint, 1.0, kZeroCelsiusK},
    {"humidity", Field::RelHumidity},
    {"windspeedmph", Field::Wind, 0.44704},
    {"windspeedkmh", Field::Wind, 1.0 / 3.6},
    {"winddirectiondegrees", Field::WindFrom},
    {"pressurein", Field::Pressure, 3386.389},
    {"pressurehpa", Field::Pressure, 100.0},
    {"solarradiationwatts/m^2", Field::Shortwave},
    {"dailyrainin", Field::Precip, 25.4},
    {"dailyrainmm", Field::Precip, 1.0},
};

std::string without_breaks(std::string_view line)
{
    const auto tag = line.find("<br");
    return std::string(trimmed(line.substr(0, tag)));
}

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    std::string names;
    while (const auto line = lines.next()) {
        names = without_breaks(*line);
        if (!names.empty()) break;
    }
    const TableHeader header(names, ',');
    const bool utc = header.has("dateutc");
    const std::size_t stamp = header.at(utc ? "dateutc" : "time");
    if (utc)
        rows.times_name_their_zone();
    else
        note_unknown_zone(rows, options, "that of the station, with summer time where it keeps it");
    std::vector<std::pair<std::size_t, const TableColumn*>> columns;
    for (const TableColumn& c : kColumns)
        if (header.has(c.name)) columns.emplace_back(header.at(c.name), &c);
    rows.unread_columns(header.unread());
    rows.note(ReadNote::Kind::Info, 0, "pressure",
              std::isnan(options.site.elevation_m)
                  ? "given for sea level; give the elevation to bring it down"
                  : "given for sea level, brought to the station");
    rows.note(ReadNote::Kind::Info, 0, "precip",
              "what the count of the day rises by from row to row");
    RainCount rain;
    const DatedRows how{.time_of =
                            [&](const Cells& cells) {
                                auto cell = cell_of(cells, stamp);
                                if (const auto tag = cell.find("<br"); tag != cell.npos)
                                    cell = trimmed(cell.substr(0, tag));
                                return time_of_cell(cell);
                            },
                        // The page's own lines between the rows.
                        .skip =
                            [](const Cells& cells) {
                                return cells.size() < 2 ||
                                       trimmed(cells.front()).substr(0, 1) == "<";
                            }};
    for_dated_rows(lines, how, rows, [&](const DatedRow& row) {
        if (!rows.begin_row(row.time_us, row.line)) return;
        for (const auto& [at, column] : columns) {
            const auto cell = cell_of(row.cells, at);
            auto value = number_or_none(cell, {"N/A", "--"});
            // -999 and -9999 stand for nothing, also after they were turned into other units.
            if (value && *value < -300.0) value = std::nullopt;
            if (column->field == Field::Precip) {
                rain.put(value.value_or(kMissing) * column->scale, row.time_us, rows);
            } else if (column->field == Field::Pressure && value) {
                put_value(
                    Field::Pressure,
                    station_pressure_pa(*value * column->scale, options.site.elevation_m, kMissing),
                    rows);
            } else {
                put_cell(*column, cell, value, rows);
            }
        }
    });
}

bool recognise(const FileHead& head)
{
    const std::string& first = head.first;
    return first.rfind("time,temperature", 0) == 0 && first.find(",windspeedgust") != first.npos &&
           first.find(",dailyrain") != first.npos;
}

}  // namespace

extern const Reader wunderground_reader;
const Reader wunderground_reader{"Weather Underground", "days of private stations", recognise,
                                 read};

}  // namespace petrichor::weather
