// MeteoSwiss: tables of its open data (station_abbr;reference_timestamp;tre200s0;..) and of its
// current values (Station/Location;Date;tre200s0;..), UTC, one station a file or several. Names are
// its codes: the last letters tell how a value was made (s0 at the time, z0 of ten minutes, h0 of an
// hour). - is missing. Values of ten minutes end at their time, those of hours begin there.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/csv_times.h"
#include "weather/readers/formats.h"
#include "weather/readers/table_rows.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

// Codes without their last two letters; the first that a file has counts for its field.
struct Quantity {
    const char* code;
    Field field;
    double scale, offset;
};
constexpr Quantity kQuantities[] = {
    {"tre200", Field::AirTemp, 1.0, kZeroCelsiusK},
    {"ure200", Field::RelHumidity, 1.0, 0.0},
    {"tde200", Field::DewPoint, 1.0, kZeroCelsiusK},
    {"presta", Field::Pressure, 100.0, 0.0},
    {"fkl010", Field::Wind, 1.0, 0.0},
    {"fu3010", Field::Wind, 1.0 / 3.6, 0.0},
    {"dkl010", Field::WindFrom, 1.0, 0.0},
    {"gre000", Field::Shortwave, 1.0, 0.0},
    {"ods000", Field::Diffuse, 1.0, 0.0},
    {"oli000", Field::Longwave, 1.0, 0.0},
    {"osr000", Field::Reflected, 1.0, 0.0},
    {"rre150", Field::Precip, 1.0, 0.0},
    {"htoaut", Field::SnowDepth, 0.01, 0.0},
};

struct Column {
    std::size_t at;
    const Quantity* quantity;
    bool hour;  // of the hour that begins at its row
};

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    const TableHeader header(lines.next().value_or(""), ';');
    const bool current = header.has("station/location");
    const std::size_t station = header.at(current ? "station/location" : "station_abbr"),
                      stamp = header.at(current ? "date" : "reference_timestamp");
    std::vector<Column> columns;
    std::array<bool, kFieldCount> has{};
    bool hours = false, days = false;
    for (const Quantity& q : kQuantities) {
        for (const char* made : {"h0", "s0", "z0"}) {
            bool& taken = has[static_cast<std::size_t>(q.field)];
            const std::size_t at =
                taken ? TableHeader::kNone : header.at(std::string(q.code) + made);
            if (at == TableHeader::kNone) continue;
            taken = true;
            columns.push_back({at, &q, made[0] == 'h'});
            hours = hours || made[0] == 'h';
        }
        days = days || header.has(std::string(q.code) + "d0");
    }
    if (columns.empty() && days)
        throw Error("weather: MeteoSwiss: this file holds days",
                    "Take the file of hours (_h_) or of ten minutes (_t_).");
    rows.unread_columns(header.unread());
    rows.times_name_their_zone();
    rows.note(ReadNote::Kind::Info, 0, "place",
              "the place of the station is not in the file: give latitude, longitude and elevation");
    if (hours)
        rows.note(ReadNote::Kind::Info, 0, "time",
                  "UTC; values of hours (h0) are of the hour that begins at their row");
    for (const Column& c : columns) {
        const bool sun = c.quantity->field == Field::Shortwave ||
                         c.quantity->field == Field::Diffuse ||
                         c.quantity->field == Field::Longwave ||
                         c.quantity->field == Field::Reflected;
        if (c.hour && !field_info(c.quantity->field).is_rate)
            rows.holds_after(c.quantity->field, 1800.0);
        else if (sun)
            rows.means_of_past(c.quantity->field);
    }
    OneStation stations(options.station);
    const DatedRows how{
        .separator = ';',
        // 31.12.2024 23:50, or 202412312350
        .time_of =
            [&](const Cells& cells) {
                return time_of_cell(cell_of(cells, stamp), DateOrder::DayFirst);
            },
        .skip =
            [&](const Cells& cells) {
                return stations.is_other(trimmed(cell_of(cells, station)));
            }};
    for_dated_rows(lines, how, rows, [&](const DatedRow& row) {
        if (!rows.begin_row(row.time_us, row.line)) return;
        for (const Column& c : columns) {
            TableColumn column{{}, c.quantity->field, c.quantity->scale, c.quantity->offset};
            if (column.field == Field::Precip && c.hour) column.scale = 1.0 / 3600.0;
            if (column.field == Field::Precip && !c.hour) column.fell_hours = 1.0 / 6.0;
            const auto cell = trimmed(cell_of(row.cells, c.at));
            put_cell(column, cell, number_or_none(cell, {"-"}), rows);
        }
    });
    rows.site().name = shown(stations.name());
    stations.check("MeteoSwiss", "by its three letters");
}

bool recognise(const FileHead& head)
{
    return head.first.rfind("station_abbr;reference_timestamp;", 0) == 0 ||
           head.first.rfind("station/location;date;", 0) == 0;
}

}  // namespace

extern const Reader meteoswiss_reader;
const Reader meteoswiss_reader{"MeteoSwiss", "open data of MeteoSwiss, ten minutes or hours",
                               recognise, read};

}  // namespace petrichor::weather
