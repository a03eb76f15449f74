// petrichor simulate: weather over time, from keys, a preset or weather files to tables, plots,
// reports and maps.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/output_file.h"
#include "cli/commands.h"
#include "cli/folders.h"
#include "cli/progress.h"
#include "cli/simulate/artist.h"
#include "cli/simulate/grid.h"
#include "cli/simulate/grid_map.h"
#include "cli/simulate/inputs.h"
#include "cli/simulate/outputs.h"
#include "cli/simulate/physical.h"
#include "cli/simulate/plot.h"
#include "cli/simulate/relief.h"
#include "cli/simulate/weather_input.h"
#include "weather/artist/csv.h"
#include "weather/artist/from_forcing.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;

struct SimulateOptions {
    std::vector<std::string> inputs;
    std::string model = "auto";
    std::string mode = "exact";
    std::string step, every;
    std::string interpolation;
    std::string params;
    std::string from, to;
    std::vector<std::string> outputs;
    std::string plot = "auto";
    std::string observed;
    std::string checkpoint;
    std::string resume;
    bool json = false;
    bool hash = false;
    bool list = false;
    bool fit_artist = false;
    std::string height_map;
    double height_range_m = 0.02;
    TerrainOptions terrain;
    std::vector<std::string> maps, map_times;
    PhysicalRun physical;
};

std::string params_text(const SimulateOptions& options)
{
    return options.params.empty() ? "" : read_input_file(options.params);
}

std::optional<double> time_of(const std::string& text, const char* option,
                              std::optional<std::int64_t> start_us)
{
    if (text.empty()) return std::nullopt;
    return parse_time(text, option, start_us);
}

// ---- artist ----

WeatherScript script_of_keys(const Input& input, const std::string& interpolation,
                             std::vector<std::string>& notes)
{
    WeatherScript script;
    const std::string word = interpolation.empty() ? "hold" : interpolation;
    auto reading = weather::parse_timeline_csv(input.text, *weather::interpolation_named(word));
    script.timeline = std::move(reading.timeline);
    script.duration_s = weather::to_seconds(script.timeline.end());
    notes.push_back("read " + std::to_string(script.timeline.temperature_c.times.size()) +
                    " keys of temperature, " +
                    std::to_string(script.timeline.rainfall.times.size()) +
                    " of rainfall, interpolation " + word);
    if (!reading.bridged.empty()) {
        notes.push_back("left out " + std::to_string(reading.bridged.size()) +
                        " bad rows: " + weather::list_problems(reading.bridged));
    }
    return script;
}

// What drives the artist model, and where it came from when that was a weather file.
struct ArtistInput {
    WeatherScript script;
    std::optional<weather::ReadResult> read;
    std::vector<std::string> notes;
};

ArtistInput artist_input(const std::vector<Input>& inputs, const SimulateOptions& options)
{
    const Input& first = inputs.front();
    ArtistInput result;
    if (first.kind != InputKind::Keys && !options.interpolation.empty()) {
        throw Error(
            "simulate: --interp is for CSV keys; " + first.file + " has its own interpolation",
            "Leave --interp out, or change interpolation in the file.");
    }
    if (first.kind == InputKind::Script) {
        result.script = read_weather_script(first.text, first.file);
    } else if (first.kind == InputKind::Keys) {
        result.script = script_of_keys(first, options.interpolation, result.notes);
    } else {
        result.read =
            read_forcing(inputs, with_site_table(options.physical.site, params_text(options)));
        result.script = script_of_forcing(result.read->table, first.name);
        result.notes.emplace_back(
            "an hour of weather is a second of the artist model (time_scale 1/3600); --params "
            "changes that");
    }
    if (result.script.name.empty()) result.script.name = first.name;
    if (!options.params.empty()) {
        const double scale = result.script.params.time_scale;
        const ArtistSettings settings =
            read_artist_settings(params_text(options), options.params, result.read ? scale : 1.0);
        result.script.params = settings.params;
        result.script.initial = settings.initial;
    }
    return result;
}

