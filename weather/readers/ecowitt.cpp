// Weather stations of Ecowitt and Fine Offset (Froggit, Ambient, Sainlogic and others sell them):
// what their consoles and gateways write to a card, and EasyWeather. Names with units in brackets;
// the clock of the console; rain as counts since the hour, day, week, month and year began. Tables of
// ecowitt.net have two lines of names, sensors (which their owner names) over what they measure.
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/csv_times.h"
#include "weather/readers/formats.h"
#include "weather/readers/named_quantities.h"
#include "weather/readers/rain_count.h"
#include "weather/readers/table_rows.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

using Unit = QuantityUnit;
constexpr Unit kTemp[] = {{"c", 1.0, kZeroCelsiusK},
                          {"f", 5.0 / 9.0, kZeroCelsiusK - 32.0 * 5.0 / 9.0}},
               kShare[] = {{"%", 1.0, 0.0}},
               kSpeed[] = {{"m/s", 1.0, 0.0},
                           {"km/h", 1.0 / 3.6, 0.0},
                           {"mph", 0.44704, 0.0},
                           {"knots", 1852.0 / 3600.0, 0.0},
                           {"kn", 1852.0 / 3600.0, 0.0},
                           {"fpm", 0.3048 / 60.0, 0.0},
                           {"ft/s", 0.3048, 0.0}},
               kPressure[] = {{"hpa", 100.0, 0.0},
                              {"inhg", 3386.389, 0.0},
                              {"mmhg", 133.322, 0.0},
                              {"kpa", 1000.0, 0.0}},
               kAmount[] = {{"mm", 1.0, 0.0}, {"in", 25.4, 0.0}}, kFlux[] = {{"w/m2", 1.0, 0.0}},
               kDegrees[] = {{"", 1.0, 0.0}, {"deg", 1.0, 0.0}};
// Of several names for one field the first that a file has counts; of rain the longest count.
constexpr NamedQuantity kQuantities[] = {
    {"outdoor temperature", Field::AirTemp, kTemp},
    {"outdoor humidity", Field::RelHumidity, kShare},
    {"dew point", Field::DewPoint, kTemp},
    {"dewpoint", Field::DewPoint, kTemp},
    {"outdoor dew point", Field::DewPoint, kTemp},
    {"wind", Field::Wind, kSpeed},
    {"wind speed", Field::Wind, kSpeed},
    {"wind direction", Field::WindFrom, kDegrees},
    {"direction", Field::WindFrom, kDegrees},
    {"abs pressure", Field::Pressure, kPressure},
    {"absolute pressure", Field::Pressure, kPressure},
    {"absolute", Field::Pressure, kPressure},
    {"rel pressure", Field::Pressure, kPressure, true},
    {"relative pressure", Field::Pressure, kPressure, true},
    {"solar rad", Field::Shortwave, kFlux},
    {"solar and uvi solar", Field::Shortwave, kFlux},
    {"wind wind speed", Field::Wind, kSpeed},
    {"wind wind direction", Field::WindFrom, kDegrees},
    {"pressure absolute", Field::Pressure, kPressure},
    {"pressure relative", Field::Pressure, kPressure, true},
    {"rainfall yearly", Field::Precip, kAmount},
    {"piezo rainfall yearly", Field::Precip, kAmount},
    {"rainfall monthly", Field::Precip, kAmount},
    {"piezo rainfall monthly", Field::Precip, kAmount},
    {"rainfall weekly", Field::Precip, kAmount},
    {"piezo rainfall weekly", Field::Precip, kAmount},
    {"rainfall daily", Field::Precip, kAmount},
    {"piezo rainfall daily", Field::Precip, kAmount},
    {"yearly rain", Field::Precip, kAmount},
    {"yearly", Field::Precip, kAmount},
    {"total rainfall", Field::Precip, kAmount},
    {"monthly rain", Field::Precip, kAmount},
    {"month rainfall", Field::Precip, kAmount},
    {"monthly", Field::Precip, kAmount},
    {"weekly rain", Field::Precip, kAmount},
    {"daily rain", Field::Precip, kAmount},
    {"daily", Field::Precip, kAmount},
};

// "outdoor temperature(℃)": name and unit. The signs of degrees, which no two programs write the
// same, become letters.
NameAndUnit parts_of(const std::string& column)
{
    const std::size_t open = column.find('('), close = column.rfind(')');
    NameAndUnit parts;
    parts.name = std::string(trimmed(std::string_view(column).substr(0, open)));
    if (open == column.npos || close == column.npos || close < open) return parts;
    std::string unit = column.substr(open + 1, close - open - 1);
    for (const auto& [sign, letter] :
         {std::pair{"\xE2\x84\x83", "c"}, {"\xE2\x84\x89", "f"}, {"\xC2\xB2", "2"}})
        if (const auto at = unit.find(sign); at != unit.npos)
            unit.replace(at, std::string_view(sign).size(), letter);
    for (const char c : unit)
        if (static_cast<unsigned char>(c) < 0x80 && c != '^' && c != ' ') parts.unit += c;
    return parts;
}

char separator_of(std::string_view line)
{
    char best = ',';
    for (const char c : {';', '\t'})
        if (std::count(line.begin(), line.end(), c) > std::count(line.begin(), line.end(), best))
            best = c;
    return best;
}

