// Meteostat hourly CSV, with a time or with a date and an hour (the archive's own files, which have
// no header). UTC. C, %, mm of the hour before, snow DEPTH in mm, degrees, km/h, hPa at sea level;
// coco is a code of the weather.
#include <algorithm>
#include <cmath>

#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

constexpr TableColumn kColumns[] = {
    {"temp", Field::AirTemp, 1.0, kZeroCelsiusK},
    {"dwpt", Field::DewPoint, 1.0, kZeroCelsiusK},
    {"rhum", Field::RelHumidity},
    {"prcp", Field::Precip, 1.0, 0.0, 1.0},
    {"snow", Field::SnowDepth, 0.001},
    {"snwd", Field::SnowDepth, 0.001},
    {"wdir", Field::WindFrom},
    {"wspd", Field::Wind, 1.0 / 3.6},
};

// Codes 1 to 27: clear, fair, cloudy, overcast, fog, freezing fog, rain, .., storm.
double cloud_of_code(int code)
{
    constexpr double kSky[] = {0.0, 0.2, 0.7, 1.0};
    if (code >= 1 && code <= 4) return kSky[code - 1];
    return code >= 7 && code <= 26 ? 1.0 : kMissing;
}
double snow_share_of_code(int code)
{
    if (code == 12 || code == 13 || code == 19 || code == 20) return 0.5;  // sleet
    if ((code >= 14 && code <= 16) || code == 21 || code == 22) return 1.0;
    if ((code >= 7 && code <= 11) || code == 17 || code == 18) return 0.0;
    return kMissing;
}

constexpr std::string_view kNames =
    "date,hour,temp,dwpt,rhum,prcp,snow,wdir,wspd,wpgt,pres,tsun,coco";

bool without_header(std::string_view line)
{
    const auto f = split(line, ',', 16);
    return f.size() == 13 && f[0].size() == 10 && f[0][4] == '-' && us_from_iso(f[0]) &&
           f[1].size() <= 2 && to_integer(f[1]);
}

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    const bool bare = without_header(FileHead(text).lines.front());
    const TableHeader header(bare ? kNames : lines.next().value_or(""), ',');
    const std::size_t time = header.at("time"), date = header.at("date"), hour = header.at("hour"),
                      temp = header.at("temp"), pressure = header.at("pres"),
                      code = header.at("coco");
    rows.site().utc_offset_h = 0.0;
    const double elevation = options.site.elevation_m;
    rows.note(ReadNote::Kind::Info, 0, "pressure",
              std::isnan(elevation) ? "given for sea level; give the elevation to bring it down"
                                    : "given for sea level, brought to the station");
    TableRows how;
    how.columns = kColumns;
    how.value_of = [](std::string_view cell) -> std::optional<double> {
        if (cell.empty() || cell == "NaN" || cell == "nan" || cell == "<NA>") return std::nullopt;
        return to_number(cell).value_or(kMissing);
    };
    how.time_of = [&](const std::vector<std::string_view>& f) -> std::optional<std::int64_t> {
        if (time != TableHeader::kNone) return us_from_iso(cell_of(f, time));
        const auto day = us_from_iso(cell_of(f, date));
        const auto h = to_integer(cell_of(f, hour));
        if (!day || !h || *h < 0 || *h > 24) return std::nullopt;
        return *day + *h * 3600000000LL;
    };
    how.also = [&](const std::vector<std::string_view>& f) {
        if (const auto sea = to_number(cell_of(f, pressure))) {
            const auto c = to_number(cell_of(f, temp));
            rows.set(Field::Pressure, station_pressure_pa(*sea * 100.0, elevation,
                                                          c ? *c + kZeroCelsiusK : kMissing));
        } else {
            rows.missing(Field::Pressure);
        }
        const auto number = to_number(cell_of(f, code));
        if (!number || *number < 1.0 || *number > 27.0) return;
        const int coco = static_cast<int>(*number);
        const double cloud = cloud_of_code(coco), share = snow_share_of_code(coco);
        if (!std::isnan(cloud)) rows.set(Field::Cloud, cloud);
        if (!std::isnan(share)) rows.set(Field::SnowShare, share);
    };
    read_table_rows(lines, header, how, rows);
}

bool recognise(const FileHead& head)
{
    return head.has_columns({"temp", "rhum", "prcp", "wspd"}) || without_header(head.lines.front());
}

}  // namespace

extern const Reader meteostat_reader;
const Reader meteostat_reader{"Meteostat", "Meteostat hourly CSV", recognise, read};

}  // namespace petrichor::weather
