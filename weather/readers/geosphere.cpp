// GeoSphere Austria, CSV of its data hub (time,station,rr,tl,..): hours (klima-v2-1h) and ten
// minutes (klima-v2-10min, TAWES). Times are UTC and end what is averaged or summed; one station a
// file, or several. Columns ..._flag tell how values were checked.
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

constexpr TableColumn kColumns[] = {
    {"tl", Field::AirTemp, 1.0, kZeroCelsiusK},
    {"tp", Field::DewPoint, 1.0, kZeroCelsiusK},
    {"rf", Field::RelHumidity},
    {"ff", Field::Wind},
    {"dd", Field::WindFrom},
    {"p", Field::Pressure, 100.0},
    {"rr", Field::Precip},
    {"cglo", Field::Shortwave},
    {"glow", Field::Shortwave},
    {"chim", Field::Diffuse},
    {"sh", Field::SnowDepth, 0.01},
    {"schnee", Field::SnowDepth, 0.01},
};

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    const TableHeader header(lines.next().value_or(""), ',');
    const std::size_t stamp = header.at("time"), station = header.at("station");
    std::vector<std::pair<std::size_t, const TableColumn*>> columns;
    for (const TableColumn& c : kColumns) {
        const bool taken = std::any_of(columns.begin(), columns.end(), [&](const auto& other) {
            return other.second->field == c.field;
        });
        if (!taken && header.has(c.name)) columns.emplace_back(header.at(c.name), &c);
    }
    std::vector<std::string> unread = header.unread();
    std::erase_if(unread, [](const std::string& name) { return name.ends_with("_flag"); });
    rows.unread_columns(unread);
    rows.times_name_their_zone();
    rows.note(
        ReadNote::Kind::Info, 0, "place",
        "the place of the station is not in the file: give latitude, longitude and elevation");
    OneStation stations(options.station);
    const DatedRows how{
        .time_of = [&](const Cells& cells) { return time_of_cell(cell_of(cells, stamp)); },
        .skip =
            [&](const Cells& cells) {
                return stations.is_other(trimmed(cell_of(cells, station)));
            }};
    const double hours = usual_step_h(lines, how);
    if (hours > 12.0)
        throw Error("weather: GeoSphere: this file holds days or months",
                    "Take the data set of hours (klima-v2-1h) or of ten minutes (klima-v2-10min).");
    rows.means_of_past(Field::Shortwave);
    rows.means_of_past(Field::Diffuse);
    for_dated_rows(lines, how, rows, [&](const DatedRow& row) {
        if (!rows.begin_row(row.time_us, row.line)) return;
        for (const auto& [at, meaning] : columns) {
            TableColumn column = *meaning;
            if (column.field == Field::Precip) column.fell_hours = hours;
            const auto cell = cell_of(row.cells, at);
            auto value = number_or_none(cell, {"nan", "NaN", "null"});
            // A depth of -1 is no snow, rain of -1 too little to measure.
            if (value && *value == -1.0 &&
                (column.field == Field::SnowDepth || column.field == Field::Precip))
                value = 0.0;
            put_cell(column, cell, value, rows);
        }
    });
    rows.site().name = shown(stations.name());
    stations.check("GeoSphere", "by its number");
}

bool recognise(const FileHead& head)
{
    return head.first.rfind("time,station,", 0) == 0 &&
           (head.has_columns({"tl"}) || head.has_columns({"rr"}) || head.has_columns({"rf"}) ||
            head.has_columns({"ff"}) || head.has_columns({"cglo"}));
}

}  // namespace

extern const Reader geosphere_reader;
const Reader geosphere_reader{
    "GeoSphere Austria", "data hub of GeoSphere Austria, hours or ten minutes", recognise, read};

}  // namespace petrichor::weather
