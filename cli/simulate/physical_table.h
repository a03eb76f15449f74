#ifndef PETRICHOR_CLI_SIMULATE_PHYSICAL_TABLE_H
#define PETRICHOR_CLI_SIMULATE_PHYSICAL_TABLE_H

#include <cstdint>
#include <string>
#include <vector>

#include "cli/report/table.h"
#include "weather/forcing/forcing.h"
#include "weather/physics/cell_state.h"
#include "weather/physics/surfaces.h"

namespace petrichor::cli {

/// The columns of the physical model's table, in order: time_s, the forcing, every state in SI,
/// fluxes, running totals and residuals, the 0..1 masks, and what a driver asks: wheel friction,
/// thickness of clear ice, METRo's condition of the road (friction.h).
const std::vector<std::string>& physical_columns();

/// One row of that table: the state at `us`, whose last step took `interval_s` seconds.
std::vector<double> physical_row(const weather::ForcingTable& table,
                                 const weather::Surface& surface, const weather::CellState& state,
                                 const weather::CellState& initial, std::int64_t us,
                                 double interval_s);

/// What plots show of it: groups weather, snow, heat, water, masks.
std::vector<PlotPanel> physical_panels();
/// What else is of interest on a road in use.
std::vector<PlotPanel> road_panels();

/// Adds "snow on the ground", "snow gone", "puddles full", "everything frozen", ... in order of
/// time.
void add_physical_events(SimulationTable& table);

}  // namespace petrichor::cli

#endif
