#include "cli/bench/sample_weather.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "weather/physics/constants.h"
#include "weather/physics/solar.h"

namespace petrichor::cli {
namespace {

using weather::Field;
using weather::kPi;
using weather::kZeroCelsiusK;

constexpr std::int64_t kHour_us = 3600 * weather::kMicrosPerSecond;
constexpr std::int64_t kBegin_us = 1696118400 * weather::kMicrosPerSecond;  // 2023-10-01 00:00 UTC

double wave(double hours, double period_h, double phase)
{
    return std::sin(2.0 * kPi * hours / period_h + phase);
}

// Fronts: several periods that never meet again, -1 .. 1.
double fronts(double hours)
{
    return 0.4 * wave(hours, 83.0, 0.3) + 0.35 * wave(hours, 131.7, 1.9) +
           0.25 * wave(hours, 37.3, 4.0);
}

struct Hour {
    double temp_c, rh_pct, wind_m_s, cloud, precip_mm, shortwave_w_m2, pressure_pa;
};
Hour hour_of(int index, const weather::Site& site, bool snowy)
{
    const double hours = index;
    const double front = fronts(hours);
    const double season =
        -std::cos(2.0 * kPi * (hours / 24.0 - 107.0) / 365.0);  // coldest in the middle of January
    const double day = wave(hours, 24.0, -2.4);                 // warmest in the afternoon
    Hour h{};
    h.cloud = std::clamp(0.5 + 0.7 * front, 0.0, 1.0);
    h.temp_c = (snowy ? 4.0 : 13.0) + 9.0 * season + (5.0 - 3.0 * h.cloud) * day +
               5.0 * wave(hours, 211.0, 0.7);
    h.rh_pct = std::clamp(65.0 + 25.0 * front - 10.0 * day, 15.0, 100.0);
    h.wind_m_s = 2.5 + 1.5 * wave(hours, 53.0, 2.0) + 0.8 * day;
    h.precip_mm = front > 0.6 ? (snowy ? 10.0 : 5.0) * (front - 0.6)
                              : 0.0;  // 730 hours, 540 or 1080 mm a year
    h.pressure_pa = (snowy ? 86500.0 : 99500.0) - 900.0 * front;
    const auto sun =
        weather::sun_direction(kBegin_us + index * kHour_us, site.latitude_deg, site.longitude_deg);
    h.shortwave_w_m2 = weather::cloudy_sky_w_m2(sun.up, h.cloud);
    return h;
}

struct Date {
    int year, month, day, hour;
};
Date date_of(std::size_t row)
{
    static constexpr int kDays[] = {31, 29, 31, 30, 31, 30,
                                    31, 31, 30, 31, 30, 31};  // 2024 has a leap day
    Date d{kSampleYear, kSampleMonth, 1 + static_cast<int>(row / 24), static_cast<int>(row % 24)};
    while (d.day > kDays[d.month - 1]) {
        d.day -= kDays[d.month - 1];
        if (++d.month > 12) {
            d.month = 1;
            ++d.year;
        }
    }
    return d;
}

template <class... Values>
void append(std::string& text, const char* format, Values... values)
{
    char line[512];
    std::snprintf(line, sizeof line, format, values...);
    text += line;
}

double dew_point_c(double temp_c, double rh_pct)
{
    return temp_c - (100.0 - rh_pct) / 5.0;
}

double scattered(std::uint64_t n)
{
    n = (n ^ (n >> 30)) * 0xbf58476d1ce4e5b9ull;
    n = (n ^ (n >> 27)) * 0x94d049bb133111ebull;
    return static_cast<double>((n ^ (n >> 31)) >> 11) * 0x1p-53;
}

}  // namespace

weather::ForcingTable sample_year(int days, bool snowy)
{
    weather::ForcingTable table;
    table.site = {
        .latitude_deg = 46.0, .longitude_deg = 8.0, .elevation_m = snowy ? 1300.0 : 150.0};
    const auto rows = static_cast<std::size_t>(days) * 24;
    for (std::size_t i = 0; i < rows; ++i) {
        const Hour h = hour_of(static_cast<int>(i), table.site, snowy);
        table.time_us.push_back(kBegin_us + static_cast<std::int64_t>(i) * kHour_us);
        table[Field::AirTemp].push_back(h.temp_c + kZeroCelsiusK);
        table[Field::RelHumidity].push_back(h.rh_pct);
        table[Field::Wind].push_back(h.wind_m_s);
        table[Field::Pressure].push_back(h.pressure_pa);
        table[Field::Shortwave].push_back(h.shortwave_w_m2);
        table[Field::Cloud].push_back(h.cloud);
        table[Field::Precip].push_back(h.precip_mm / 3600.0);
    }
    weather::ReadReport report;
    weather::fill_forcing(table, report);
    return table;
}

std::string epw_of(const weather::ForcingTable& table)
{
    std::string text;
    append(text, "LOCATION,Made up,XX,NIL,SAMPLE,000000,%.2f,%.2f,0.0,%.1f\n",
           table.site.latitude_deg, table.site.longitude_deg, table.site.elevation_m);
    text +=
        "DESIGN CONDITIONS,0\nTYPICAL/EXTREME PERIODS,0\nGROUND TEMPERATURES,0\n"
        "HOLIDAYS/DAYLIGHT SAVINGS,Yes,0,0,0\nCOMMENTS 1,made up\nCOMMENTS 2,\n"
        "DATA PERIODS,1,1,Data,Sunday,10/1,9/29\n";
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const Date d = date_of(i);
        const double temp_c = table[Field::AirTemp][i] - kZeroCelsiusK;
        const double rh = table[Field::RelHumidity][i];
        const double sun = table[Field::Shortwave][i];
        append(
            text,
            "%d,%d,%d,%d,0,?9?9?9?9E0?9?9?9?9?9?9?9?9?9?9?9*9?9?9?9?9*9?9?9*9,%.1f,%.1f,%.0f,%.0f,",
            d.year, d.month, d.day, d.hour + 1, temp_c, dew_point_c(temp_c, rh), rh,
            table[Field::Pressure][i]);
        append(text, "%.0f,1300,%.0f,%.0f,%.0f,%.0f,0,0,0,0,%.0f,%.1f,", 1.3 * sun,
               table[Field::Longwave][i], sun, 0.7 * sun, 0.4 * sun,
               static_cast<double>((i * 7) % 360), table[Field::Wind][i]);
        append(text, "%.0f,%.0f,20.0,2000,9,999999999,10,0.05,0,88,0.2,%.1f,1.0\n",
               10.0 * table[Field::Cloud][i], 10.0 * table[Field::Cloud][i],
               table[Field::Precip][i] * 3600.0);
    }
    return text;
}

