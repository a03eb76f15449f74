#include <algorithm>
#include <iostream>

#include "base/error.h"
#include "base/output_file.h"
#include "cli/exit.h"
#include "cli/progress.h"
#include "cli/signals.h"
#include "cli/simulate/grid.h"
#include "cli/simulate/grid_map.h"
#include "cli/simulate/simulations.h"
#include "film/weather/times.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;

void refuse_what_is_for_one_cell(const SimulateOptions& options)
{
    for (const auto& [given, name] : {std::pair{!options.observed.empty(), "--observed"},
                                      {options.physical.members > 0, "--ensemble"},
                                      {options.physical.sensitivity, "--sensitivity"},
                                      {!options.height_map.empty(), "--height-map"},
                                      {!options.horizon.empty(), "--horizon"},
                                      {!options.events.empty(), "--events"},
                                      {!options.road.empty(), "--road"},
                                      {!options.initial.empty(), "--initial"}}) {
        if (given)
            throw Error(std::string("grid: ") + name + " cannot be used with --grid",
                        "Leave it out, or run one cell without --grid.");
    }
}

// Times of maps; with none given, the end.
std::vector<std::int64_t> map_times_us(const SimulateOptions& options, const PhysicalInput& input)
{
    const std::int64_t start_us = input.read.table.time_us.front();
    const auto at = [&](double seconds) {
        return start_us + static_cast<std::int64_t>(seconds * 1e6);
    };
    std::vector<std::int64_t> times;
    for (const std::string& text : options.map_times)
        times.push_back(at(parse_time(text, "--at", start_us, input.run.clock_offset_s)));
    if (!options.maps.empty() && times.empty()) {
        times.push_back(at(input.run.to_s.value_or(
            static_cast<double>(input.read.table.time_us.back() - start_us) * 1e-6)));
    }
    std::sort(times.begin(), times.end());
    return times;
}

}  // namespace

SimulationTable simulate_grid(const std::vector<Input>& inputs, const SimulateOptions& options)
{
    refuse_what_is_for_one_cell(options);
    PhysicalInput input = physical_input(inputs, options);
    if (options.every.empty()) input.run.every_s = 86400.0;
    const Terrain terrain = read_terrain(options.terrain, input.run.site.surface);
    GridRun run;
    run.model = input.run;
    if (options.weather_parts > 0) {
        run.field = read_weather_field(options.inputs, input.run.site, terrain,
                                       static_cast<std::size_t>(options.weather_parts),
                                       options.grid_point == "nearest");
    }
    run.map_times_us = map_times_us(options, input);
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
    if (!options.checkpoint.empty()) {
        run.on_checkpoint = [&](const std::string& bytes) {
            write_text_file(options.checkpoint, bytes);
        };
    }
    run.stop = interrupted;
    try {
        return run_grid(input.read, title_of(inputs), terrain, run);
    } catch (const Interrupted& stop) {
        throw Interrupted(
            stop.what() +
            (options.checkpoint.empty()
                 ? std::string("\n  No table was written. Give --checkpoint FILE to be able to go "
                               "on from there.")
                 : "\n  Go on with the same command and --resume " + options.checkpoint + "."));
    }
}

}  // namespace petrichor::cli
