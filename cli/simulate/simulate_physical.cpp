#include <algorithm>
#include <thread>

#include "base/error.h"
#include "base/output_file.h"
#include "cli/simulate/relief.h"
#include "cli/simulate/simulations.h"
#include "film/weather/times.h"

namespace petrichor::cli {

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

std::string title_of(const std::vector<Input>& inputs)
{
    return inputs.size() == 1
               ? inputs.front().name
               : inputs.front().name + " and " + std::to_string(inputs.size() - 1) + " more";
}

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
    if (!options.resume.empty()) run.resume = read_checkpoint_file(options.resume);
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

std::string fitted_toml(const std::vector<Input>& inputs, const SimulateOptions& options)
{
    const PhysicalInput input = physical_input(inputs, options);
    return fitted_artist_toml(input.read, input.run);
}

}  // namespace petrichor::cli
