#ifndef PETRICHOR_CLI_SIMULATE_GRID_PROGRESS_H
#define PETRICHOR_CLI_SIMULATE_GRID_PROGRESS_H

#include <string>
#include <string_view>
#include <vector>

#include "weather/models/physical/physical_grid_checkpoint.h"

namespace petrichor::cli {

/// What a grid run has reached: the states of its cells and the rows of its series so far, so that
/// the run that goes on ends with the whole series.
struct GridProgress {
    double every_s = 0.0;  ///< between rows
    std::vector<std::vector<double>> rows;
};

/// As bytes for a checkpoint file.
std::string save_progress(const weather::PhysicalGrid& grid, const weather::RunIdentity& identity,
                          const GridProgress& progress);

/// Puts the grid where the checkpoint was and returns the rows before it.
///   throws  Error as weather::load_grid, and for rows of another spacing or number of columns
GridProgress load_progress(weather::PhysicalGrid& grid, const weather::RunIdentity& identity,
                           double every_s, std::size_t columns, std::string_view bytes);

}  // namespace petrichor::cli

#endif
