// Iowa Environmental Mesonet, airport reports as a table without the reports themselves: station,
// valid, tmpf, dwpf, relh, drct, sknt, p01i, alti, mslp, vsby, skyc1.., wxcodes, snowdepth. UTC
// unless ordered otherwise. M is missing, T a trace. (With a column metar the reports are read.)
#include <algorithm>
#include <cmath>

#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

constexpr double kF = 5.0 / 9.0, kFOffset = kZeroCelsiusK - 32.0 * 5.0 / 9.0;
constexpr TableColumn kColumns[] = {
    {"tmpf", Field::AirTemp, kF, kFOffset},
    {"tmpc", Field::AirTemp, 1.0, kZeroCelsiusK},
    {"dwpf", Field::DewPoint, kF, kFOffset},
    {"dwpc", Field::DewPoint, 1.0, kZeroCelsiusK},
    {"relh", Field::RelHumidity},
    {"drct", Field::WindFrom},
    {"sknt", Field::Wind, 1852.0 / 3600.0},
    {"sped", Field::Wind, 0.44704},
    {"p01i", Field::Precip, 25.4, 0.0, 1.0},
    {"p01m", Field::Precip, 1.0, 0.0, 1.0},
    {"vsby", Field::Visibility, 1609.344},
    {"snowdepth", Field::SnowDepth, 0.0254},
};

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    std::string_view names = lines.next().value_or("");
    while (!names.empty() && names.front() == '#') names = lines.next().value_or("");
    const TableHeader header(names, ',');
    const std::size_t stamp = header.has("valid") ? header.at("valid") : header.at("valid(utc)"),
                      station = header.at("station"), latitude = header.at("lat"),
                      longitude = header.at("lon"), elevation = header.at("elevation"),
                      altimeter = header.at("alti"), weather = header.at("wxcodes");
    std::string chosen = options.station;
    {
        Lines below = lines;
        const auto f = split(below.next().value_or(""), ',', 256);
        if (chosen.empty()) chosen = std::string(cell_of(f, station));
        rows.site().name = shown(chosen);
    }
    bool others = false;
    rows.join_same_times();
    TableRows how;
    how.columns = kColumns;
    how.value_of = [](std::string_view cell) -> std::optional<double> {
        if (cell.empty() || cell == "M" || cell == "null") return std::nullopt;
        if (cell == "T") return 0.0;
        return to_number(cell).value_or(kMissing);
    };
    how.time_of = [&](const std::vector<std::string_view>& f) {
        return us_from_iso(cell_of(f, stamp));
    };
    how.skip = [&](const std::vector<std::string_view>& f) {
        if (cell_of(f, stamp).empty()) return false;
        const bool other = cell_of(f, station) != chosen;
        others = others || other;
        return other;
    };
    how.also = [&](const std::vector<std::string_view>& f) {
        Site& site = rows.site();
        if (std::isnan(site.latitude_deg)) {
            site.latitude_deg = to_number(cell_of(f, latitude)).value_or(kMissing);
            site.longitude_deg = to_number(cell_of(f, longitude)).value_or(kMissing);
            site.elevation_m = to_number(cell_of(f, elevation)).value_or(kMissing);
        }
        double cloud = kMissing;
        for (const char* name : {"skyc1", "skyc2", "skyc3", "skyc4"}) {
            const double c = cloud_of_word(cell_of(f, header.at(name)));
            if (!std::isnan(c)) cloud = std::isnan(cloud) ? c : std::max(cloud, c);
        }
        if (!std::isnan(cloud)) rows.set(Field::Cloud, cloud);
        if (const auto inches = to_number(cell_of(f, altimeter))) {
            double z =
                std::isnan(options.site.elevation_m) ? site.elevation_m : options.site.elevation_m;
            if (std::isnan(z)) z = 0.0;
            // Altimeter settings are reduced with the standard atmosphere.
            rows.set(Field::Pressure, *inches * 3386.389 * std::pow(1.0 - 2.25577e-5 * z, 5.25588));
        }
        const PresentWeather w = present_weather(cell_of(f, weather));
        if (w.falls) rows.set(Field::SnowShare, w.snow_share());
    };
    read_table_rows(lines, header, how, rows);
    if (others)
        rows.note(ReadNote::Kind::Info, 0, "station",
                  "several stations in the file, only " + shown(chosen) + " is used");
}

bool recognise(const FileHead& head)
{
    for (const auto line : head.lines) {
        if (trimmed(line).front() == '#') continue;
        const TableHeader header(line, ',');
        return header.has("station") && (header.has("valid") || header.has("valid(utc)")) &&
               (header.has("tmpf") || header.has("tmpc")) && !header.has("metar");
    }
    return false;
}

}  // namespace

extern const Reader iem_reader;
const Reader iem_reader{"IEM", "airport tables of the Iowa Environmental Mesonet", recognise, read};

}  // namespace petrichor::weather
