// petrichor simulate: weather over time, from keys, a preset or weather files to tables, plots,
// reports and maps.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/output_file.h"
#include "cli/commands.h"
#include "cli/report/panel_choice.h"
#include "cli/rooms.h"
#include "cli/simulate/outputs.h"
#include "cli/simulate/physics_keys.h"
#include "cli/simulate/simulations.h"
#include "film/data/folders.h"
#include "film/weather/inputs.h"

namespace petrichor::cli {
namespace {

// One line a model: a new model fills a SimulationTable and has every output.
SimulationTable simulate(const std::vector<Input>& inputs, const SimulateOptions& options)
{
    const bool weather_file = inputs.front().kind == InputKind::Weather;
    if (!options.terrain.file.empty()) return simulate_grid(inputs, options);
    if (options.weather_parts > 0)
        throw Error("simulate: --weather-parts is of a landscape", "Give --grid, or leave it out.");
    if (options.model == "artist" || (options.model == "auto" && !weather_file)) {
        if (!options.observed.empty() || options.physical.members > 0 ||
            options.physical.sensitivity || !options.height_map.empty() ||
            !options.horizon.empty() || !options.events.empty()) {
            throw Error(
                "simulate: --observed, --ensemble, --sensitivity, --height-map, --horizon and "
                "--events are for the physical model",
                "Give a weather file with --model physical, or leave them out.");
        }
        return simulate_artist(inputs, options);
    }
    return simulate_physical(inputs, options);
}

void tell(const SimulationTable& table)
{
    for (const std::string& note : table.notes) std::cerr << "info simulate: " << note << '\n';
    for (const std::string& warning : table.warnings)
        std::cerr << "warn simulate: " << warning << '\n';
}

void write_fit(const std::vector<Input>& inputs, const SimulateOptions& options,
               const std::vector<std::string>& unpacking)
{
    const std::pair<bool, const char*> others[] = {
        {!options.from.empty(), "--from"},
        {!options.to.empty(), "--to"},
        {!options.every.empty(), "--every"},
        {options.physical.utc, "--utc"},
        {!options.observed.empty(), "--observed"},
        {options.plot != "auto", "--plot"},
        {options.json, "--json"},
        {options.hash, "--hash"},
        {options.physical.members > 0, "--ensemble"},
        {options.physical.sensitivity, "--sensitivity"},
        {!options.terrain.file.empty(), "--grid"},
        {!options.maps.empty(), "--map"},
        {!options.initial.empty(), "--initial"},
        {!options.checkpoint.empty(), "--checkpoint"},
        {!options.resume.empty(), "--resume"},
        {!options.params.empty(), "--params"},
        {options.model == "artist", "--model artist"},
        {options.outputs.size() > 1, "more than one -o"}};
    for (const auto& [given, name] : others)
        if (given)
            throw Error(std::string("simulate: ") + name + " is not of --fit-artist",
                        "It fits to the whole file and writes one TOML file: leave it out.");
    SimulationTable said;
    said.notes = unpacking;
    const std::string toml = fitted_toml(inputs, options, said);
    tell(said);
    if (options.outputs.empty() || options.outputs.front() == "-") {
        std::cout << toml;
        return;
    }
    write_text_file(options.outputs.front(), toml);
    std::cerr << "info simulate: wrote " << options.outputs.front() << '\n';
}

void run(const SimulateOptions& options)
{
    if (options.list) {
        for (const std::string& name : preset_names("weather")) std::cout << name << '\n';
        return;
    }
    if (options.list_physics) {
        std::cout << physics_listing(asked_params(options));
        return;
    }
    if (options.inputs.empty()) {
        throw Error("simulate: no input",
                    "Give a weather file, a CSV of keys, a weather TOML, or a preset (--list).");
    }
    std::vector<std::string> unpacking;
    const std::vector<Input> inputs =
        read_inputs(options.inputs,
                    {options.physical.site.latitude_deg, options.physical.site.longitude_deg,
                     options.grid_point == "nearest"},
                    &unpacking);
    if (options.fit_artist) {
        write_fit(inputs, options, unpacking);
        return;
    }
    for (const std::string& output : options.outputs) check_output(output);
    SimulationTable table = simulate(inputs, options);
    table.notes.insert(table.notes.begin(), unpacking.begin(), unpacking.end());
    table.panels = chosen_panels(table, options.plot);
    tell(table);
    std::vector<std::string> outputs = options.outputs;
    if (outputs.empty() && options.maps.empty() && !options.json) outputs.push_back("-");
    for (const std::string& output : outputs) {
        write_table(table, output, options.hash);
        if (!options.json && output != "-") std::cerr << "info simulate: wrote " << output << '\n';
    }
    if (options.json) std::cout << json_summary(table);
}

}  // namespace

void add_simulate(CLI::App& app)
{
    auto options = std::make_shared<SimulateOptions>();
    CLI::App* command =
        app.add_subcommand("simulate", "Weather over time: tables, plots, reports, maps.");
    add_simulate_options(*command, *options);
    command->callback([options] { run(*options); });
}

}  // namespace petrichor::cli
