#include "cli/simulate/grid.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "base/error.h"
#include "cli/exit.h"
#include "cli/simulate/grid_progress.h"
#include "weather/models/physical/physical_grid.h"
#include "weather/physics/constants.h"
#include "weather/readers/text.h"

namespace petrichor::cli {
namespace {

constexpr const char* kColumns[] = {"time_s",
                                    "air_temp_c",
                                    "snow_cover_fraction",
                                    "snow_line_m",
                                    "rain_to_snow_height_m",
                                    "snow_depth_m",
                                    "snow_depth_max_m",
                                    "swe_kg_m2",
                                    "snow_albedo",
                                    "surface_temp_c",
                                    "film_kg_m2",
                                    "puddle_kg_m2",
                                    "ice_kg_m2",
                                    "runoff_kg_m2",
                                    "total_precip_kg_m2",
                                    "mass_residual_kg_m2"};

std::vector<PlotPanel> panels()
{
    const auto one = [](const char* title, const char* column, const char* color, const char* group,
                        bool forcing = false) {
        return PlotPanel{.title = title,
                         .forcing = forcing,
                         .series = {{.column = column, .label = "", .color = color}},
                         .low = 0.0,
                         .high = 0.0,
                         .group = group};
    };
    return {
        one("air temperature at the station, \u00b0C", "air_temp_c", "#c8442e", "weather", true),
        {.title = "snow-covered share of the ground",
         .series =
             {{.column = "snow_cover_fraction", .label = "", .color = "#4a80bd", .filled = true}},
         .group = "snow"},
        {.title = "height, m",
         .series = {{.column = "snow_line_m",
                     .label = "snow line",
                     .color = "#1f5f9e",
                     .only_where = "snow_cover_fraction",
                     .only_above = 0.001},
                    {.column = "rain_to_snow_height_m",
                     .label = "rain turns to snow",
                     .color = "#9aa6b5"}},
         .low = 0.0,
         .high = 0.0,
         .group = "snow"},
        {.title = "snow depth, m",
         .series =
             {{.column = "snow_depth_max_m", .label = "deepest", .color = "#9cc0e6"},
              {.column = "snow_depth_m", .label = "mean", .color = "#4a80bd", .filled = true}},
         .low = 0.0,
         .high = 0.0,
         .group = "snow"},
        one("mean snow water equivalent, kg/m\u00b2", "swe_kg_m2", "#1f5f9e", "snow"),
        one("mean surface temperature, \u00b0C", "surface_temp_c", "#c8442e", "heat"),
        {.title = "mean water on the ground, kg/m\u00b2",
         .series = {{.column = "film_kg_m2", .label = "film", .color = "#0e9f8e"},
                    {.column = "puddle_kg_m2", .label = "puddles", .color = "#2456c4"},
                    {.column = "ice_kg_m2", .label = "ice", .color = "#56b4e9"}},
         .low = 0.0,
         .high = 0.0,
         .group = "water"},
    };
}

// The cells inside the terrain's outline, and where each stands in it.
struct Cells {
    std::vector<weather::GridCell> cells;
    std::vector<std::size_t> place;
};

Cells cells_of(const Terrain& terrain)
{
    const auto all = weather::make_grid_cells(terrain.heights_m, terrain.width, terrain.height,
                                              terrain.spacing_m);
    Cells inside;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!terrain.inside[i]) continue;
        inside.cells.push_back(all[i]);
        inside.cells.back().surface = terrain.surface[i];
        inside.place.push_back(i);
    }
    return inside;
}

std::vector<double> regional_row(const Landscape& grid, const Cells& inside,
                                 const weather::ForcingTable& table)
{
    const std::int64_t us = grid.time_us();
    const double air_c =
        weather::value_at(table, weather::Field::AirTemp, us) - weather::kZeroCelsiusK;
    const std::size_t count = inside.cells.size();
    std::vector<double> heights(count), depths(count);
    double cover = 0, depth = 0, deepest = 0, swe = 0, albedo = 0, surface = 0, film = 0,
           puddle = 0, ice = 0, runoff = 0, precip = 0, residual = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const weather::CellState c = grid.state(i);
        const auto d = weather::diagnostics(c);
        heights[i] = inside.cells[i].elevation_m;
        depths[i] = d.snow_depth_m;
        cover += std::tanh(d.snow_depth_m / 0.1);
        depth += d.snow_depth_m;
        deepest = std::max(deepest, d.snow_depth_m);
        swe += d.swe_kg_m2;
        albedo += c.snow_albedo;
        surface += c.surface_temp_c;
        film += c.film;
        puddle += c.puddle;
        ice += d.surface_ice_kg_m2;
        runoff += c.total_drainage;
        precip += c.total_precip;
        residual = std::max(residual, std::abs(c.mass_residual_most));
    }
    const double n = static_cast<double>(count);
    const double station_m = table.site.elevation_m;
    return {static_cast<double>(us - table.time_us.front()) * 1e-6,
            air_c,
            cover / n,
            snow_line_m(heights, depths),
            station_m + (air_c - 1.0) / weather::kLapseRate_k_m,
            depth / n,
            deepest,
            swe / n,
            albedo / n,
            surface / n,
            film / n,
            puddle / n,
            ice / n,
            runoff / n,
            precip / n,
            residual};
}

