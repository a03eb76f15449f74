#ifndef PETRICHOR_CLI_SIMULATE_SIMULATIONS_H
#define PETRICHOR_CLI_SIMULATE_SIMULATIONS_H

#include <optional>
#include <string>
#include <vector>

#include "cli/report/table.h"
#include "cli/rooms.h"
#include "cli/simulate/simulate_options.h"
#include "film/weather/inputs.h"

// From the words of the command line to the runs of the models. Each reads what the options name
// (parameters, checkpoints, observations), runs and writes the checkpoint; tables are left to the
// caller. All throw Error for options that do not go together.
namespace petrichor::cli {

SimulationTable simulate_artist(const std::vector<Input>& inputs, const SimulateOptions& options);
SimulationTable simulate_physical(const std::vector<Input>& inputs, const SimulateOptions& options);

/// Writes the maps, too. Ctrl-C stops it: throws Interrupted that says how to go on.
SimulationTable simulate_grid(const std::vector<Input>& inputs, const SimulateOptions& options);

/// TOML of the artist rates that suit a weather file; what was read, and what to be warned of, goes into `said`.
std::string fitted_toml(const std::vector<Input>& inputs, const SimulateOptions& options,
                        SimulationTable& said);

// ---- shared by them ----

/// The weather and the physical model's share of the options.
struct PhysicalInput {
    weather::ReadResult read;
    PhysicalRun run;
    std::vector<std::string> notes;
};
/// The constants that the options ask for, without reading any weather.
weather::PhysicalParams asked_params(const SimulateOptions& options);
PhysicalInput physical_input(const std::vector<Input>& inputs, const SimulateOptions& options);

std::string title_of(const std::vector<Input>& inputs);
/// Text of --params, or "".
std::string params_text(const SimulateOptions& options);
/// Seconds since the start; nothing for an empty text.
std::optional<double> time_of(const std::string& text, const char* option,
                              std::optional<std::int64_t> start_us, double offset_s = 0.0);

}  // namespace petrichor::cli

#endif
