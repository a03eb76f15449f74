// fill_forcing: gaps, then humidity and pressure from what is there; the order of everything.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "weather/filling/fill_phase.h"
#include "weather/filling/fill_precipitation.h"
#include "weather/filling/fill_radiation.h"
#include "weather/forcing/forcing.h"
#include "weather/physics/constants.h"
#include "weather/physics/humidity.h"

namespace petrichor::weather {

namespace {

std::size_t count_missing(const std::vector<double>& v)
{
    return static_cast<std::size_t>(
        std::count_if(v.begin(), v.end(), [](double x) { return std::isnan(x); }));
}

// Bridges runs of NaN that are no longer than the limit; ends of the table repeat the nearest
// value.
void bridge(ForcingTable& table, ReadReport& report, Field field, const FillOptions& options)
{
    auto& v = table[field];
    if (v.empty()) return;
    const bool rate = field_info(field).is_rate && field != Field::NetShortwave;
    std::size_t short_gaps = 0, long_gaps = 0;
    std::size_t i = 0;
    while (i < v.size()) {
        if (!std::isnan(v[i])) {
            ++i;
            continue;
        }
        std::size_t end = i;
        while (end < v.size() && std::isnan(v[end])) ++end;
        if (rate) {
            for (std::size_t k = i; k < end; ++k) v[k] = 0.0;
            short_gaps += end - i;
        } else if (i > 0 || end < v.size()) {
            const std::size_t left = i > 0 ? i - 1 : end;
            const std::size_t right = end < v.size() ? end : i - 1;
            const std::int64_t span = table.time_us[right] - table.time_us[left];
            const bool too_long = right > left && span > options.longest_gap_us;
            if (!too_long || field == Field::AirTemp || field == Field::Wind ||
                field == Field::Pressure) {
                for (std::size_t k = i; k < end; ++k) {
                    double x = 0.0;
                    if (right > left) {
                        x = static_cast<double>(table.time_us[k] - table.time_us[left]) /
                            static_cast<double>(span);
                    }
                    v[k] = v[left] + (v[right] - v[left]) * x;
                }
                (too_long ? long_gaps : short_gaps) += end - i;
            }
        }
        i = end;
    }
    note_filled(report, field_info(field).name, short_gaps,
                rate ? "the file gives no amount, taken as 0" : "line between neighbours");
    note_filled(report, field_info(field).name, long_gaps, "line across a long gap");
}

void fill_humidity(ForcingTable& table, ReadReport& report)
{
    auto& rh = table[Field::RelHumidity];
    const auto& dew = table[Field::DewPoint];
    rh.resize(table.rows(), kMissing);
    std::size_t from_dew = 0, assumed = 0;
    for (std::size_t i = 0; i < rh.size(); ++i) {
        if (!std::isnan(rh[i])) continue;
        if (!dew.empty() && !std::isnan(dew[i])) {
            rh[i] = std::clamp(rel_humidity_of_dew_point_pct(table[Field::AirTemp][i], dew[i]), 1.0,
                               100.0);
            ++from_dew;
        } else {
            rh[i] = 70.0;
            ++assumed;
        }
    }
    note_filled(report, field_info(Field::RelHumidity).name, from_dew, "from the dew point");
    note_filled(report, field_info(Field::RelHumidity).name, assumed, "assumed 70 %");
}

void fill_pressure(ForcingTable& table, ReadReport& report)
{
    auto& p = table[Field::Pressure];
    p.resize(table.rows(), kMissing);
    const double z = std::isnan(table.site.elevation_m) ? 0.0 : table.site.elevation_m;
    const double standard = standard_pressure_pa(z);
    std::size_t filled = 0;
    for (double& v : p) {
        if (!std::isnan(v)) continue;
        v = standard;
        ++filled;
    }
    char how[80];
    std::snprintf(how, sizeof how, "standard pressure at %.0f m", z);
    note_filled(report, field_info(Field::Pressure).name, filled, how);
}

// Values at some of the times; NaN at the others.
std::vector<double> in_rows(const std::vector<std::int64_t>& rows_us,
                            const std::vector<std::int64_t>& own_us, const std::vector<double>& own)
{
    std::vector<double> out(rows_us.size(), kMissing);
    for (std::size_t i = 0, k = 0; i < rows_us.size() && k < own_us.size(); ++i)
        if (rows_us[i] == own_us[k]) out[i] = own[k++];
    return out;
}

}  // namespace

void fill_forcing(ForcingTable& table, ReadReport& report, const FillOptions& options)
{
    std::size_t n = table.rows();
    if (n == 0)
        throw Error("weather: the table has no rows",
                    "Give a file with at least one row of weather.");
    for (std::size_t i = 1; i < n; ++i) {
        if (table.time_us[i] <= table.time_us[i - 1]) {
            throw Error(
                "weather: times must increase, data row " + std::to_string(i + 1) + " does not",
                "Sort the rows and remove duplicates.");
        }
    }
    for (std::size_t f = 0; f < kFieldCount; ++f) {
        auto& column = table.columns[f];
        if (column.empty()) continue;
        if (column.size() != n) {
            throw Error(std::string("weather: column ") + field_info(static_cast<Field>(f)).name +
                            " has " + std::to_string(column.size()) + " values for " +
                            std::to_string(n) + " rows",
                        "Make every column as long as time_us, or leave it empty.");
        }
        for (double& v : column) {
            if (std::isinf(v)) v = kMissing;
        }
        // A column without one value says nothing.
        if (count_missing(column) == n) column.clear();
    }
    if (!table.has(Field::AirTemp)) {
        bool measured = false, weather = false;
        for (std::size_t f = 0; f < kFieldCount; ++f) {
            if (table.columns[f].empty()) continue;
            (field_info(static_cast<Field>(f)).observed ? measured : weather) = true;
        }
        if (measured && !weather)
            throw Error("weather: this file has observations alone, and no weather",
                        "Give the weather, and this file with --observed.");
        throw Error("weather: no air temperature in the file",
                    "Give a file with air temperature in every row; in a CSV its column is called "
                    "air_temp_c, air_temp_k or temperature (F).");
    }
    phase_from_depth(table, report);
    const std::vector<std::int64_t> own_us = table.time_us;
    const std::vector<double> own_air_k = table[Field::AirTemp];
    divide_for_the_sun(table, report, options);
    n = table.rows();
    bridge(table, report, Field::AirTemp, options);
    bridge(table, report, Field::DewPoint, options);
    bridge(table, report, Field::RelHumidity, options);
    bridge(table, report, Field::Wind, options);
    bridge(table, report, Field::Pressure, options);
    bridge(table, report, Field::Cloud, options);
    bridge(table, report, Field::Shortwave, options);
    bridge(table, report, Field::Longwave, options);
    bridge(table, report, Field::NetShortwave, options);
    const std::vector<bool> precip_known = known_precipitation(table);
    bridge(table, report, Field::Rain, options);
    bridge(table, report, Field::Snow, options);
    if (!table.has(Field::Rain) && !table.has(Field::Snow))
        bridge(table, report, Field::Precip, options);
    if (!table.has(Field::Wind)) {
        table[Field::Wind].assign(n, 2.0);
        note_filled(report, field_info(Field::Wind).name, n, "no wind in the file, assumed 2 m/s");
    }
    for (double& rh : table[Field::RelHumidity]) rh = std::min(rh, 100.0);
    fill_humidity(table, report);
    fill_pressure(table, report);
    fill_precipitation(table, report);
    fill_radiation(table, report, in_rows(table.time_us, own_us, own_air_k));
    const bool estimate = options.missing_precip == MissingPrecip::Estimate &&
                          !table.has(Field::Rain) && !table.has(Field::Snow);
    if (estimate) estimate_precipitation(table, report, precip_known);
    warn_of_dry_gaps(report, precip_known, estimate);
}

}  // namespace petrichor::weather