GridMap map_of(const Landscape& grid, const Cells& inside, std::size_t cells)
{
    GridMap map{grid.time_us(), std::vector<weather::CellState>(cells)};
    for (std::size_t i = 0; i < inside.place.size(); ++i)
        map.states[inside.place[i]] = grid.state(i);
    return map;
}

std::size_t step_at(std::int64_t us, const Landscape& grid, std::int64_t begin_us,
                    std::int64_t end_us, std::int64_t step_us)
{
    if (us < begin_us || us > end_us) {
        throw Error("grid: there is no weather at " + weather::iso_from_us(us),
                    "Give times from " + weather::iso_from_us(begin_us) + " to " +
                        weather::iso_from_us(end_us) + ".");
    }
    return std::min(grid.steps(),
                    static_cast<std::size_t>((us - begin_us + step_us / 2) / step_us));
}

// When a run does what, in steps.
struct Plan {
    std::size_t first = 0, last = 0;  // rows
    std::size_t row_every = 1;
    std::vector<std::size_t> map_steps;
};

Plan plan_of(const weather::ForcingTable& table, const GridRun& run, const Landscape& grid)
{
    const auto step_us = static_cast<std::int64_t>(std::llround(run.model.step_s * 1e6));
    const double steps_a_row = run.model.every_s / run.model.step_s;
    if (steps_a_row < 1.0 || std::abs(steps_a_row - std::round(steps_a_row)) > 1e-9) {
        throw Error("grid: --every must be a whole number of steps of " +
                        std::to_string(run.model.step_s) + " s",
                    "Give --every as a multiple of --dt.");
    }
    const std::int64_t origin = table.time_us.front();
    const std::int64_t end_us = grid.time_us() + static_cast<std::int64_t>(grid.steps()) * step_us;
    const auto step_of = [&](double seconds) {
        const auto us = origin + static_cast<std::int64_t>(std::llround(seconds * 1e6));
        return step_at(std::clamp(us, origin, end_us), grid, origin, end_us, step_us);
    };
    Plan plan;
    plan.row_every = static_cast<std::size_t>(std::llround(steps_a_row));
    plan.first = step_of(run.model.from_s.value_or(0.0));
    plan.last = run.model.to_s ? step_of(*run.model.to_s) : grid.steps();
    for (const std::int64_t us : run.map_times_us) {
        plan.map_steps.push_back(step_at(us, grid, origin, end_us, step_us));
        plan.last = std::max(plan.last, plan.map_steps.back());
    }
    return plan;
}

// Moves the grid to its checkpoint; the table gets the rows before it. The checkpoint's own row,
// and one that only ended the run before, come again if they are due.
void resume(SimulationTable& table, weather::PhysicalGrid& grid,
            const weather::RunIdentity& identity, const GridRun& run, const Plan& plan)
{
    const GridProgress before =
        load_progress(grid, identity, run.model.every_s, table.columns.size(), run.model.resume);
    if (grid.step() > plan.last) {
        throw Error("grid: the checkpoint is of " + weather::iso_from_us(grid.time_us()) +
                        ", after the last row that is asked for",
                    "Give a later --to, or an earlier checkpoint.");
    }
    const double now_s = static_cast<double>(grid.time_us() - table.utc_start_us) * 1e-6;
    const double first_s = static_cast<double>(plan.first) * run.model.step_s;
    for (const auto& row : before.rows) {
        const bool due = std::fmod(row.front(), run.model.every_s) == 0.0;
        if (due && row.front() < now_s && row.front() >= first_s) table.rows.push_back(row);
    }
    table.notes.push_back("resumed at " + weather::iso_from_us(grid.time_us()) + " with " +
                          std::to_string(table.rows.size()) + " rows before");
}

