#ifndef PETRICHOR_CLI_SIMULATE_OUTPUTS_H
#define PETRICHOR_CLI_SIMULATE_OUTPUTS_H

#include <filesystem>

#include "cli/report/table.h"

namespace petrichor::cli {

/// Throws Error when no writer knows the extension, before anything is computed.
void check_output(const std::filesystem::path& path);

/// Writes a table by the extension: .csv, .json, .svg, .png, .html; "-" is CSV on standard output.
void write_table(const SimulationTable& table, const std::filesystem::path& path, bool with_hash);

}  // namespace petrichor::cli

#endif
