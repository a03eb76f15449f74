// petrichor simulate: weather over time, from keys or a preset to a table, a plot or a report.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/output_file.h"
#include "cli/commands.h"
#include "cli/folders.h"
#include "cli/simulate/artist.h"
#include "cli/simulate/physical.h"
#include "cli/simulate/plot.h"
#include "cli/simulate/report.h"
#include "cli/words.h"
#include "texproc/files/io.h"
#include "weather/artist/csv.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;

struct SimulateOptions {
    std::vector<std::string> inputs;
    std::string model = "artist";
    std::string mode = "exact";
    std::string step = "1/60";
    std::string every;
    std::string interpolation;
    std::string params;
    std::optional<double> from_s;
    std::optional<double> to_s;
    std::vector<std::string> outputs;
    std::string checkpoint;
    std::string resume;
    bool json = false;
    bool hash = false;
    bool list = false;
    PhysicalRun physical;
};

constexpr std::uintmax_t kMostBytes = 256u << 20;

// The whole file, or of a binary one only the head, so that its reader refuses it without delay.
std::string read_file(const fs::path& path)
{
    std::error_code failed;
    const std::uintmax_t size = fs::file_size(path, failed);
    std::ifstream in(path, std::ios::binary);
    if (!in || fs::is_directory(path)) {
        throw Error("simulate: cannot read " + path.string(),
                    "Give a file that exists, or the name of a preset (simulate --list).");
    }
    std::string head(4096, ' ');
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(in.gcount()));
    if (head.find('\0') != head.npos) return head;
    if (!failed && size > kMostBytes) {
        throw Error("simulate: " + path.string() + " has " + std::to_string(size) +
                        " bytes, at most 268435456 are read",
                    "Give a smaller file.");
    }
    std::ostringstream rest;
    if (in) rest << in.rdbuf();
    return head + rest.str();
}

// An input is a preset by name, a TOML weather file, or CSV keys ("-": from standard input).
WeatherScript read_script(const SimulateOptions& options, std::vector<std::string>& notes)
{
    const std::string& input = options.inputs.front();
    const std::vector<std::string> presets = preset_names("weather");
    fs::path path = input;
    const bool is_preset = !fs::exists(path) &&
                           std::find(presets.begin(), presets.end(), input) != presets.end();
    if (is_preset) path = data_folder() / "weather" / (input + ".toml");
    if (input != "-" && !fs::exists(path)) {
        throw Error("simulate: no file and no preset \"" + input + "\"." +
                        did_you_mean(input, presets),
                    presets.empty() ? "Give a CSV of keys or a weather TOML."
                                    : "Give a CSV of keys, a weather TOML, or one of: " +
                                          join_words(presets) + ".");
    }
    const std::string text = input == "-"
                                 ? std::string(std::istreambuf_iterator<char>(std::cin), {})
                                 : read_file(path);
    WeatherScript script;
    if (path.extension() == ".toml") {
        script = read_weather_script(text, path.string());
        if (!options.interpolation.empty()) {
            throw Error("simulate: --interp is for CSV keys; " + path.string() +
                            " has its own interpolation",
                        "Leave --interp out, or change interpolation in the file.");
        }
    } else {
        const std::string word = options.interpolation.empty() ? "hold" : options.interpolation;
        auto reading = weather::parse_timeline_csv(text, *weather::interpolation_named(word));
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
    }
    if (script.name.empty()) script.name = input == "-" ? "keys" : path.stem().string();
    if (!options.params.empty()) {
        const ArtistSettings settings =
            read_artist_settings(read_file(options.params), options.params);
        script.params = settings.params;
        script.initial = settings.initial;
    }
    return script;
}

