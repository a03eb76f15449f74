#ifndef PETRICHOR_CLI_BENCH_SKILL_MEADOW_H
#define PETRICHOR_CLI_BENCH_SKILL_MEADOW_H

#include <vector>

#include "cli/bench/skill/find_sets.h"
#include "cli/bench/skill/skill_row.h"

namespace petrichor::cli {

/// A year of low plants: how often they are wet when a sensor beside them is (1 less Cohen's kappa:
/// 0 is always, 1 no better than chance), and their temperature as an infrared thermometer sees it.
/// Empty for stations without these.
std::vector<SkillRow> meadow_rows(const LongwaveStation& station,
                                  const weather::PhysicalParams& params);

}  // namespace petrichor::cli

#endif
