#ifndef PETRICHOR_CLI_REPORT_PLOT_H
#define PETRICHOR_CLI_REPORT_PLOT_H

#include <string>

#include "cli/report/drawing.h"
#include "cli/report/table.h"

namespace petrichor::cli {

/// A plot of the panels of a table, forcing above, state below, over one time axis (dates where the
/// table has them) with its events as numbered dashed lines (of more than 40 the most frequent
/// kinds are left out and named), and its warnings under the title. 960 units wide.
Drawing plot_of(const SimulationTable& table);
/// The same as self-contained SVG.
std::string svg_plot(const SimulationTable& table);

}  // namespace petrichor::cli

#endif
