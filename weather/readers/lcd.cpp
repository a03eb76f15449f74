// NOAA Local Climatological Data, CSV: reports with columns HourlyDryBulbTemperature and so on, in
// local standard time. Editions differ in units: F, inHg, mph, inches, miles before 2024, then C,
// hPa, m/s, mm, km; the size of the pressure tells. An s marks a suspect value, T a trace.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

std::optional<double> number_of(std::string_view cell)
{
    cell = trimmed(cell);
    if (cell == "T") return 0.0;
    while (!cell.empty() && (cell.back() == 's' || cell.back() == 'V')) cell.remove_suffix(1);
    return to_number(cell);
}

// Whether the file is in SI units: pressures of hundreds are hPa, of tens inches of mercury.
bool metric_units(Lines lines, const TableHeader& header)
{
    std::vector<std::string_view> f;
    while (const auto line = lines.next()) {
        split(*line, ',', f, 1024);
        for (const char* name :
             {"hourlystationpressure", "hourlyaltimetersetting", "hourlysealevelpressure"}) {
            const auto value = number_of(cell_of(f, header.at(name)));
            if (value && *value > 0.0) return *value > 200.0;
        }
    }
    return false;
}

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    const TableHeader header(lines.next().value_or(""), ',');
    const bool metric = metric_units(lines, header);
    const double f_scale = metric ? 1.0 : 5.0 / 9.0;
    const double f_offset = metric ? kZeroCelsiusK : kZeroCelsiusK - 32.0 * 5.0 / 9.0;
    const double pressure = metric ? 100.0 : 3386.389;
    const std::array<TableColumn, 8> columns{{
        {"hourlydrybulbtemperature", Field::AirTemp, f_scale, f_offset},
        {"hourlydewpointtemperature", Field::DewPoint, f_scale, f_offset},
        {"hourlyrelativehumidity", Field::RelHumidity},
        {"hourlystationpressure", Field::Pressure, pressure},
        {"hourlywinddirection", Field::WindFrom},
        {"hourlywindspeed", Field::Wind, metric ? 1.0 : 0.44704},
        {"hourlyvisibility", Field::Visibility, metric ? 1000.0 : 1609.344},
        {"hourlyprecipitation", Field::Precip, metric ? 1.0 : 25.4, 0.0, 1.0},
    }};
    {
        Lines below = lines;
        const auto f = split(below.next().value_or(""), ',', 1024);
        Site& site = rows.site();
        site.latitude_deg = to_number(cell_of(f, header.at("latitude"))).value_or(kMissing);
        site.longitude_deg = to_number(cell_of(f, header.at("longitude"))).value_or(kMissing);
        site.elevation_m = to_number(cell_of(f, header.at("elevation"))).value_or(kMissing);
        site.name = shown(cell_of(f, header.at("name")));
    }
    const double longitude = std::isnan(options.site.longitude_deg) ? rows.site().longitude_deg
                                                                    : options.site.longitude_deg;
    const double zone_h = zone_of_longitude_h(longitude);
    rows.site().utc_offset_h = zone_h;
    char said[160];
    std::snprintf(said, sizeof said,
                  "local standard time; the zone is taken from the longitude: UTC%+g h", zone_h);
    rows.note(ReadNote::Kind::Time, 1, "time", said);
    rows.note(ReadNote::Kind::Info, 1, "units",
              metric ? "C, hPa, m/s, mm, km" : "F, inHg, mph, inches, miles");
    const std::size_t date = header.at("date"), kind = header.at("report_type"),
                      sky = header.at("hourlyskyconditions"),
                      weather = header.at("hourlypresentweathertype");
    rows.join_same_times();
    TableRows how;
    how.columns = columns;
    how.value_of = [](std::string_view cell) -> std::optional<double> {
        if (cell.empty() || cell == "*" || cell == "M" || cell == "VRB") return std::nullopt;
        return number_of(cell).value_or(kMissing);
    };
    how.time_of = [&](const std::vector<std::string_view>& f) -> std::optional<std::int64_t> {
        auto us = us_from_iso(cell_of(f, date));
        if (us) *us -= static_cast<std::int64_t>(zone_h * 3600e6);
        return us;
    };
    // Sums of days and months have no place in a series of hours.
    how.skip = [&](const std::vector<std::string_view>& f) {
        const auto type = cell_of(f, kind).substr(0, 3);
        return type == "SOD" || type == "SOM";
    };
    how.also = [&](const std::vector<std::string_view>& f) {
        double cloud = kMissing;
        for (const auto word : words(cell_of(f, sky), 32)) {
            const double c = cloud_of_word(word);
            if (!std::isnan(c)) cloud = std::isnan(cloud) ? c : std::max(cloud, c);
        }
        if (!std::isnan(cloud)) rows.set(Field::Cloud, cloud);
        // "-SN:03 BR:1 |SN:71 |": the first part is in words of METAR.
        auto said_weather = cell_of(f, weather);
        said_weather = said_weather.substr(0, said_weather.find('|'));
        std::string plain;
        for (const auto word : words(said_weather, 8))
            plain.append(word.substr(0, word.find(':'))).append(" ");
        const PresentWeather w = present_weather(plain);
        if (w.falls) rows.set(Field::SnowShare, w.snow_share());
    };
    read_table_rows(lines, header, how, rows);
}

bool recognise(const FileHead& head)
{
    return head.has_columns({"date", "hourlydrybulbtemperature"});
}

}  // namespace

extern const Reader lcd_reader;
const Reader lcd_reader{"LCD", "NOAA Local Climatological Data", recognise, read};

}  // namespace petrichor::weather
