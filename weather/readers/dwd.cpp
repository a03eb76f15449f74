// Deutscher Wetterdienst, CDC: station files with STATIONS_ID;MESS_DATUM;.. of one quantity each
// (temperature and humidity, precipitation, wind, pressure, radiation, cloud, visibility, dew
// point, snow), hourly or every 10 minutes, UTC. -999 is missing. Files of one station are joined
// by giving them together. Sums belong to the time before their row. The place is in other files.
#include <algorithm>
#include <cmath>

#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

constexpr double kHour_j_cm2 = 1.0e4 / 3600.0, kTenMinutes_j_cm2 = 1.0e4 / 600.0;
constexpr TableColumn kColumns[] = {
    {"tt_tu", Field::AirTemp, 1.0, kZeroCelsiusK},
    {"tt_10", Field::AirTemp, 1.0, kZeroCelsiusK},
    {"rf_tu", Field::RelHumidity},
    {"rf_10", Field::RelHumidity},
    {"td_10", Field::DewPoint, 1.0, kZeroCelsiusK},
    {"td", Field::DewPoint, 1.0, kZeroCelsiusK},
    {"r1", Field::Precip, 1.0, 0.0, 1.0},
    {"rws_10", Field::Precip, 1.0, 0.0, 1.0 / 6.0},
    {"f", Field::Wind},
    {"ff_10", Field::Wind},
    {"d", Field::WindFrom},
    {"dd_10", Field::WindFrom},
    {"p0", Field::Pressure, 100.0},
    {"pp_10", Field::Pressure, 100.0},
    {"fg_lberg", Field::Shortwave, kHour_j_cm2},
    {"fd_lberg", Field::Diffuse, kHour_j_cm2},
    {"atmo_lberg", Field::Longwave, kHour_j_cm2},
    {"gs_10", Field::Shortwave, kTenMinutes_j_cm2},
    {"ds_10", Field::Diffuse, kTenMinutes_j_cm2},
    {"ls_10", Field::Longwave, kTenMinutes_j_cm2},
    {"v_vv", Field::Visibility},
    {"sh_tag", Field::SnowDepth, 0.01},
    {"sh_10", Field::SnowDepth, 0.01},
    {"wash_6", Field::SnowWater},
};

// Form of precipitation (WRTR): 1, 4, 6 liquid; 7 solid; 8 both; 2, 3, 5 .. say nothing.
double snow_share_of(std::string_view wrtr)
{
    const auto form = to_integer(wrtr);
    if (!form) return kMissing;
    return *form == 7                               ? 1.0
           : *form == 8                             ? 0.5
           : *form == 6 || *form == 1 || *form == 4 ? 0.0
                                                    : kMissing;
}

void read(std::string_view text, RowCollector& rows, const ReadOptions&)
{
    Lines lines(text);
    const TableHeader header(lines.next().value_or(""), ';');
    const std::size_t time = header.at("mess_datum"), form = header.at("wrtr"),
                      oktas = header.at("v_n");
    for (const Field f : {Field::Shortwave, Field::Diffuse, Field::Longwave}) rows.means_of_past(f);
    TableRows how;
    how.separator = ';';
    how.columns = kColumns;
    how.value_of = [](std::string_view cell) -> std::optional<double> {
        const auto value = to_number(cell);
        if (cell.empty() || (value && *value <= -999.0)) return std::nullopt;
        return value.value_or(kMissing);
    };
    how.time_of = [&](const std::vector<std::string_view>& f) -> std::optional<std::int64_t> {
        const auto when = cell_of(f, time);  // YYYYMMDDhh, YYYYMMDDhhmm, YYYYMMDDhh:mm, YYYYMMDD
        if (when.size() < 8) return std::nullopt;
        std::string iso(when.substr(0, 4));
        iso.append("-").append(when.substr(4, 2)).append("-").append(when.substr(6, 2));
        if (when.size() >= 10) {
            const auto minute = when.size() >= 12 ? when.substr(when.size() - 2) : "00";
            iso.append(" ").append(when.substr(8, 2)).append(":").append(minute);
        }
        return us_from_iso(iso);
    };
    how.also = [&](const std::vector<std::string_view>& f) {
        const double share = snow_share_of(cell_of(f, form));
        if (!std::isnan(share)) rows.set(Field::SnowShare, share);
        const auto cloud = to_number(cell_of(f, oktas));
        if (cloud && *cloud >= 0.0 && *cloud <= 8.0) rows.set(Field::Cloud, *cloud / 8.0);
    };
    read_table_rows(lines, header, how, rows);
}

bool recognise(const FileHead& head)
{
    return head.first.rfind("stations_id;mess_datum", 0) == 0;
}

}  // namespace

extern const Reader dwd_reader;
const Reader dwd_reader{"DWD", "station files of the German weather service", recognise, read};

}  // namespace petrichor::weather
