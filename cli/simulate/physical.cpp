#include "cli/simulate/physical.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/simulate/observations.h"
#include "cli/simulate/physical_table.h"
#include "cli/simulate/physics_keys.h"
#include "weather/models/artist/fit.h"
#include "weather/models/physical/ensemble.h"
#include "weather/models/physical/observed_start.h"
#include "weather/models/physical/physical_checkpoint.h"
#include "weather/readers/text.h"

namespace petrichor::cli {
namespace {

weather::PhaseLaw phase_named(const std::string& name)
{
    if (name == "linear") return weather::PhaseLaw::Linear;
    if (name == "humidity") return weather::PhaseLaw::Humidity;
    if (name == "wet-bulb") return weather::PhaseLaw::WetBulb;
    if (name == "threshold") return weather::PhaseLaw::Threshold;
    throw Error("simulate: there is no phase law '" + name + "'",
                "Use linear, humidity, wet-bulb or threshold.");
}

// Times of the rows: whole multiples of `every` from the first row of the file, inside the window
// and the run.
struct Window {
    std::int64_t from_us = 0, to_us = 0, every_us = 0;
};

Window window_of(const PhysicalRun& run, std::int64_t origin_us, std::int64_t begin_us,
                 std::int64_t end_us, double every_s)
{
    const auto time_of = [&](double s) {
        return origin_us + static_cast<std::int64_t>(std::llround(s * 1e6));
    };
    Window w;
    w.every_us = std::max<std::int64_t>(1, std::llround(every_s * 1e6));
    w.from_us = std::max(run.from_s ? time_of(*run.from_s) : begin_us, begin_us);
    w.from_us = origin_us + (w.from_us - origin_us + w.every_us - 1) / w.every_us * w.every_us;
    w.to_us = std::min(run.to_s ? time_of(*run.to_s) : end_us, end_us);
    if (w.to_us < w.from_us) {
        throw Error("simulate: there is nothing between --from and --to",
                    "The weather goes from " + weather::iso_from_us(begin_us) + " to " +
                        weather::iso_from_us(end_us) +
                        "; give times inside, as dates or in seconds from its first row.");
    }
    if ((w.to_us - w.from_us) / w.every_us > 20000000)
        throw Error("simulate: more than 20 million rows", "Use a longer --every.");
    return w;
}

// What was asked for beyond the ends of the weather is not there; the table says so.
void note_ends(SimulationTable& table, const PhysicalRun& run, std::int64_t origin_us,
               std::int64_t begin_us, std::int64_t end_us)
{
    const auto asked_us = [&](double s) {
        return origin_us + static_cast<std::int64_t>(std::llround(s * 1e6));
    };
    if (run.from_s && asked_us(*run.from_s) < begin_us)
        table.notes.push_back("--from is before the weather, which begins at " +
                              weather::iso_from_us(begin_us));
    if (run.to_s && asked_us(*run.to_s) > end_us)
        table.notes.push_back("--to is after the weather, which ends at " +
                              weather::iso_from_us(end_us));
}

SimulationTable headed_table(const weather::ReadResult& read, const std::string& name,
                             const std::string& mode, const PhysicalRun& run)
{
    SimulationTable table;
    table.title = name;
    table.model = "physical";
    table.mode = mode;
    table.utc = table.dated = true;
    table.utc_start_us = read.table.time_us.front();
    table.utc_offset_s = run.clock_offset_s;
    table.typical_year = read.report.typical_year;
    add_read_report(table, read);
    return table;
}

void add_sensitivity(SimulationTable& table, const weather::ReadResult& read,
                     const weather::PhysicalParams& params)
{
    table.notes.emplace_back(
        "sensitivity: change, peak SWE kg/m2, snow days, mean film, mean puddle kg/m2, mean "
        "surface C");
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const auto& s : weather::sensitivity_table(read.table, params)) {
        char line[160];
        std::snprintf(line, sizeof line, "  %-20s %8.1f %7.1f %8.4f %8.4f %7.2f", s.change.c_str(),
                      s.peak_swe_kg_m2, s.snow_days, s.mean_film_kg_m2, s.mean_puddle_kg_m2,
                      s.mean_surface_c);
        table.notes.emplace_back(line);
        rows.push_back({{"change", s.change},
                        {"peak_swe_kg_m2", s.peak_swe_kg_m2},
                        {"snow_days", s.snow_days},
                        {"mean_film_kg_m2", s.mean_film_kg_m2},
                        {"mean_puddle_kg_m2", s.mean_puddle_kg_m2},
                        {"mean_surface_temp_c", s.mean_surface_c}});
    }
    table.json_parts.emplace_back(
        "sensitivity", rows.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

// Median with the band between the 10 % and 90 % percentiles.
PlotPanel percentile_panel(const char* title, const std::string& name, const char* color,
                           const char* group)
{
    return {.title = title,
            .series = {{.column = name + "_p50",
                        .label = "median, 10 to 90 %",
                        .color = color,
                        .band_low = name + "_p10",
                        .band_high = name + "_p90"}},
            .low = 0.0,
            .high = 0.0,
            .group = group};
}

// FNV-1a over the bits of all numbers: percentiles have no state of a cell to hash.
std::uint64_t hash_of_rows(const std::vector<std::vector<double>>& rows)
{
    std::uint64_t hash = 14695981039346656037u;
    for (const auto& row : rows) {
        for (const double number : row) {
            auto bits = std::bit_cast<std::uint64_t>(number);
            for (int i = 0; i < 8; ++i, bits >>= 8) hash = (hash ^ (bits & 0xffu)) * 1099511628211u;
        }
    }
    return hash;
}

SimulationTable run_ensemble_table(const weather::ReadResult& read, const PhysicalRun& run,
                                   const weather::PhysicalParams& params, SimulationTable table)
{
    const double steps = run.every_s / run.step_s;
    if (steps < 1.0 || std::abs(steps - std::round(steps)) > 1e-9) {
        throw Error("ensemble: --every must be a whole number of steps (" +
                        std::to_string(run.step_s) + " s)",
                    "Give --every as a multiple of --dt.");
    }
    weather::EnsembleParams ensemble;
    ensemble.members = run.members;
    ensemble.seed = run.seed;
    ensemble.threads = run.threads;
    const auto rows = weather::run_ensemble(read.table, params, ensemble,
                                            static_cast<std::size_t>(std::llround(steps)));
    const Window window = window_of(run, read.table.time_us.front(), rows.front().time_us,
                                    rows.back().time_us, run.every_s);
    table.columns = {"time_s"};
    for (const char* name :
         {"snow_depth_m", "swe_kg_m2", "film_kg_m2", "puddle_kg_m2", "surface_temp_c"}) {
        for (const char* share : {"p10", "p50", "p90"})
            table.columns.push_back(std::string(name) + "_" + share);
    }
    for (const auto& r : rows) {
        if (r.time_us < window.from_us || r.time_us > window.to_us) continue;
        std::vector<double> row{static_cast<double>(r.time_us - read.table.time_us.front()) * 1e-6};
        for (const double* three :
             {r.depth_m, r.swe_kg_m2, r.film_kg_m2, r.puddle_kg_m2, r.surface_c})
            row.insert(row.end(), three, three + 3);
        table.rows.push_back(std::move(row));
    }
    table.panels = {
        percentile_panel("snow depth, m", "snow_depth_m", "#4a80bd", "snow"),
        percentile_panel("snow water equivalent, kg/m\u00b2", "swe_kg_m2", "#1f5f9e", "snow"),
        percentile_panel("film, kg/m\u00b2", "film_kg_m2", "#0e9f8e", "water"),
        percentile_panel("puddles, kg/m\u00b2", "puddle_kg_m2", "#2456c4", "water"),
        percentile_panel("surface temperature, \u00b0C", "surface_temp_c", "#c8442e", "heat")};
    table.state_hash = table.table_hash = hash_of_rows(table.rows);
    table.notes.push_back(
        "ensemble of " + std::to_string(run.members) + " members, seed " +
        std::to_string(run.seed) +
        ": precipitation 20 %, temperature 1 K, wind 25 %, sky 15 W/m2 (one standard deviation)");
    return table;
}

weather::PhysicalTimeline timeline_of(const weather::ReadResult& read, const PhysicalRun& run,
                                      const weather::PhysicalParams& params)
{
    if (run.resume.empty() && !run.road_observed.surface_c.empty()) {
        const weather::MetroObservation& o = run.road_observed;
        return {read.table, params,
                with_water(weather::observed_start(read.table, params,
                                                   {o.table.time_us, o.surface_c, o.subsurface_c,
                                                    run.road_depth_m}),
                           run.road_water),
                read.table.time_us.front()};
    }
    if (run.resume.empty() && run.initial_surface_c) {
        const std::int64_t at_us = read.table.time_us.front();
        const double ground_c = run.initial_ground_c.value_or(weather::kMissing);
        const weather::RoadTemperatures measured{
            {&at_us, 1}, {&*run.initial_surface_c, 1}, {&ground_c, 1}, run.initial_depth_m};
        return {read.table, params, weather::observed_start(read.table, params, measured), at_us};
    }
    if (run.resume.empty()) return {read.table, params};
    const auto from =
        weather::load_checkpoint(run.resume, weather::cell_identity(read.table, params));
    return {read.table, params, from.state, from.at_us};
}

void fill_rows(SimulationTable& table, const weather::ReadResult& read,
               const weather::PhysicalParams& params, const weather::PhysicalTimeline& timeline,
               const Window& window)
{
    const std::int64_t origin = read.table.time_us.front();
    const auto states = timeline.series(window.from_us, window.to_us, window.every_us);
    const weather::CellState initial = timeline.state_at(timeline.begin_us());
    table.columns = physical_columns();
    table.rows.reserve(states.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
        // A row between two steps belongs to a shorter step.
        const std::int64_t us = window.from_us + static_cast<std::int64_t>(i) * window.every_us;
        const double into = std::fmod(static_cast<double>(us - origin) * 1e-6, params.step_s);
        table.rows.push_back(physical_row(read.table, params.surface, states[i], initial, us,
                                          into > 0.0 ? into : params.step_s));
    }
    table.state_hash = weather::state_hash(states.back());
    table.table_hash = weather::state_hash(states);
}

std::string books_of(const weather::CellState& last)
{
    char books[160];
    std::snprintf(books, sizeof books,
                  "mass closes within %.1e kg/m2 a step, energy within %.4f W/m2 RMS; visibility "
                  "is the 5 %% optical range",
                  std::abs(last.mass_residual_most), weather::energy_residual_rms_w_m2(last));
    return books;
}

}  // namespace

weather::PhysicalParams physical_params(const PhysicalRun& run)
{
    weather::PhysicalParams params;
    params.surface = run.road ? *run.road : weather::surface_preset(run.site.surface);
    if (run.cracks) params.surface.cracks = *run.cracks;
    if (run.puddles) params.surface.puddles = *run.puddles;
    params.phase.law = phase_named(run.phase);
    params.step_s = run.step_s;
    params.sky_view = run.site.sky_view.value_or(params.sky_view);
    params.horizon = run.horizon;
    params.events = run.events;
    params.canopy_vai = run.site.canopy_vai.value_or(params.canopy_vai);
    if (!run.physics.empty()) apply_physics_toml(run.physics, run.physics_file, params);
    for (const std::string& setting : run.settings) apply_physics_setting(setting, params);
    if (!run.layers.empty()) apply_layers(run.layers, params);
    return params;
}

void add_read_report(SimulationTable& table, const weather::ReadResult& read)
{
    // A warning is told once: as a warning.
    const auto is_warning = [](const weather::ReadNote& note) {
        return note.kind == weather::ReadNote::Kind::Warning;
    };
    weather::ReadReport rest = read.report;
    std::erase_if(rest.notes, is_warning);
    const auto lines = lines_of(weather::to_text(rest));
    table.notes.insert(table.notes.end(), lines.begin(), lines.end());
    for (const weather::ReadNote& note : read.report.notes) {
        if (!is_warning(note)) continue;
        const std::string line = note.line ? " (line " + std::to_string(note.line) + ")" : "";
        table.warnings.push_back(note.field + ": " + note.text + line);
    }
    table.json_parts.emplace_back("read", weather::to_json(read.report));
    constexpr double kShownGap_s = 6.0 * 3600.0;
    const std::int64_t origin_us = read.table.time_us.front();
    for (const weather::ReadGap& gap : read.report.gaps) {
        const std::pair<double, double> s{static_cast<double>(gap.from_us - origin_us) * 1e-6,
                                          static_cast<double>(gap.to_us - origin_us) * 1e-6};
        if (s.second - s.first >= kShownGap_s) table.gaps_s.push_back(s);
    }
}

SimulationTable run_physical(const weather::ReadResult& read, const std::string& name,
                             const PhysicalRun& run)
{
    const weather::PhysicalParams params = physical_params(run);
    SimulationTable table = headed_table(read, name, params.surface.name, run);
    if (run.sensitivity) add_sensitivity(table, read, params);
    if (run.members > 0 && run.initial_surface_c)
        throw Error("ensemble: --initial is of one cell", "Leave --ensemble or --initial out.");
    if (run.members > 0) return run_ensemble_table(read, run, params, std::move(table));

    const weather::PhysicalTimeline timeline = timeline_of(read, run, params);
    const std::int64_t origin = read.table.time_us.front(), end_us = timeline.end_us();
    const Window window = window_of(run, origin, timeline.begin_us(), end_us, run.every_s);
    note_ends(table, run, origin, timeline.begin_us(), end_us);
    fill_rows(table, read, params, timeline, window);
    if (run.every_s > 3600.0)
        table.notes.push_back(
            "rows are states at their times, with the rates and fluxes of the hour: what falls or "
            "shines between two of them is in the model and in no row; leave --every out to see "
            "it");
    table.panels = physical_panels();
    if (params.surface.traffic_heat_w_m2 > 0.0 || !params.events.empty())
        for (PlotPanel& panel : road_panels()) table.panels.push_back(std::move(panel));
    add_physical_events(table);
    Observations observed =
        run.observed.empty()
            ? observations_of(read.table)
            : read_observations(run.observed, run.observed_file, physical_columns());
    if (!observed.columns.empty()) {
        SimulationTable fine;
        const bool coarse = run.every_s > 3600.0;
        if (coarse) {
            fine.dated = true;
            fine.utc_start_us = origin;
            fill_rows(fine, read, params, timeline,
                      window_of(run, origin, timeline.begin_us(), end_us, 3600.0));
        }
        compare(coarse ? fine : table, observed, table);
    }
    if (run.checkpoint) {
        const auto step_us = static_cast<std::int64_t>(std::llround(run.step_s * 1e6));
        const std::int64_t at =
            window.to_us == end_us ? end_us : origin + (window.to_us - origin) / step_us * step_us;
        *run.checkpoint = weather::save_checkpoint({at, timeline.state_at(at)},
                                                   weather::cell_identity(read.table, params));
    }
    table.notes.push_back(books_of(timeline.state_at(window.to_us)));
    return table;
}

std::string fitted_artist_toml(const weather::ReadResult& read, const PhysicalRun& run)
{
    const weather::PhysicalParams params = physical_params(run);
    const auto fit = weather::fit_artist(read.table, params);
    std::string out = "# Artist rates fitted to the physical model on " + params.surface.name +
                      "; rates per hour, time in seconds.\n[artist]\n";
    char line[200];
    std::snprintf(line, sizeof line, "time_scale = %.17g\n", fit.params.time_scale);
    out += line;
    const auto put = [&](const char* key, double value, const weather::FittedRate& rate) {
        if (rate.hours == 0)
            std::snprintf(line, sizeof line, "%s = %.9g  # default: nothing in the file tells\n",
                          key, value);
        else
            std::snprintf(line, sizeof line, "%s = %.9g  # residual %.4f RMS a step, %zu steps%s\n",
                          key, value, rate.rms_residual, rate.hours,
                          rate.rms_residual > 0.1
                              ? ": one rate cannot follow, as water waits for what fills first"
                              : "");
        out += line;
    };
    put("accumulation_rate_wetness", fit.params.accumulation_rate_wetness, fit.wetness);
    put("accumulation_rate_cracks", fit.params.accumulation_rate_cracks, fit.cracks);
    put("accumulation_rate_puddles", fit.params.accumulation_rate_puddles, fit.puddles);
    put("accumulation_rate_snow", fit.params.accumulation_rate_snow, fit.snow);
    put("evaporation_rate_wetness", fit.params.evaporation_rate_wetness, fit.dry_wetness);
    put("evaporation_rate_cracks", fit.params.evaporation_rate_cracks, fit.dry_cracks);
    put("evaporation_rate_puddles", fit.params.evaporation_rate_puddles, fit.dry_puddles);
    return out;
}

}  // namespace petrichor::cli
