#include <algorithm>
#include <cmath>
#include <thread>

#include "base/error.h"
#include "base/output_file.h"
#include "base/words.h"
#include "cli/report/times.h"
#include "cli/simulate/relief.h"
#include "cli/simulate/simulations.h"

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

namespace {

// A century of hours. A row of the table and its state take some 2 KB.
constexpr double kMostRows = 1e6;
constexpr double kMostSteps = 2e7;

void check_rows(const PhysicalRun& run, double last_s)
{
    const double span_s = run.to_s.value_or(last_s) - run.from_s.value_or(0.0);
    const double rows = span_s / run.every_s, steps = span_s / run.step_s;
    if (rows <= kMostRows && steps <= kMostSteps) return;
    throw Error("simulate: " + petrichor::number_text(std::round(span_s / 864.0 / 365.25) / 100.0) +
                    " years are " + petrichor::number_text(std::round(rows)) + " rows and " +
                    petrichor::number_text(std::round(steps)) + " steps, at most " +
                    petrichor::number_text(kMostRows) + " and " +
                    petrichor::number_text(kMostSteps) + " are computed",
                "Name a part with --from and --to, or longer steps with --every and --dt.");
}

}  // namespace

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
    check_rows(run, static_cast<double>(input.read.table.time_us.back() - start_us) * 1e-6);
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