SimulationTable headed_table(const weather::ReadResult& read, const std::string& name,
                             const Terrain& terrain, std::size_t cells)
{
    SimulationTable table;
    table.title = name;
    table.model = "physical";
    table.mode = "grid of " + std::to_string(cells) + " cells";
    table.utc = table.dated = true;
    table.utc_start_us = read.table.time_us.front();
    table.typical_year = read.report.typical_year;
    add_read_report(table, read);
    table.notes.push_back(terrain.note);
    table.columns.assign(std::begin(kColumns), std::end(kColumns));
    table.panels = panels();
    return table;
}

}  // namespace

double snow_line_m(const std::vector<double>& heights_m, const std::vector<double>& depths_m,
                   double least_m)
{
    std::vector<std::size_t> order(heights_m.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return heights_m[a] < heights_m[b] || (heights_m[a] == heights_m[b] && a < b);
    });
    // Wrong when the line lies below the cell at k: snow among those before, bare ground from it
    // on.
    const auto white = [&](std::size_t i) { return depths_m[i] > least_m; };
    auto wrong = static_cast<std::ptrdiff_t>(
        std::count_if(order.begin(), order.end(), [&](std::size_t i) { return !white(i); }));
    std::ptrdiff_t least_wrong = wrong;
    double line = heights_m[order.front()];
    for (std::size_t k = 0; k < order.size(); ++k) {
        wrong += white(order[k]) ? 1 : -1;
        if (wrong >= least_wrong) continue;
        least_wrong = wrong;
        line = heights_m[k + 1 < order.size() ? order[k + 1] : order[k]];
    }
    return line;
}

SimulationTable run_grid(const weather::ReadResult& read, const std::string& name,
                         const Terrain& terrain, const GridRun& run)
{
    if (std::isnan(read.table.site.elevation_m)) {
        throw Error("grid: the weather file does not say how high its station lies",
                    "Give --elevation-m.");
    }
    weather::GridParams params;
    params.model = physical_params(run.model);
    for (const std::string& surface : terrain.surfaces)
        params.surfaces.push_back(weather::surface_preset(surface));
    params.threads = run.model.threads;
    const Cells inside = cells_of(terrain);
    Landscape grid(read.table, run.field, params, inside.cells, inside.place, terrain);
    const bool keeps = run.on_checkpoint || !run.model.resume.empty();
    if (keeps && !grid.only())
        throw Error("grid: a checkpoint under several weathers",
                    "Leave --weather-parts, or --checkpoint and --resume, out.");
    SimulationTable table = headed_table(read, name, terrain, inside.cells.size());
    table.utc_offset_s = run.model.clock_offset_s;
    if (run.field.side > 1)
        table.notes.push_back("weather of " + std::to_string(run.field.tables.size()) +
                              " parts of the terrain; air temperature is that of its middle");
    const Plan plan = plan_of(read.table, run, grid);
    const auto identity = weather::grid_identity(read.table, params, inside.cells);
    if (!run.model.resume.empty()) resume(table, *grid.only(), identity, run, plan);

    std::size_t next_map = 0;
    while (next_map < plan.map_steps.size() && plan.map_steps[next_map] < grid.step()) ++next_map;
    if (next_map > 0)
        table.notes.emplace_back("maps of times before the checkpoint are not written again");
    for (;;) {
        const std::size_t now = grid.step();
        if (now >= plan.first && (now % plan.row_every == 0 || now == plan.last))
            table.rows.push_back(regional_row(grid, inside, read.table));
        for (; next_map < plan.map_steps.size() && plan.map_steps[next_map] <= now; ++next_map)
            run.on_map(map_of(grid, inside, terrain.cells()));
        const bool done = now >= plan.last, stopped = !done && run.stop && run.stop();
        if ((done || stopped) && run.on_checkpoint)
            run.on_checkpoint(
                save_progress(*grid.only(), identity, {run.model.every_s, table.rows}));
        if (done) break;
        if (stopped) {
            throw Interrupted("interrupted: grid at " + weather::iso_from_us(grid.time_us()) +
                              ", " + std::to_string(now) + " of " + std::to_string(plan.last) +
                              " steps");
        }
        std::size_t to = std::min(plan.last, (now / plan.row_every + 1) * plan.row_every);
        if (next_map < plan.map_steps.size()) to = std::min(to, plan.map_steps[next_map]);
        grid.advance(to - now);
        if (run.on_progress) run.on_progress(grid.step(), plan.last);
    }
    table.state_hash = grid.hash();
    table.table_hash = table.state_hash;
    char books[120];
    std::snprintf(books, sizeof books,
                  "mass closes within %.1e kg/m2 a step in every cell; %.1f MiB of states",
                  table.rows.back().back(), static_cast<double>(grid.bytes()) / 1048576.0);
    table.notes.emplace_back(books);
    return table;
}

}  // namespace petrichor::cli