bool is_header(std::string_view line)
{
    const std::string low = lower(line);
    return low.find("outdoor temperature(") != low.npos && low.find("time") != low.npos;
}

// A line of sensors, a name over the first column of each or over all, over one of what they measure.
bool are_two_headers(std::string_view sensors, std::string_view names)
{
    const std::string above = lower(sensors), below = lower(names);
    return above.find("time") != above.npos && above.find('(') == above.npos &&
           below.find("temperature(") != below.npos && below.find("humidity(") != below.npos;
}

std::vector<std::string> cells_of(std::string_view line, char separator)
{
    return TableHeader(line, separator).names();
}

// Of two lines one: "outdoor temperature(c)". The sensor of the air outside is called Outdoor where
// nobody has given it another name; else it is the one besides Indoor that has a dew point.
std::string one_header(std::string_view sensors, std::string_view names, char separator,
                       RowCollector& rows)
{
    const std::vector<std::string> above = cells_of(sensors, separator),
                                   below = cells_of(names, separator);
    std::vector<std::pair<std::string, std::string>> columns;
    std::vector<std::string> dewy;
    std::string sensor;
    for (std::size_t i = 0; i < std::max(above.size(), below.size()); ++i) {
        if (i < above.size() && !above[i].empty()) sensor = above[i];
        const std::string name = i < below.size() ? below[i] : std::string();
        columns.emplace_back(sensor, name);
        if (name.rfind("dew point(", 0) == 0 && sensor != "indoor" &&
            std::find(dewy.begin(), dewy.end(), sensor) == dewy.end())
            dewy.push_back(sensor);
    }
    std::string outdoor = "outdoor";
    const bool named = std::any_of(columns.begin(), columns.end(),
                                   [](const auto& c) { return c.first == "outdoor"; });
    if (!named) {
        if (dewy.size() != 1)
            throw Error("weather: Ecowitt: no sensor is called 'Outdoor', and " +
                            std::to_string(dewy.size()) + " others have a dew point",
                        "Write Outdoor over the columns of the sensor of the air outside.");
        outdoor = dewy.front();
        rows.note(ReadNote::Kind::Info, 0, "outdoor", "the air outside is that of '" + shown(outdoor) + "'");
    }
    std::string line;
    for (const auto& [of, name] : columns) {
        if (!line.empty()) line += separator;
        if (name.empty() || name == "time" || of == "time")
            line += of.empty() || name == "time" ? name : of;
        else
            line += (of == outdoor ? "outdoor" : of) + " " + name;
    }
    return line;
}

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    const std::string_view first = lines.next().value_or("");
    const char separator = separator_of(first);
    std::string names(first);
    if (!is_header(first)) names = one_header(first, lines.next().value_or(""), separator, rows);
    const TableHeader header(names, separator);
    const std::size_t stamp = header.at("time");
    if (stamp == TableHeader::kNone)
        throw Error("weather: Ecowitt: there is no column 'Time'",
                    "Take the file as the console wrote it.");
    const std::vector<QuantityColumn> columns =
        quantity_columns(header, kQuantities, parts_of, "Ecowitt",
                         "Set the console to C, m/s, hPa and mm, and write the file again.");
    rows.unread_columns(header.unread());
    note_unknown_zone(rows, options, "that of the console, with summer time where it keeps it");
    const DateOrder order = date_order_of(lines, separator, stamp, "Ecowitt", options);
    for (const QuantityColumn& c : columns) {
        if (c.quantity->sea_level)
            rows.note(ReadNote::Kind::Info, 0, "pressure",
                      "given for sea level as the console is set, brought to the station where its "
                      "elevation is known");
        if (c.quantity->field == Field::Precip)
            rows.note(
                ReadNote::Kind::Info, 0, "precip",
                std::string("what the count '") + c.quantity->name + "' rises by from row to row");
    }
    RainCount rain;
    const DatedRows how{.separator = separator, .time_of = [&](const Cells& cells) {
                            return time_of_cell(cell_of(cells, stamp), order);
                        }};
    for_dated_rows(lines, how, rows, [&](const DatedRow& row) {
        if (!rows.begin_row(row.time_us, row.line)) return;
        for (const QuantityColumn& c : columns) {
            std::string cell(trimmed(cell_of(row.cells, c.at)));
            if (separator != ',') std::replace(cell.begin(), cell.end(), ',', '.');
            auto value = number_or_none(cell, {"--", "---", "--.-", "-"});
            if (value && c.quantity->field == Field::WindFrom)
                value = compass_deg(cell).value_or(*value);
            if (c.quantity->field == Field::Precip) {
                rain.put(value.value_or(kMissing) * c.scale, row.time_us, rows);
                continue;
            }
            TableColumn column{{}, c.quantity->field, c.scale, c.offset};
            if (value && c.quantity->sea_level) {
                value = station_pressure_pa(*value * c.scale, options.site.elevation_m, kMissing);
                column.scale = 1.0;
            }
            put_cell(column, cell, value, rows);
        }
    });
}

bool recognise(const FileHead& head)
{
    return is_header(head.first) ||
           (head.lines.size() > 1 && are_two_headers(head.first, head.lines[1]));
}

}  // namespace

extern const Reader ecowitt_reader;
const Reader ecowitt_reader{
    "Ecowitt", "stations of Ecowitt and Fine Offset, as their consoles and ecowitt.net write", recognise, read};

}  // namespace petrichor::weather
