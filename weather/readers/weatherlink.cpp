// Davis WeatherLink, CSV of weatherlink.com: lines about the station, then "Date & Time" and columns
// whose units stand behind a dash (Temp - F with a degree sign, Rain - in). Amounts and light are of the
// interval that ends at its row; -- is missing; the clock is that of the station. The text files of
// the older program write no units: refused_kinds.cpp.
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/csv_times.h"
#include "weather/readers/formats.h"
#include "weather/readers/named_quantities.h"
#include "weather/readers/table_rows.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

constexpr double kF = 5.0 / 9.0, kFrom_f = kZeroCelsiusK - 32.0 * kF;
using Unit = QuantityUnit;
constexpr Unit kTemp[] = {{"c", 1.0, kZeroCelsiusK}, {"f", kF, kFrom_f}},
               kShare[] = {{"%", 1.0, 0.0}},
               kSpeed[] = {{"mph", 0.44704, 0.0},
                           {"km/h", 1.0 / 3.6, 0.0},
                           {"kph", 1.0 / 3.6, 0.0},
                           {"m/s", 1.0, 0.0},
                           {"knots", 1852.0 / 3600.0, 0.0},
                           {"kt", 1852.0 / 3600.0, 0.0}},
               kPressure[] = {{"in hg", 3386.389, 0.0},
                              {"inhg", 3386.389, 0.0},
                              {"hpa", 100.0, 0.0},
                              {"mb", 100.0, 0.0},
                              {"mm hg", 133.322, 0.0}},
               kAmount[] = {{"in", 25.4, 0.0}, {"mm", 1.0, 0.0}}, kFlux[] = {{"w/m^2", 1.0, 0.0}},
               kNone[] = {{"", 1.0, 0.0}};
// Of two names for one field the first here counts.
constexpr NamedQuantity kQuantities[] = {
    {"temp", Field::AirTemp, kTemp},
    {"outside temp", Field::AirTemp, kTemp},
    {"avg temp", Field::AirTemp, kTemp},
    {"hum", Field::RelHumidity, kShare},
    {"outside hum", Field::RelHumidity, kShare},
    {"avg hum", Field::RelHumidity, kShare},
    {"dew point", Field::DewPoint, kTemp},
    {"wind speed", Field::Wind, kSpeed},
    {"avg wind speed", Field::Wind, kSpeed},
    {"wind direction", Field::WindFrom, kNone},
    {"prevailing wind direction", Field::WindFrom, kNone},
    {"absolute pressure", Field::Pressure, kPressure},
    {"barometer", Field::Pressure, kPressure, true},
    {"rain", Field::Precip, kAmount},
    {"solar rad", Field::Shortwave, kFlux},
    {"avg solar rad", Field::Shortwave, kFlux},
};

// "temp - f", its degree sign left out: name and unit.
NameAndUnit parts_of(const std::string& column)
{
    const std::size_t dash = column.find(" - ");
    std::string name(trimmed(std::string_view(column).substr(0, dash))), unit;
    if (dash != std::string::npos)
        for (const char c : column.substr(dash + 3))
            if (static_cast<unsigned char>(c) < 0x80) unit += c;
    return {name, std::string(trimmed(unit))};
}

bool is_header(std::string_view line)
{
    const std::string low = lower(line);
    return low.find("date & time") != low.npos && low.find(" - ") != low.npos &&
           std::count(line.begin(), line.end(), ',') >= 2;
}

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    std::string_view names;
    bool first = true;
    while (const auto line = lines.next()) {
        if (is_header(*line)) {
            names = *line;
            break;
        }
        if (first) rows.site().name = shown(split(*line, ',', 2).front());
        first = false;
    }
    const TableHeader header(names, ',');
    const std::size_t stamp = header.at("date & time");
    const std::vector<QuantityColumn> columns =
        quantity_columns(header, kQuantities, parts_of, "WeatherLink",
                         "Choose usual units in the account, and export the file again.");
    rows.unread_columns(header.unread());
    note_unknown_zone(rows, options, "that of the station, with summer time where it keeps it");
    const DateOrder order = date_order_of(lines, ',', stamp, "WeatherLink", options);
    const DatedRows how{.time_of = [&](const Cells& cells) {
        return time_of_cell(cell_of(cells, stamp), order);
    }};
    const double hours = usual_step_h(lines, how);
    for (const QuantityColumn& c : columns) {
        if (c.quantity->field == Field::Shortwave) rows.means_of_past(Field::Shortwave);
        if (c.quantity->sea_level)
            rows.note(ReadNote::Kind::Info, 0, "pressure",
                      std::isnan(options.site.elevation_m)
                          ? "given for sea level; give the elevation to bring it down"
                          : "given for sea level, brought to the station");
    }
    for_dated_rows(lines, how, rows, [&](const DatedRow& row) {
        if (!rows.begin_row(row.time_us, row.line)) return;
        for (const QuantityColumn& c : columns) {
            TableColumn column{{}, c.quantity->field, c.scale, c.offset};
            if (column.field == Field::Precip) column.fell_hours = hours;
            const auto cell = trimmed(cell_of(row.cells, c.at));
            auto value = number_or_none(cell, {"--", "---"});
            if (value && column.field == Field::WindFrom)
                value = compass_deg(cell).value_or(*value);
            if (value && c.quantity->sea_level) {
                value = station_pressure_pa(*value * c.scale + c.offset, options.site.elevation_m,
                                            kMissing);
                column.scale = 1.0;
                column.offset = 0.0;
            }
            put_cell(column, cell, value, rows);
        }
    });
}

bool recognise(const FileHead& head)
{
    for (std::size_t i = 0; i < std::min<std::size_t>(head.lines.size(), 10); ++i)
        if (is_header(head.lines[i])) return true;
    return false;
}
}  // namespace

extern const Reader weatherlink_reader;
const Reader weatherlink_reader{"WeatherLink CSV", "Davis stations, CSV of weatherlink.com",
                                recognise, read};

}  // namespace petrichor::weather
