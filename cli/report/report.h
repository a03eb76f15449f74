#ifndef PETRICHOR_CLI_REPORT_REPORT_H
#define PETRICHOR_CLI_REPORT_REPORT_H

#include <string>

#include "cli/report/table.h"

namespace petrichor::cli {

/// One HTML file with everything in it: data, style, script; nothing is fetched. Forcing above,
/// state below; drag, wheel and pinch move and zoom the time axis, the pointer reads values, events
/// are marked and listed. Readable from 320 pixels of width on, light and dark. Without scripts it
/// shows the static plot. At most about 20 000 rows are embedded, among them the lowest and highest of
/// every curve in each stretch that is left out; the page says so.
std::string html_report(const SimulationTable& table);

}  // namespace petrichor::cli

#endif