SimulationTable simulate_artist(const std::vector<Input>& inputs, const SimulateOptions& options)
{
    const ArtistInput input = artist_input(inputs, options);
    std::optional<std::int64_t> start_us;
    if (input.read) start_us = input.read->table.time_us.front();
    ArtistRun run;
    run.stepped = options.mode == "stepped";
    if (!options.step.empty()) run.step_s = parse_duration(options.step, "--dt");
    run.every_s = options.every.empty() ? Fraction{input.read ? 3600 : 1, 1}
                                        : parse_duration(options.every, "--every");
    if (options.every.empty() && run.stepped && run.step_s.value() > run.every_s.value())
        run.every_s = run.step_s;
    run.from_s = time_of(options.from, "--from", start_us).value_or(0.0);
    run.to_s = time_of(options.to, "--to", start_us);
    std::string checkpoint;
    if (!options.checkpoint.empty()) run.checkpoint = &checkpoint;
    if (!options.resume.empty()) run.resume = read_input_file(options.resume);
    SimulationTable table = run_artist(input.script, run);
    if (input.read) {
        add_read_report(table, *input.read);
        table.dated = true;
        table.utc_start_us = *start_us;
    }
    table.notes.insert(table.notes.end(), input.notes.begin(), input.notes.end());
    if (!options.checkpoint.empty()) write_text_file(options.checkpoint, checkpoint);
    return table;
}

// ---- physical ----

std::string title_of(const std::vector<Input>& inputs)
{
    return inputs.size() == 1
               ? inputs.front().name
               : inputs.front().name + " and " + std::to_string(inputs.size() - 1) + " more";
}

// The weather and the physical model's share of the options.
struct PhysicalInput {
    weather::ReadResult read;
    PhysicalRun run;
    std::vector<std::string> notes;
};

PhysicalInput physical_input(const std::vector<Input>& inputs, const SimulateOptions& options)
{
    if (inputs.front().kind != InputKind::Weather) {
        throw Error(
            "simulate: " + inputs.front().file + " holds keys of the artist model, not weather",
            "Give the physical model an EPW, TMY3, METAR, CSV or other weather file.");
    }
    PhysicalInput input;
    PhysicalRun& run = input.run;
    run = options.physical;
    run.site = with_site_table(run.site, params_text(options));
    input.read = read_forcing(inputs, run.site);
    const std::int64_t start_us = input.read.table.time_us.front();
    run.from_s = time_of(options.from, "--from", start_us);
    run.to_s = time_of(options.to, "--to", start_us);
    if (!options.step.empty()) run.step_s = parse_duration(options.step, "--dt").value();
    run.every_s =
        options.every.empty() ? run.step_s : parse_duration(options.every, "--every").value();
    if (run.threads == 0)
        run.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    if (!options.resume.empty()) run.resume = read_input_file(options.resume);
    if (!options.observed.empty()) {
        run.observed = read_input_file(options.observed);
        run.observed_file = options.observed;
        if (run.observed.empty())
            throw Error("observations: " + options.observed + " is empty",
                        "Give a file with observations.");
    }
    if (!options.height_map.empty()) {
        const Relief relief = read_relief(options.height_map, options.height_range_m);
        run.cracks = relief.cracks;
        run.puddles = relief.puddles;
        input.notes.push_back(relief.note);
    }
    return input;
}

SimulationTable simulate_physical(const std::vector<Input>& inputs, const SimulateOptions& options)
{
    PhysicalInput input = physical_input(inputs, options);
    std::string checkpoint;
    if (!options.checkpoint.empty()) input.run.checkpoint = &checkpoint;
    SimulationTable table = run_physical(input.read, title_of(inputs), input.run);
    table.notes.insert(table.notes.end(), input.notes.begin(), input.notes.end());
    if (!options.checkpoint.empty()) write_text_file(options.checkpoint, checkpoint);
    return table;
}

SimulationTable simulate_grid(const std::vector<Input>& inputs, const SimulateOptions& options)
{
    for (const auto& [given, name] :
         {std::pair{!options.checkpoint.empty() || !options.resume.empty(),
                    "--checkpoint and --resume"},
          {!options.observed.empty(), "--observed"},
          {options.physical.members > 0, "--ensemble"},
          {!options.height_map.empty(), "--height-map"}}) {
        if (given)
            throw Error(std::string("grid: ") + name + " cannot be used with --grid",
                        "Leave it out, or run one cell without --grid.");
    }
    PhysicalInput input = physical_input(inputs, options);
    if (options.every.empty()) input.run.every_s = 86400.0;
    const Terrain terrain = read_terrain(options.terrain, input.run.site.surface);
    GridRun run;
    run.model = input.run;
    const std::int64_t start_us = input.read.table.time_us.front();
    for (const std::string& text : options.map_times) {
        run.map_times_us.push_back(
            start_us + static_cast<std::int64_t>(parse_time(text, "--at", start_us) * 1e6));
    }
    if (!options.maps.empty() && run.map_times_us.empty()) {
        const double end_s = run.model.to_s.value_or(
            static_cast<double>(input.read.table.time_us.back() - start_us) * 1e-6);
        run.map_times_us.push_back(start_us + static_cast<std::int64_t>(end_s * 1e6));
    }
    std::sort(run.map_times_us.begin(), run.map_times_us.end());
    run.on_map = [&](const GridMap& map) {
        for (const std::string& path : options.maps) {
            const fs::path file = map_path(path, map.time_us, run.map_times_us.size() > 1);
            write_grid_map(file, terrain, map, run.model);
            std::cerr << "info simulate: wrote " << file.string() << '\n';
        }
    };
    Progress progress("grid", 1000);
    run.on_progress = [&](std::size_t done, std::size_t of) {
        progress.update(static_cast<int>(done * 1000 / of));
    };
    return run_grid(input.read, title_of(inputs), terrain, run);
}

