#ifndef PETRICHOR_CLI_SIMULATE_GRID_H
#define PETRICHOR_CLI_SIMULATE_GRID_H

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cli/simulate/landscape.h"
#include "cli/simulate/physical.h"
#include "cli/simulate/terrain.h"

namespace petrichor::cli {

/// The state of every cell of a terrain at one time.
struct GridMap {
    std::int64_t time_us = 0;
    std::vector<weather::CellState>
        states;  ///< as many as the terrain has cells; those outside are as at the start
};

struct GridRun {
    WeatherField field{};  ///< weather of the parts of the terrain; none: one for all
    PhysicalRun model;  ///< step, rows (every_s, from_s, to_s), threads, surface
    std::vector<std::int64_t> map_times_us;  ///< when on_map is called, ascending
    std::function<void(const GridMap&)> on_map;
    std::function<void(std::size_t done, std::size_t of)> on_progress;  ///< in steps; may be empty
    std::function<bool()> stop;  ///< asked at every row and map; may be empty
    /// Gets the bytes of a checkpoint at the end and before a stop; empty: none is made.
    std::function<void(const std::string& bytes)> on_checkpoint;
};

/// Runs the physical model on every cell of a terrain: air by 6.5 K/km from the station's height,
/// sun by slope and aspect, sky by the horizon.
///
/// The table holds the regional series: share of snow-covered ground, snow line, means over the
/// cells inside. The states never depend on the number of threads. With a checkpoint of
/// on_checkpoint in `model.resume` the run goes on from there: the same bits, the whole series,
/// maps from there on.
///   throws  Error when the weather has no elevation, for times outside the weather, a checkpoint
///   of another weather, terrain or model, and as run_physical; Interrupted when stopped
SimulationTable run_grid(const weather::ReadResult& read, const std::string& name,
                         const Terrain& terrain, const GridRun& run);

/// The height that best parts bare ground below from snow above (depth over `least_m`): as few
/// cells as possible are on the wrong side. All bare: the highest cell. All white: the lowest.
double snow_line_m(const std::vector<double>& heights_m, const std::vector<double>& depths_m,
                   double least_m = 0.05);

}  // namespace petrichor::cli

#endif