std::string metar_of(const weather::ForcingTable& table)
{
    std::string text;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const Date d = date_of(i);
        const int temp_c = static_cast<int>(std::lround(table[Field::AirTemp][i] - kZeroCelsiusK));
        const int dew_c =
            static_cast<int>(std::lround(dew_point_c(temp_c, table[Field::RelHumidity][i])));
        const bool wet = table[Field::Precip][i] > 0.0;
        append(text, "METAR ZZAA %02d%02d50Z %03d%02dKT 9999 %s%s %s%02d/%s%02d Q%04.0f NOSIG=\n",
               d.day, d.hour, static_cast<int>(i % 36) * 10,
               static_cast<int>(std::lround(table[Field::Wind][i] / 0.514)),
               !wet         ? ""
               : temp_c > 0 ? "-RA "
                            : "-SN ",
               table[Field::Cloud][i] > 0.6 ? "BKN020" : "FEW030", temp_c < 0 ? "M" : "",
               std::abs(temp_c), dew_c < 0 ? "M" : "", std::abs(dew_c),
               table[Field::Pressure][i] / 100.0);
    }
    return text;
}

std::vector<weather::GridCell> sample_cells(std::size_t count, double base_m)
{
    std::vector<weather::GridCell> cells(count);
    for (std::size_t i = 0; i < count; ++i) {
        cells[i].elevation_m = base_m + static_cast<double>(i % 997);
        cells[i].slope_rad = 0.01 * static_cast<double>(i % 37);
        cells[i].aspect_rad = 0.1 * static_cast<double>(i % 63);
        cells[i].surface = i % 5 == 0 ? 1u : 0u;
    }
    return cells;
}

weather::Timeline sample_timeline(int segments)
{
    weather::Timeline timeline;
    for (int i = 0; i <= segments; ++i) {
        const auto n = static_cast<std::uint64_t>(i);
        const weather::TimeUs time = 10 * weather::kMicrosPerSecond * i;
        timeline.temperature_c.times.push_back(time);
        timeline.temperature_c.values.push_back(60.0 * scattered(2 * n) - 30.0);
        timeline.rainfall.times.push_back(time);
        timeline.rainfall.values.push_back(i % 3 == 0 ? 0.0 : scattered(2 * n + 1));
    }
    timeline.temperature_c.interpolation = timeline.rainfall.interpolation =
        weather::Interpolation::Linear;
    return timeline;
}

}  // namespace petrichor::cli
