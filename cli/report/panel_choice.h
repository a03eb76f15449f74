#ifndef PETRICHOR_CLI_REPORT_PANEL_CHOICE_H
#define PETRICHOR_CLI_REPORT_PANEL_CHOICE_H

#include <string>
#include <vector>

#include "cli/report/table.h"

namespace petrichor::cli {

/// The panels that `wish` asks for: "all"; "auto", without those of a state that never shows
/// anything; else the groups named, separated by commas, and those of the weather above them.
///   throws  Error that lists the groups for any other word
std::vector<PlotPanel> chosen_panels(const SimulationTable& table, const std::string& wish);

}  // namespace petrichor::cli

#endif