// ---- the command ----

// One line a model: a new model fills a SimulationTable and has every output.
SimulationTable simulate(const std::vector<Input>& inputs, const SimulateOptions& options)
{
    const bool weather_file = inputs.front().kind == InputKind::Weather;
    if (!options.terrain.file.empty()) return simulate_grid(inputs, options);
    if (options.model == "artist" || (options.model == "auto" && !weather_file)) {
        if (!options.observed.empty() || options.physical.members > 0 ||
            options.physical.sensitivity || !options.height_map.empty()) {
            throw Error(
                "simulate: --observed, --ensemble, --sensitivity and --height-map are for the "
                "physical model",
                "Give a weather file with --model physical, or leave them out.");
        }
        return simulate_artist(inputs, options);
    }
    return simulate_physical(inputs, options);
}

void write_fit(const std::vector<Input>& inputs, const SimulateOptions& options)
{
    const PhysicalInput input = physical_input(inputs, options);
    const std::string toml = fitted_artist_toml(input.read, input.run);
    if (options.outputs.empty() || options.outputs.front() == "-")
        std::cout << toml;
    else
        write_text_file(options.outputs.front(), toml);
}

void run(const SimulateOptions& options)
{
    if (options.list) {
        for (const std::string& name : preset_names("weather")) std::cout << name << '\n';
        return;
    }
    if (options.inputs.empty()) {
        throw Error("simulate: no input",
                    "Give a weather file, a CSV of keys, a weather TOML, or a preset (--list).");
    }
    const std::vector<Input> inputs = read_inputs(options.inputs);
    if (options.fit_artist) return write_fit(inputs, options);
    for (const std::string& output : options.outputs) check_output(output);
    SimulationTable table = simulate(inputs, options);
    table.panels = chosen_panels(table, options.plot);
    for (const std::string& note : table.notes) std::cerr << "info simulate: " << note << '\n';
    for (const std::string& warning : table.warnings)
        std::cerr << "warn simulate: " << warning << '\n';
    std::vector<std::string> outputs = options.outputs;
    if (outputs.empty() && options.maps.empty() && !options.json) outputs.push_back("-");
    for (const std::string& output : outputs) {
        write_table(table, output, options.hash);
        if (!options.json && output != "-") std::cerr << "info simulate: wrote " << output << '\n';
    }
    if (options.json) std::cout << json_summary(table);
}

void add_time_options(CLI::App& command, SimulateOptions& o)
{
    const char* group =
        "Time (seconds, 1/60, 30min, 6h, 1d; with a weather file also dates: 2005-12-01, "
        "2005-12-01T06:00, 12-01)";
    command
        .add_option(
            "--dt", o.step,
            "step: of the stepped artist model (default 1/60), of the physical model (default 1h)")
        ->group(group);
    command.add_option("--from", o.from, "first time to write")->group(group);
    command.add_option("--to", o.to, "last time to write (default: the last key or row)")
        ->group(group);
    command
        .add_option(
            "--every", o.every,
            "rows at whole multiples of this (default 1 s, with a weather file 1h, with --grid 1d)")
        ->group(group);
}

