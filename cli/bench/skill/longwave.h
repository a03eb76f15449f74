#ifndef PETRICHOR_CLI_BENCH_SKILL_LONGWAVE_H
#define PETRICHOR_CLI_BENCH_SKILL_LONGWAVE_H

#include <string>
#include <vector>

#include "cli/bench/skill/skill_row.h"
#include "weather/forcing/forcing.h"

namespace petrichor::cli {

/// The table as it would be filled if its longwave had not been measured.
weather::ForcingTable without_longwave(const weather::ForcingTable& raw);

/// Made longwave beside measured longwave: root mean square error over all hours, and under cloud
/// (a filled cloud of 0.9 or more) the size of the bias. Empty without measured longwave.
std::vector<SkillRow> longwave_rows(const std::string& set, const weather::ForcingTable& raw);

}  // namespace petrichor::cli

#endif
