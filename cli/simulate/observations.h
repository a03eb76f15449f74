#ifndef PETRICHOR_CLI_SIMULATE_OBSERVATIONS_H
#define PETRICHOR_CLI_SIMULATE_OBSERVATIONS_H

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cli/report/table.h"
#include "weather/forcing/forcing.h"

namespace petrichor::cli {

/// One observed quantity over time.
struct ObservedColumn {
    std::string column;  ///< of the simulation's table
    std::vector<std::int64_t> time_us;
    std::vector<double> values;
};
struct Observations {
    std::string label = "observed";  ///< in legends
    bool daily = false;              ///< dates without a time of day
    std::vector<ObservedColumn> columns;
    std::vector<std::string> notes;
};

/// Reads observations: CSV (comma, semicolon or tab) with a column date or time and columns named
/// as in the simulation's table (snow_depth_m, swe_kg_m2, surface_temp_c, snow_albedo or albedo,
/// ...), or the nine columns of FSM: year, month, day, albedo, run-off, depth m, SWE kg/m2, surface
/// and soil temperature C. Missing: empty, NA, -99, -999, -9999. Bad rows are left out and named in
/// the notes.
///   throws  Error with the lines when nothing can be compared
Observations read_observations(std::string_view text, const std::string& file,
                               const std::vector<std::string>& table_columns);

/// What a weather file itself observed of the ground: snow depth, snow water, surface temperature,
/// albedo from reflected sun, condition and friction of roads and runways. Columns of nothing but zeros are left out.
Observations observations_of(const weather::ForcingTable& table);

/// Compares and draws: adds scores, notes and dots on the panels that show an observed column.
///
/// `fine` holds the rows to compare, an hour or less apart; `table` gets the results (they may be
/// the same). Daily observations: depth, SWE and other states against the value at 12 h; surface
/// temperature and albedo against the daily mean (albedo weighted by the sun) on days with more
/// than 0.1 m of observed snow, where depth is observed. Timed ones: against the value at their
/// time. Conditions of a road (METRo's codes) agree when both are dry, both wet, or both white.
void compare(const SimulationTable& fine, const Observations& observed, SimulationTable& table);

}  // namespace petrichor::cli

#endif
