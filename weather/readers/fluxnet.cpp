// FLUXNET2015 and what came after it (FULLSET and SUBSET, half hours HH and hours HR), and AmeriFlux
// BASE, whose names have no _F and positions such as _1_1_1 behind them. TIMESTAMP_START and
// TIMESTAMP_END, local standard time; -9999 is missing. C, hPa (VPD), kPa, W/m2, m/s, mm of the
// interval. Values are means of their interval. Neither the place nor its zone is in the file.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/physics/humidity.h"
#include "weather/readers/csv_times.h"
#include "weather/readers/formats.h"
#include "weather/readers/table_rows.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

struct Quantity {
    std::vector<const char*> names;  // gap-filled first
    Field field;
    double scale, offset;
};
const std::vector<Quantity>& quantities()
{
    static const std::vector<Quantity> kAll = {
        {{"ta_f", "ta_f_mds", "ta"}, Field::AirTemp, 1.0, kZeroCelsiusK},
        {{"rh"}, Field::RelHumidity, 1.0, 0.0},
        {{"ws_f", "ws"}, Field::Wind, 1.0, 0.0},
        {{"wd"}, Field::WindFrom, 1.0, 0.0},
        {{"pa_f", "pa"}, Field::Pressure, 1000.0, 0.0},
        {{"sw_in_f", "sw_in_f_mds", "sw_in"}, Field::Shortwave, 1.0, 0.0},
        {{"lw_in_f", "lw_in_f_mds", "lw_in"}, Field::Longwave, 1.0, 0.0},
        {{"sw_dif"}, Field::Diffuse, 1.0, 0.0},
        {{"sw_out"}, Field::Reflected, 1.0, 0.0},
        {{"d_snow"}, Field::SnowDepth, 0.01, 0.0},
    };
    return kAll;
}

// "ta_1_1_1" is ta at the first place, height and of the first instrument, as is plain "ta".
std::size_t column_of(const TableHeader& header, const std::string& name)
{
    if (header.has(name)) return header.at(name);
    return header.at(name + "_1_1_1");
}

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    std::string_view names = lines.next().value_or("");
    while (!names.empty() && trimmed(names).front() == '#') {
        const std::size_t site = names.find("Site:");
        if (site != names.npos) rows.site().name = shown(trimmed(names.substr(site + 5)));
        names = lines.next().value_or("");
    }
    const TableHeader header(names, ',');
    if (!header.has("timestamp_start"))
        throw Error("weather: FLUXNET: this file holds days, weeks, months or years",
                    "Take the file of half hours (HH) or hours (HR) of the same download.");
    const std::size_t begin = header.at("timestamp_start"), end = header.at("timestamp_end");
    struct Column {
        const Quantity* quantity;
        std::size_t at;
    };
    std::vector<Column> columns;
    for (const Quantity& q : quantities()) {
        for (const char* name : q.names) {
            const std::size_t at = column_of(header, name);
            if (at == TableHeader::kNone) continue;
            columns.push_back({&q, at});
            break;
        }
    }
    std::size_t precip = column_of(header, "p_f");
    if (precip == TableHeader::kNone) precip = column_of(header, "p");
    std::size_t air = column_of(header, "ta_f");
    if (air == TableHeader::kNone) air = column_of(header, "ta");
    // Half hours with humidity as the deficit alone.
    const bool has_humidity = column_of(header, "rh") != TableHeader::kNone;
    std::size_t deficit = TableHeader::kNone;
    if (!has_humidity) {
        deficit = column_of(header, "vpd_f");
        if (deficit == TableHeader::kNone) deficit = column_of(header, "vpd");
    }
    rows.unread_columns(header.unread());
    note_unknown_zone(rows, options, "the local standard time of the site");
    rows.note(ReadNote::Kind::Info, 0, "place",
              "latitude, longitude, elevation and the heights of the instruments are not in the "
              "file: give them");
    rows.note(ReadNote::Kind::Info, 0, "columns",
              "values that the archive has filled (_F) are used as it gives them");
    const auto value_of = [](std::string_view cell) {
        const auto value = to_number(cell);
        return value && *value > -9990.0 ? *value : kMissing;
    };
    bool told = false;
    const auto end_of = [&](const Cells& cells) { return time_of_cell(cell_of(cells, end)); };
    const DatedRows how{.time_of = [&](const Cells& cells) -> std::optional<std::int64_t> {
                            const auto from = time_of_cell(cell_of(cells, begin)), to = end_of(cells);
                            return from && to && *to > *from ? from : std::nullopt;
                        },
                        .lacks = "has no times of its beginning and end"};
    for_dated_rows(lines, how, rows, [&](const DatedRow& row) {
        const double seconds = static_cast<double>(end_of(row.cells).value() - row.time_us) * 1e-6;
        if (!told) {
            told = true;
            for (const Column& c : columns) rows.holds_after(c.quantity->field, 0.5 * seconds);
            if (deficit != TableHeader::kNone) rows.holds_after(Field::RelHumidity, 0.5 * seconds);
        }
        if (!rows.begin_row(row.time_us, row.line)) return;
        for (const Column& c : columns) {
            const auto cell = cell_of(row.cells, c.at);
            auto value = number_or_none(cell);
            if (value && *value <= -9990.0) value.reset();
            put_cell({{}, c.quantity->field, c.quantity->scale, c.quantity->offset}, cell, value,
                     rows);
        }
        if (precip != TableHeader::kNone)
            put_value(Field::Precip, value_of(cell_of(row.cells, precip)) / seconds, rows);
        if (deficit != TableHeader::kNone) {
            const double hpa = value_of(cell_of(row.cells, deficit)),
                         air_k = value_of(cell_of(row.cells, air)) + kZeroCelsiusK;
            if (std::isnan(hpa) || !(air_k > 173.15 && air_k < 333.15))
                rows.missing(Field::RelHumidity);
            else
                rows.set(Field::RelHumidity,
                         std::clamp(100.0 - 1e4 * hpa / saturation_pressure_water_pa(air_k), 0.0,
                                    100.0));
        }
    });
}

bool recognise(const FileHead& head)
{
    for (const auto line : head.lines) {
        if (trimmed(line).front() == '#') continue;
        const TableHeader header(line, ',');
        if (header.has("timestamp_start") && header.has("timestamp_end")) return true;
        return header.has("timestamp") && header.has("ta_f") && header.has("vpd_f");
    }
    return false;
}

}  // namespace

extern const Reader fluxnet_reader;
const Reader fluxnet_reader{"FLUXNET", "FLUXNET half hours (FULLSET, SUBSET) and AmeriFlux BASE",
                            recognise, read};

}  // namespace petrichor::weather