SimulationTable simulate_artist(const SimulateOptions& options)
{
    if (options.inputs.size() != 1) {
        throw Error("simulate: the artist model takes one input, got " +
                        std::to_string(options.inputs.size()),
                    "Give one CSV of keys, one weather TOML or one preset.");
    }
    for (double time_s : {options.from_s.value_or(0.0), options.to_s.value_or(0.0)}) {
        if (!(time_s >= 0.0 && time_s <= 9e9)) {
            throw Error("simulate: --from and --to take seconds from 0 up, got " +
                            number_text(time_s),
                        "Give times from the start of the run.");
        }
    }
    std::vector<std::string> notes;
    const WeatherScript script = read_script(options, notes);
    ArtistRun run;
    run.stepped = options.mode == "stepped";
    run.step_s = parse_fraction(options.step, "--dt");
    run.every_s = parse_fraction(options.every.empty() ? "1" : options.every, "--every");
    if (options.every.empty() && run.stepped && run.step_s.value() > 1.0) run.every_s = run.step_s;
    run.from_s = options.from_s.value_or(0.0);
    run.to_s = options.to_s;
    std::string checkpoint;
    if (!options.checkpoint.empty()) run.checkpoint = &checkpoint;
    if (!options.resume.empty()) run.resume = read_file(options.resume);
    SimulationTable table = run_artist(script, run);
    table.notes.insert(table.notes.end(), notes.begin(), notes.end());
    if (!options.checkpoint.empty()) write_text_file(options.checkpoint, checkpoint);
    return table;
}

// The physical model's share of the options.
PhysicalRun physical_run(const SimulateOptions& options)
{
    PhysicalRun run = options.physical;
    run.from_s = options.from_s;
    run.to_s = options.to_s;
    if (options.step != "1/60") run.step_s = parse_fraction(options.step, "--dt").value();
    run.every_s = options.every.empty() ? run.step_s : parse_fraction(options.every, "--every").value();
    if (!options.params.empty()) run.fetch_params = read_file(options.params);
    if (!options.resume.empty()) run.resume = read_file(options.resume);
    return run;
}

std::string weather_text(const SimulateOptions& options)
{
    if (options.inputs.size() != 1) {
        throw Error("simulate: the physical model takes one weather file, got " + std::to_string(options.inputs.size()),
                    "Give one EPW, TMY3, METAR, CSV or other weather file.");
    }
    const std::string& input = options.inputs.front();
    return input == "-" ? std::string(std::istreambuf_iterator<char>(std::cin), {}) : read_file(input);
}

SimulationTable simulate_physical(const SimulateOptions& options)
{
    PhysicalRun run = physical_run(options);
    std::string checkpoint;
    if (!options.checkpoint.empty()) run.checkpoint = &checkpoint;
    const fs::path path = options.inputs.empty() ? "" : options.inputs.front();
    SimulationTable table = run_physical(weather_text(options), path == "-" ? "weather" : path.stem().string(), run);
    if (!options.checkpoint.empty()) write_text_file(options.checkpoint, checkpoint);
    return table;
}

// One line a model: a new model fills a SimulationTable and has every output.
SimulationTable simulate(const SimulateOptions& options)
{
    if (options.model == "artist") return simulate_artist(options);
    if (options.model == "physical") return simulate_physical(options);
    throw Error("simulate: no model \"" + options.model + "\"", "Use --model artist or physical.");
}

void write(const SimulationTable& table, const SimulateOptions& options, const fs::path& path)
{
    if (path == "-") {
        std::cout << csv_text(table, options.hash);
        return;
    }
    const std::string kind = weather::lower_case(path.extension().string());
    if (kind == ".csv") {
        write_text_file(path, csv_text(table, options.hash));
    } else if (kind == ".json") {
        write_text_file(path, json_text(table));
    } else if (kind == ".svg") {
        write_text_file(path, svg_plot(table));
    } else if (kind == ".png") {
        const Pixels pixels = to_pixels(plot_of(table), 2.0);
        texproc::write_png8(path, pixels.width, pixels.height, 3, pixels.rgb);
    } else if (kind == ".html") {
        write_text_file(path, html_report(table));
    } else {
        throw Error("simulate: cannot write " + path.string() + ": unknown kind \"" + kind + "\"",
                    "Use .csv, .json, .svg, .png or .html, or - for CSV on standard output.");
    }
    if (!options.json) std::cerr << "info simulate: wrote " << path.string() << '\n';
}