void add_relief_and_grid_options(CLI::App& command, SimulateOptions& o)
{
    const char* relief =
        "Relief of the material (physical model): stores of cracks and puddles from a height map";
    command.add_option("--height-map", o.height_map, "tileable image, white is high")
        ->group(relief);
    command.add_option("--height-range-m", o.height_range_m, "from black to white")
        ->group(relief)
        ->capture_default_str();
    const char* grid = "Landscape (physical model on every cell; -o gets the regional series)";
    command
        .add_option(
            "--grid", o.terrain.file,
            "terrain: ESRI ASCII grid (.asc), float TIFF or EXR in metres, or a height map image")
        ->group(grid);
    command.add_option("--cell-size-m", o.terrain.cell_size_m, "of a texel of the terrain")
        ->group(grid);
    command
        .add_option("--grid-height-m", o.terrain.height_range_m,
                    "LOW:HIGH, metres of black and white")
        ->group(grid);
    command
        .add_option("--grid-size", o.terrain.longest_side,
                    "cells along the longer side; larger terrains are averaged")
        ->group(grid)
        ->capture_default_str();
    command.add_option("--surface-mask", o.terrain.mask, "image of surfaces over the terrain")
        ->group(grid);
    command
        .add_option("--surfaces", o.terrain.surfaces,
                    "names for the mask: grass,rock: black is the first, white the last")
        ->group(grid);
    command
        .add_option(
            "--map", o.maps,
            "write a map: OUT.exr (a layer a state) or OUT.png (to look at); may be repeated")
        ->allow_extra_args(false)
        ->group(grid);
    command
        .add_option("--at", o.map_times, "when to write maps (default: the end); may be repeated")
        ->allow_extra_args(false)
        ->group(grid);
}

}  // namespace

void add_simulate(CLI::App& app)
{
    auto options = std::make_shared<SimulateOptions>();
    SimulateOptions& o = *options;
    CLI::App* command =
        app.add_subcommand("simulate", "Weather over time: tables, plots, reports, maps.");
    command->add_option("INPUT", o.inputs,
                        "weather files of one place, a CSV of keys (time_s,temperature_c,rainfall "
                        "and any parameter; - reads "
                        "standard input), a weather TOML, or the name of a preset");
    command
        ->add_option("--model", o.model,
                     "artist: 0..1; physical: SI; auto: physical for weather files, else artist")
        ->check(CLI::IsMember({"auto", "artist", "physical"}))
        ->capture_default_str();
    command
        ->add_option("--mode", o.mode,
                     "artist model: exact, closed form; stepped, as the original by --dt")
        ->check(CLI::IsMember({"exact", "stepped"}))
        ->capture_default_str();
    command->add_option("--interp", o.interpolation, "between the keys of a CSV (default hold)")
        ->check(CLI::IsMember({"hold", "linear", "smooth"}));
    command->add_option("--params", o.params, "TOML with [artist], [artist.initial] or [site]");
    command
        ->add_option("-o,--output", o.outputs,
                     "OUT.csv, .json, .svg, .png or .html; - is CSV on standard output (default)")
        ->allow_extra_args(false);
    command
        ->add_option("--plot", o.plot,
                     "panels of plots: auto, all, or some of snow,heat,water,masks (physical), "
                     "water,snow (artist)")
        ->capture_default_str();
    command->add_option("--checkpoint", o.checkpoint, "write the state at the end to this file");
    command->add_option("--resume", o.resume, "continue from such a file, with identical bits");
    command->add_flag("--json", o.json,
                      "print a summary as JSON: what was read and filled, scores, ranges, hashes");
    command->add_flag("--hash", o.hash, "end the CSV with a line of state hashes");
    command->add_flag("--list", o.list, "list the presets");
    add_time_options(*command, o);
    add_physical_options(*command, o.physical);
    command
        ->add_option("--observed", o.observed,
                     "observations to plot and score: CSV with date and columns named as in the "
                     "output, or FSM's")
        ->group("Physical model");
    command
        ->add_flag("--fit-artist", o.fit_artist,
                   "write artist parameters fitted to the file as TOML instead (-o P.toml)")
        ->group("Physical model");
    add_relief_and_grid_options(*command, o);
    command->footer(
        "Examples:\n"
        "  petrichor simulate rain-then-snow -o report.html     a preset, as an interactive "
        "report\n"
        "  petrichor simulate keys.csv --interp linear --every 0.5 -o state.csv\n"
        "  petrichor simulate keys.csv --mode stepped --dt 1/60 --params look.toml -o plot.svg\n"
        "  petrichor simulate denver.epw --from 01-01 --to 02-01 --plot masks -o street.png -o "
        "street.csv\n"
        "  petrichor simulate met.txt --latitude 45.3 --longitude 5.77 --elevation-m 1325 "
        "--surface grass \\\n"
        "      --observed obs.txt -o winter.html                  model and observation, with "
        "scores\n"
        "  petrichor simulate denver.epw --model artist -o artist.csv\n"
        "  petrichor simulate denver.epw --fit-artist -o rates.toml\n"
        "  petrichor simulate alps.csv --grid dem.asc --at 2006-02-01 --map snow.exr --map "
        "snow.png -o region.csv");
    command->callback([options] { run(*options); });
}

}  // namespace petrichor::cli
