#ifndef PETRICHOR_CLI_SIMULATE_PLOT_H
#define PETRICHOR_CLI_SIMULATE_PLOT_H

#include <string>
#include <utility>
#include <vector>

#include "cli/simulate/drawing.h"
#include "cli/simulate/table.h"

namespace petrichor::cli {

/// A plot of the panels of a table, forcing above, state below, over one time axis (dates where the
/// table has them) with the first 40 events as numbered dashed lines, and its warnings under the
/// title. 960 units wide.
Drawing plot_of(const SimulationTable& table);
/// The same as self-contained SVG.
std::string svg_plot(const SimulationTable& table);

/// Up to about `most` round numbers inside low..high, evenly spaced (steps of 1, 2, 5 x 10^n; for
/// times also minutes, hours and days).
std::vector<double> axis_ticks(double low, double high, int most, bool time);

/// "12 s", "3 min", "2 h", "5 d": a time of the axis with its spacing in mind.
std::string time_label(double time_s, double spacing_s);

/// The range of a panel's axis: fixed, or that of the data with 0 inside and rounded outwards.
std::pair<double, double> axis_range(const SimulationTable& table, const PlotPanel& panel);

/// Decimals that tell the ticks of an axis apart.
int decimals_of(const std::vector<double>& ticks);

/// The panels that `wish` asks for: "all"; "auto", without those of a state that never shows
/// anything; else the groups named, separated by commas, and those of the weather above them.
///   throws  Error that lists the groups for any other word
std::vector<PlotPanel> chosen_panels(const SimulationTable& table, const std::string& wish);

/// Index of a column; the number of columns when there is none.
std::size_t column_index(const SimulationTable& table, const std::string& name);

/// Rows to draw: all of them, or about `most` evenly spread ones, the first and the last included.
std::vector<std::size_t> rows_to_draw(const SimulationTable& table, std::size_t most);

}  // namespace petrichor::cli

#endif
