// NOAA GHCN hourly: a table with | between cells, a row a report, each value with codes of its
// measurement, quality and source. UTC, C, hPa, m/s, km, mm of 1, 3, 6 .. 24 hours, snow depth in
// cm (mm in older editions is not used by NOAA any more). Quality 2, 3, 6, 7 is suspect or wrong.
#include <algorithm>
#include <array>
#include <cmath>

#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

struct Column {
    const char* name;
    Field field;
    double scale, offset, fell_hours;
};
constexpr Column kColumns[] = {
    {"temperature", Field::AirTemp, 1.0, kZeroCelsiusK, 0.0},
    {"dew_point_temperature", Field::DewPoint, 1.0, kZeroCelsiusK, 0.0},
    {"station_level_pressure", Field::Pressure, 100.0, 0.0, 0.0},
    {"wind_direction", Field::WindFrom, 1.0, 0.0, 0.0},
    {"wind_speed", Field::Wind, 1.0, 0.0, 0.0},
    {"relative_humidity", Field::RelHumidity, 1.0, 0.0, 0.0},
    {"visibility", Field::Visibility, 1000.0, 0.0, 0.0},
    {"snow_depth", Field::SnowDepth, 0.01, 0.0, 0.0},
    {"precipitation", Field::Precip, 1.0, 0.0, 1.0},
    {"precipitation_3_hour", Field::Precip, 1.0, 0.0, 3.0},
    {"precipitation_6_hour", Field::Precip, 1.0, 0.0, 6.0},
    {"precipitation_9_hour", Field::Precip, 1.0, 0.0, 9.0},
    {"precipitation_12_hour", Field::Precip, 1.0, 0.0, 12.0},
    {"precipitation_15_hour", Field::Precip, 1.0, 0.0, 15.0},
    {"precipitation_18_hour", Field::Precip, 1.0, 0.0, 18.0},
    {"precipitation_21_hour", Field::Precip, 1.0, 0.0, 21.0},
    {"precipitation_24_hour", Field::Precip, 1.0, 0.0, 24.0},
};

bool suspect(std::string_view quality)
{
    return quality == "2" || quality == "3" || quality == "6" || quality == "7";
}

// The last two digits of a code such as "61" or "RA:61", or -1.
int code_of(std::string_view cell)
{
    const auto colon = cell.rfind(':');
    const auto digits = to_integer(colon == cell.npos ? cell : cell.substr(colon + 1));
    return digits && *digits >= 0 && *digits <= 99 ? static_cast<int>(*digits) : -1;
}

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    const TableHeader header(lines.next().value_or(""), '|');
    struct Place {
        const Column* column;
        std::size_t at, quality;
    };
    std::vector<Place> places;
    for (const Column& c : kColumns) {
        if (header.has(c.name))
            places.push_back(
                {&c, header.at(c.name), header.at(std::string(c.name) + "_quality_code")});
    }
    constexpr std::array<const char*, 5> kParts{"year", "month", "day", "hour", "minute"};
    std::array<std::size_t, 5> part{};
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = header.at(kParts[i]);
    const std::size_t date = header.at("date"), sea = header.at("sea_level_pressure"),
                      temp = header.at("temperature");
    std::size_t dropped = 0;
    rows.join_same_times();
    rows.site().utc_offset_h = kMissing;
    std::vector<std::string_view> f;
    while (const auto line = lines.next()) {
        if (trimmed(*line).empty()) continue;
        split(*line, '|', f, 1024);
        std::optional<std::int64_t> us;
        if (date != TableHeader::kNone) us = us_from_iso(cell_of(f, date));
        if (!us) {
            std::array<long long, 5> n{};
            bool good = true;
            for (std::size_t i = 0; i < n.size(); ++i) {
                const auto number = to_integer(cell_of(f, part[i]));
                good = good && number && *number >= 0 && *number < 3000;
                n[i] = number.value_or(0);
            }
            if (good)
                us = us_from_civil({n[0], static_cast<int>(n[1]), static_cast<int>(n[2]),
                                    static_cast<int>(n[3]), static_cast<int>(n[4]), 0.0});
        }
        if (!us) {
            rows.bad_row(lines.number(), "time", "'" + shown(*line) + "' has no time");
            continue;
        }
        if (std::isnan(rows.site().latitude_deg)) {
            rows.site().latitude_deg =
                to_number(cell_of(f, header.at("latitude"))).value_or(kMissing);
            rows.site().longitude_deg =
                to_number(cell_of(f, header.at("longitude"))).value_or(kMissing);
            rows.site().elevation_m =
                to_number(cell_of(f, header.at("elevation"))).value_or(kMissing);
            rows.site().name = shown(cell_of(f, header.at("station_name")));
        }
        if (!rows.begin_row(*us, lines.number())) continue;
        bool pressure = false;
        for (const Place& p : places) {
            const auto cell = cell_of(f, p.at);
            const auto value = to_number(cell);
            if (cell.empty() || (value && (*value <= -999.0 || *value >= 99999.0))) {
                rows.missing(p.column->field);
            } else if (!value) {
                rows.unreadable(p.column->field, cell);
            } else if (suspect(cell_of(f, p.quality))) {
                rows.missing(p.column->field);
                ++dropped;
            } else if (p.column->fell_hours > 0.0) {
                rows.fell_before(p.column->field, *value, p.column->fell_hours);
            } else {
                rows.set(p.column->field, *value * p.column->scale + p.column->offset);
                pressure = pressure || p.column->field == Field::Pressure;
            }
        }
        if (const auto hpa = to_number(cell_of(f, sea)); hpa && !pressure) {
            const double z = std::isnan(options.site.elevation_m) ? rows.site().elevation_m
                                                                  : options.site.elevation_m;
            const auto c = to_number(cell_of(f, temp));
            rows.set(Field::Pressure,
                     station_pressure_pa(*hpa * 100.0, z, c ? *c + kZeroCelsiusK : kMissing));
        }
        double cloud = kMissing;
        for (const char* name : {"sky_cover_1", "sky_cover_2", "sky_cover_3"}) {
            const double c = cloud_of_word(cell_of(f, header.at(name)));
            if (!std::isnan(c)) cloud = std::isnan(cloud) ? c : std::max(cloud, c);
        }
        if (!std::isnan(cloud)) rows.set(Field::Cloud, cloud);
        for (const auto& [name, automatic] :
             {std::pair{"pres_wx_mw1", false}, {"pres_wx_aw1", true}}) {
            const int code = code_of(cell_of(f, header.at(name)));
            const PresentWeather w = code < 0 ? PresentWeather{} : weather_of_code(code, automatic);
            if (!w.falls) continue;
            rows.set(Field::SnowShare, w.snow_share());
            break;
        }
    }
    // Every value has its codes beside it.
    auto unread = header.unread();
    std::erase_if(unread, [](const std::string& name) {
        return name.ends_with("_code") || name.ends_with("_report_type") ||
               name.ends_with("_source_station_id");
    });
    rows.unread_columns(unread);
    if (dropped)
        rows.note(ReadNote::Kind::Info, 0, "quality",
                  std::to_string(dropped) + " values that failed a check, taken as missing");
}

bool recognise(const FileHead& head)
{
    return head.first.find('|') != head.first.npos && head.has_columns({"temperature"}) &&
           (head.has_columns({"station_id"}) || head.has_columns({"station"}));
}

}  // namespace

extern const Reader ghcnh_reader;
const Reader ghcnh_reader{"GHCN hourly", "NOAA, the follower of ISD", recognise, read};

}  // namespace petrichor::weather
