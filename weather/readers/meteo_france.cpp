// Meteo-France: hours of its climate base (NUM_POSTE;NOM_USUEL;LAT;LON;ALTI;AAAAMMJJHH;RR1;..) and
// SYNOP messages (numer_sta;date;pmer;..), both in UTC, with many stations in one file.
//
// Hours: mm of the hour before, C, m/s, %, hPa at the station, m, oktas, cm, J/cm2 of the hour before
// in UTC (names with a 2; those without are in true solar time, and not read). A column Q.. beside
// each holds 2 where the value is doubtful.
// SYNOP: K, Pa at the station, %, m/s, m, codes 4677 of the weather, mm of the hours before (-0.1: a
// trace); mq is missing.
#include <algorithm>
#include <cmath>
#include <map>
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

constexpr double kHour_j_cm2 = 1.0e4 / 3600.0;
constexpr TableColumn kHours[] = {
    {"t", Field::AirTemp, 1.0, kZeroCelsiusK},
    {"td", Field::DewPoint, 1.0, kZeroCelsiusK},
    {"u", Field::RelHumidity},
    {"ff", Field::Wind},
    {"dd", Field::WindFrom},
    {"pstat", Field::Pressure, 100.0},
    {"rr1", Field::Precip, 1.0, 0.0, 1.0},
    {"vv", Field::Visibility},
    {"neigetot", Field::SnowDepth, 0.01},
    {"glo2", Field::Shortwave, kHour_j_cm2},
    {"dif2", Field::Diffuse, kHour_j_cm2},
    {"infrar2", Field::Longwave, kHour_j_cm2},
};
constexpr TableColumn kSynop[] = {
    {"t", Field::AirTemp},
    {"td", Field::DewPoint},
    {"u", Field::RelHumidity},
    {"ff", Field::Wind},
    {"dd", Field::WindFrom},
    {"pres", Field::Pressure},
    {"n", Field::Cloud, 0.01},
    {"vv", Field::Visibility},
    {"ht_neige", Field::SnowDepth},
};

// The one station that is read: the one that was asked for, or the only one.
//   throws  Error where several are there and none was named, or that one is not there
std::string station_of(Lines lines, std::size_t column, const ReadOptions& options)
{
    constexpr std::size_t kMostNamed = 12;
    std::map<std::string, std::size_t> stations;
    std::vector<std::string_view> cells;
    while (const auto line = lines.next()) {
        if (trimmed(*line).empty()) continue;
        split(*line, ';', cells, column + 2);
        ++stations[std::string(trimmed(cell_of(cells, column)))];
    }
    std::string list;
    std::size_t named = 0;
    for (const auto& [name, count] : stations)
        if (named++ < kMostNamed) list.append(list.empty() ? "" : ", ").append(shown(name));
    if (stations.size() > kMostNamed)
        list.append(" and ").append(std::to_string(stations.size() - kMostNamed)).append(" more");
    if (!options.station.empty()) {
        if (!stations.count(options.station))
            throw Error("weather: Meteo-France: station '" + shown(options.station) +
                            "' is not in the file, which has " + list,
                        "Give one of them with --station.");
        return options.station;
    }
    if (stations.size() > 1)
        throw Error("weather: Meteo-France: " + std::to_string(stations.size()) +
                        " stations in the file: " + list,
                    "Say which one with --station.");
    return stations.empty() ? std::string() : stations.begin()->first;
}

DatedRows rows_of_station(const std::string& chosen, std::size_t station, std::size_t stamp)
{
    return {.separator = ';',
            .time_of = [=](const Cells& cells) { return time_of_cell(cell_of(cells, stamp)); },
            .skip = [=](const Cells& cells) { return trimmed(cell_of(cells, station)) != chosen; }};
}

