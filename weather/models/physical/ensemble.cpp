#include "weather/models/physical/ensemble.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "weather/models/physical/physical_grid.h"
#include "weather/physics/constants.h"
#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather {

namespace {

// A number in 0..1 from seed and index alone: the same for any order and thread.
double uniform(std::uint64_t seed, std::uint64_t index)
{
    std::uint64_t x =
        seed * 0x9E3779B97F4A7C15ull + index * 0xBF58476D1CE4E5B9ull + 0x94D049BB133111EBull;
    x ^= x >> 30;
    x *= 0xBF58476D1CE4E5B9ull;
    x ^= x >> 27;
    x *= 0x94D049BB133111EBull;
    x ^= x >> 31;
    return (static_cast<double>(x >> 11) + 0.5) * 0x1.0p-53;
}

// Standard normal by Box and Muller.
double normal(std::uint64_t seed, std::uint64_t index)
{
    const double u = uniform(seed, 2 * index), v = uniform(seed, 2 * index + 1);
    return std::sqrt(-2.0 * detail::logarithm(u)) * detail::sine_cosine(2.0 * kPi * v).cos;
}

struct Change {
    double precip_log = 0.0, air_k = 0.0, wind_log = 0.0, cloud_w_m2 = 0.0;
};

GridCell changed_cell(const ForcingTable& table, const Change& change)
{
    GridCell cell;
    cell.elevation_m = std::isnan(table.site.elevation_m) ? 0.0 : table.site.elevation_m;
    cell.precip_factor = detail::exponential(change.precip_log);
    cell.air_offset_k = change.air_k;
    cell.wind_factor = detail::exponential(change.wind_log);
    cell.longwave_offset_w_m2 = change.cloud_w_m2;
    // 15 W/m2 more from the sky goes with about a tenth less sun.
    cell.shortwave_factor = detail::clamped(1.0 - 0.1 * change.cloud_w_m2 / 15.0, 0.0, 2.0);
    return cell;
}

GridParams grid_params(const PhysicalParams& params, int threads)
{
    GridParams grid;
    grid.model = params;
    grid.surfaces = {params.surface};
    grid.threads = threads;
    return grid;
}

void percentiles(std::vector<double>& values, double* out)
{
    std::sort(values.begin(), values.end());
    constexpr double kShares[] = {0.1, 0.5, 0.9};
    for (int i = 0; i < 3; ++i) {
        const double at = kShares[i] * static_cast<double>(values.size() - 1);
        const auto low = static_cast<std::size_t>(at);
        const std::size_t high = std::min(low + 1, values.size() - 1);
        out[i] = values[low] + (values[high] - values[low]) * (at - static_cast<double>(low));
    }
}

}  // namespace

std::vector<EnsembleRow> run_ensemble(const ForcingTable& table, const PhysicalParams& params,
                                      const EnsembleParams& e, std::size_t every_steps)
{
    if (e.members < 1 || e.members > 10000) {
        throw Error("ensemble: members must be 1..10000, got " + std::to_string(e.members),
                    "Give a number of members in range.");
    }
    if (every_steps == 0)
        throw Error("ensemble: rows must be at least a step apart", "Give --every a step or more.");
    const auto count = static_cast<std::size_t>(e.members);
    std::vector<GridCell> cells;
    for (std::size_t m = 0; m < count; ++m) {
        Change change;
        if (m > 0) {
            change.precip_log = e.spread.precip_log * normal(e.seed, 4 * m);
            change.air_k = e.spread.air_k * normal(e.seed, 4 * m + 1);
            change.wind_log = e.spread.wind_log * normal(e.seed, 4 * m + 2);
            change.cloud_w_m2 = e.spread.cloud_w_m2 * normal(e.seed, 4 * m + 3);
        }
        cells.push_back(changed_cell(table, change));
    }
    PhysicalGrid grid(table, grid_params(params, e.threads), cells);
    std::vector<EnsembleRow> rows;
    std::vector<double> values(count);
    const auto take = [&] {
        EnsembleRow row;
        row.time_us = grid.time_us();
        const std::vector<CellState> states = grid.save();
        const auto put = [&](double* out, auto&& value) {
            for (std::size_t m = 0; m < count; ++m) values[m] = value(states[m]);
            percentiles(values, out);
        };
        put(row.depth_m, [](const CellState& c) { return diagnostics(c).snow_depth_m; });
        put(row.swe_kg_m2, [](const CellState& c) { return diagnostics(c).swe_kg_m2; });
        put(row.film_kg_m2, [](const CellState& c) { return c.film; });
        put(row.puddle_kg_m2, [](const CellState& c) { return c.puddle; });
        put(row.surface_c, [](const CellState& c) { return c.surface_temp_c; });
        rows.push_back(row);
    };
    take();
    while (grid.step() < grid.steps()) {
        grid.advance(every_steps);
        take();
    }
    return rows;
}

std::vector<Sensitivity> sensitivity_table(const ForcingTable& table, const PhysicalParams& params,
                                           const EnsembleSpread& spread)
{
    const auto times = [](const char* what, double log_factor) {
        char text[80];
        std::snprintf(text, sizeof text, "%s x %.2f", what, detail::exponential(log_factor));
        return std::string(text);
    };
    const auto plus = [](const char* what, double amount, const char* unit) {
        char text[80];
        std::snprintf(text, sizeof text, "%s %+g %s", what, amount, unit);
        return std::string(text);
    };
    const double p = spread.precip_log, t = spread.air_k, u = spread.wind_log,
                 c = spread.cloud_w_m2;
    const std::vector<std::pair<std::string, Change>> changes = {
        {"as given", {}},
        {times("precipitation", -p), {-p, 0, 0, 0}},
        {times("precipitation", p), {p, 0, 0, 0}},
        {plus("temperature", -t, "K"), {0, -t, 0, 0}},
        {plus("temperature", t, "K"), {0, t, 0, 0}},
        {times("wind", -u), {0, 0, -u, 0}},
        {times("wind", u), {0, 0, u, 0}},
        {plus("sky", -c, "W/m2"), {0, 0, 0, -c}},
        {plus("sky", c, "W/m2"), {0, 0, 0, c}},
    };
    std::vector<GridCell> cells;
    for (const auto& [name, change] : changes) cells.push_back(changed_cell(table, change));
    PhysicalGrid grid(table, grid_params(params, 1), cells);
    std::vector<Sensitivity> out(changes.size());
    double samples = 0.0;
    while (grid.step() < grid.steps()) {
        const std::int64_t before = grid.time_us();
        grid.advance(6);
        const double days = static_cast<double>(grid.time_us() - before) / 86400e6;
        samples += 1.0;
        for (std::size_t i = 0; i < out.size(); ++i) {
            const CellState cell = grid.state(i);
            const auto d = diagnostics(cell);
            out[i].peak_swe_kg_m2 = std::max(out[i].peak_swe_kg_m2, d.swe_kg_m2);
            if (d.snow_depth_m > 0.01) out[i].snow_days += days;
            out[i].mean_film_kg_m2 += cell.film;
            out[i].mean_puddle_kg_m2 += cell.puddle;
            out[i].mean_surface_c += cell.surface_temp_c;
        }
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i].change = changes[i].first;
        out[i].mean_film_kg_m2 /= samples;
        out[i].mean_puddle_kg_m2 /= samples;
        out[i].mean_surface_c /= samples;
    }
    return out;
}

}  // namespace petrichor::weather