void run(const SimulateOptions& options)
{
    if (options.list) {
        for (const std::string& name : preset_names("weather")) std::cout << name << '\n';
        return;
    }
    if (options.inputs.empty()) {
        throw Error("simulate: no input", "Give a CSV of keys, a weather TOML, or a preset (--list).");
    }
    if (options.physical.fit_artist) {
        const std::string toml = fitted_artist_toml(weather_text(options), physical_run(options));
        if (options.outputs.empty() || options.outputs.front() == "-") std::cout << toml;
        else write_text_file(options.outputs.front(), toml);
        return;
    }
    const SimulationTable table = simulate(options);
    for (const std::string& note : table.notes) std::cerr << "info simulate: " << note << '\n';
    std::vector<std::string> outputs = options.outputs;
    if (outputs.empty() && !options.json) outputs.push_back("-");
    for (const std::string& output : outputs) write(table, options, output);
    if (options.json) std::cout << json_summary(table);
}

}  // namespace

void add_simulate(CLI::App& app)
{
    auto options = std::make_shared<SimulateOptions>();
    CLI::App* command = app.add_subcommand("simulate", "Weather over time: tables, plots, reports.");
    command->add_option("INPUT", options->inputs,
                        "CSV of keys (time_s,temperature_c,rainfall and any parameter; - reads standard "
                        "input), a weather TOML, or the name of a preset");
    command->add_option("--model", options->model, "artist: 0..1, by keys; physical: SI, by a weather file")
        ->check(CLI::IsMember({"artist", "physical"}))
        ->capture_default_str();
    command->add_option("--mode", options->mode, "exact: closed form; stepped: as the original, by --dt")
        ->check(CLI::IsMember({"exact", "stepped"}))
        ->capture_default_str();
    command->add_option("--dt", options->step, "step in seconds, decimal or a fraction like 1/60")
        ->capture_default_str();
    command->add_option("--from", options->from_s, "first time to write, seconds");
    command->add_option("--to", options->to_s, "last time to write, seconds (default: the last key)");
    command->add_option("--every", options->every, "rows at whole multiples of this, seconds (default 1)");
    command->add_option("--interp", options->interpolation, "between the keys of a CSV (default hold)")
        ->check(CLI::IsMember({"hold", "linear", "smooth"}));
    command->add_option("--params", options->params, "TOML with [artist] and [artist.initial]");
    command->add_option("-o,--output", options->outputs,
                        "OUT.csv, .json, .svg, .png or .html; - is CSV on standard output (default)")
        ->allow_extra_args(false);
    command->add_option("--checkpoint", options->checkpoint, "write the state at the end to this file");
    command->add_option("--resume", options->resume, "continue from such a file, with identical bits");
    command->add_flag("--json", options->json, "print a summary as JSON");
    command->add_flag("--hash", options->hash, "end the CSV with a line of state hashes");
    command->add_flag("--list", options->list, "list the presets");
    add_physical_options(*command, options->physical);
    command->footer(
        "Examples:\n"
        "  petrichor simulate rain-then-snow -o report.html     a preset, as an interactive report\n"
        "  petrichor simulate keys.csv --interp linear --every 0.5 -o state.csv\n"
        "  petrichor simulate keys.csv --mode stepped --dt 1/60 --params look.toml -o plot.svg\n"
        "  petrichor simulate denver.epw --model physical --surface asphalt -o street.csv -o street.html\n"
        "  petrichor simulate denver.epw --fit-artist -o rates.toml");
    command->callback([options] { run(*options); });
}

}  // namespace petrichor::cli