void read_hours(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    const TableHeader header(lines.next().value_or(""), ';');
    const std::size_t station = header.at("num_poste"), stamp = header.at("aaaammjjhh"),
                      name = header.at("nom_usuel"), lat = header.at("lat"),
                      lon = header.at("lon"), height = header.at("alti"), oktas = header.at("n");
    if (stamp == TableHeader::kNone)
        throw Error("weather: Meteo-France: this file has no column AAAAMMJJHH: it holds days or "
                    "minutes",
                    "Take the hours of the climate base.");
    const std::string chosen = station_of(lines, station, options);
    rows.times_name_their_zone();
    // The quality of a value stands in its own column; both are found by name.
    std::vector<std::size_t> value_at, quality_at;
    for (const TableColumn& c : kHours) {
        value_at.push_back(header.at(c.name));
        quality_at.push_back(header.at("q" + std::string(c.name)));
    }
    (void)header.at("qn");
    rows.unread_columns(header.unread());
    for (const Field f : {Field::Shortwave, Field::Diffuse, Field::Longwave}) rows.means_of_past(f);
    std::size_t doubtful = 0;
    const DatedRows how = rows_of_station(chosen, station, stamp);
    for_dated_rows(lines, how, rows, [&](const DatedRow& row) {
        if (!rows.begin_row(row.time_us, row.line)) return;
        Site& site = rows.site();
        if (std::isnan(site.latitude_deg)) {
            site.latitude_deg = to_number(cell_of(row.cells, lat)).value_or(kMissing);
            site.longitude_deg = to_number(cell_of(row.cells, lon)).value_or(kMissing);
            site.elevation_m = to_number(cell_of(row.cells, height)).value_or(kMissing);
            site.name = shown(cell_of(row.cells, name));
        }
        for (std::size_t i = 0; i < value_at.size(); ++i) {
            if (value_at[i] == TableHeader::kNone) continue;
            const TableColumn& c = kHours[i];
            const auto cell = trimmed(cell_of(row.cells, value_at[i]));
            auto value = number_or_none(cell);
            if (trimmed(cell_of(row.cells, quality_at[i])) == "2") {
                doubtful += value && !std::isnan(*value);
                value.reset();
            }
            put_cell(c, cell, value, rows);
        }
        // 9 oktas: the sky is not to be seen.
        if (const auto n = to_number(cell_of(row.cells, oktas)); n && *n >= 0.0 && *n <= 9.0)
            rows.set(Field::Cloud, std::min(*n / 8.0, 1.0));
    });
    if (doubtful)
        rows.note(ReadNote::Kind::Info, 0, "missing",
                  std::to_string(doubtful) + " values that their code calls doubtful, left out");
}

void read_synop(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    const TableHeader header(lines.next().value_or(""), ';');
    const std::size_t station = header.at("numer_sta"), stamp = header.at("date"),
                      code = header.at("ww");
    struct Sum {
        std::size_t at;
        double hours;
    };
    const Sum sums[] = {{header.at("rr1"), 1.0},
                        {header.at("rr3"), 3.0},
                        {header.at("rr6"), 6.0},
                        {header.at("rr12"), 12.0},
                        {header.at("rr24"), 24.0}};
    const std::string chosen = station_of(lines, station, options);
    rows.site().name = chosen;
    rows.times_name_their_zone();
    rows.note(ReadNote::Kind::Info, 0, "place",
              "the place of the station is not in the file: give latitude and longitude");
    // Messages come every three hours or every hour: what fell in less than that is not all of it.
    const DatedRows of_station = rows_of_station(chosen, station, stamp);
    const double step_h = usual_step_h(lines, of_station);
    TableRows how;
    how.separator = ';';
    how.columns = kSynop;
    how.value_of = [](std::string_view cell) { return number_or_none(cell, {"mq"}); };
    how.time_of = of_station.time_of;
    how.skip = of_station.skip;
    how.also = [&](const std::vector<std::string_view>& f) {
        for (const Sum& sum : sums)
            if (const auto mm = to_number(cell_of(f, sum.at)); mm && sum.hours >= step_h)
                rows.fell_before(Field::Precip, std::max(*mm, 0.0), sum.hours);
        const auto ww = to_integer(cell_of(f, code));
        if (!ww || *ww < 0 || *ww > 99) return;
        const PresentWeather w = weather_of_code(static_cast<int>(*ww), false);
        if (w.falls) rows.set(Field::SnowShare, w.snow_share());
    };
    read_table_rows(lines, header, how, rows);
}

bool recognise_hours(const FileHead& head)
{
    return head.first.rfind("num_poste;nom_usuel;", 0) == 0;
}
bool recognise_synop(const FileHead& head)
{
    return head.first.rfind("numer_sta;date;", 0) == 0;
}

}  // namespace

extern const Reader meteo_france_reader;
const Reader meteo_france_reader{"Meteo-France", "hours of the climate base of Meteo-France",
                                 recognise_hours, read_hours};
extern const Reader meteo_france_synop_reader;
const Reader meteo_france_synop_reader{"Meteo-France SYNOP", "messages of its stations, by month",
                                       recognise_synop, read_synop};

}  // namespace petrichor::weather
