// MET Norway, CSV of seklima.met.no: Navn;Stasjon;Tid(norsk normaltid);Lufttemperatur;.., in
// Norwegian or English, decimal commas, UTC+1 all year, - for nothing, a line about the licence at
// the end. Sums are of the hour that ends at their row. Units are those of the service: C, m/s,
// hPa, mm, cm.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/csv_times.h"
#include "weather/readers/formats.h"
#include "weather/readers/table_rows.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

constexpr double kZone_h = 1.0;
constexpr TableColumn kColumns[] = {
    {"lufttemperatur", Field::AirTemp, 1.0, kZeroCelsiusK},
    {"air temperature", Field::AirTemp, 1.0, kZeroCelsiusK},
    {"duggpunktstemperatur", Field::DewPoint, 1.0, kZeroCelsiusK},
    {"dew point temperature", Field::DewPoint, 1.0, kZeroCelsiusK},
    {"relativ luftfuktighet", Field::RelHumidity},
    {"relative humidity", Field::RelHumidity},
    {"middelvind", Field::Wind},
    {"mean wind speed", Field::Wind},
    {"vindretning", Field::WindFrom},
    {"wind direction", Field::WindFrom},
    {"lufttrykk i stasjonsniv\xC3\xA5", Field::Pressure, 100.0},
    {"air pressure at station level", Field::Pressure, 100.0},
    {"nedb\xC3\xB8r (1 t)", Field::Precip, 1.0, 0.0, 1.0},
    {"precipitation (1 h)", Field::Precip, 1.0, 0.0, 1.0},
    {"sn\xC3\xB8"
     "dybde",
     Field::SnowDepth, 0.01},
    {"snow depth", Field::SnowDepth, 0.01},
    {"skydekke", Field::Cloud, 0.125},
    {"cloud cover", Field::Cloud, 0.125},
};

std::size_t find_stamp(const TableHeader& header)
{
    for (const char* name : {"tid(norsk normaltid)", "time(norwegian mean time)"})
        if (header.has(name)) return header.at(name);
    return TableHeader::kNone;
}

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    const TableHeader header(lines.next().value_or(""), ';');
    const std::size_t stamp = find_stamp(header);
    const std::size_t station = header.at(header.has("stasjon") ? "stasjon" : "station");
    const std::size_t name = header.at(header.has("navn") ? "navn" : "name");
    std::vector<std::pair<std::size_t, const TableColumn*>> columns;
    for (const TableColumn& c : kColumns)
        if (header.has(c.name)) columns.emplace_back(header.at(c.name), &c);
    rows.unread_columns(header.unread());
    if (columns.empty())
        throw Error(
            "weather: seklima: no column here is of an hour",
            "Choose hourly values (Lufttemperatur, Nedb\xC3\xB8r (1 t), Middelvind, ..) and order "
            "the file again.");
    rows.times_name_their_zone();
    rows.site().utc_offset_h = kZone_h;
    rows.note(
        ReadNote::Kind::Info, 0, "place",
        "the place of the station is not in the file: give latitude, longitude and elevation");
    OneStation stations(options.station);
    const DatedRows how{.separator = ';',
                        .time_of = [&](const Cells& cells) -> std::optional<std::int64_t> {
                            const auto us =
                                time_of_cell(cell_of(cells, stamp), DateOrder::DayFirst);
                            if (!us) return std::nullopt;
                            return *us - static_cast<std::int64_t>(kZone_h * 3600e6);
                        },
                        .skip =
                            [&](const Cells& cells) {
                                // The last line names the licence.
                                if (cells.size() <= stamp) return true;
                                const auto who = trimmed(cell_of(cells, station));
                                return who.empty() || stations.is_other(who);
                            }};
    if (usual_step_h(lines, how) > 12.0)
        throw Error("weather: seklima: this file holds days", "Order hourly values.");
    for_dated_rows(lines, how, rows, [&](const DatedRow& row) {
        if (!rows.begin_row(row.time_us, row.line)) return;
        rows.site().name = shown(cell_of(row.cells, name));
        for (const auto& [at, column] : columns) {
            std::string cell(trimmed(cell_of(row.cells, at)));
            std::replace(cell.begin(), cell.end(), ',', '.');
            auto value = number_or_none(cell, {"-", "x"});
            // Of 8 a ninth okta is a sky that nobody can see; a depth of -1 is no snow.
            if (value && column->field == Field::Cloud && *value == 9.0) value = 8.0;
            if (value && column->field == Field::SnowDepth && *value == -1.0) value = 0.0;
            put_cell(*column, cell, value, rows);
        }
    });
    stations.check("seklima", "as SN18700");
}

bool recognise(const FileHead& head)
{
    return head.first.find("tid(norsk normaltid)") != head.first.npos ||
           head.first.find("time(norwegian mean time)") != head.first.npos;
}

}  // namespace

extern const Reader seklima_reader;
const Reader seklima_reader{"seklima", "MET Norway, hours of seklima.met.no", recognise, read};

}  // namespace petrichor::weather
