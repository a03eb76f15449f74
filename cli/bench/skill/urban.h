#ifndef PETRICHOR_CLI_BENCH_SKILL_URBAN_H
#define PETRICHOR_CLI_BENCH_SKILL_URBAN_H

#include <vector>

#include "cli/bench/skill/skill_row.h"
#include "cli/bench/skill/urban_site.h"

namespace petrichor::cli {

/// Radiation at the station in the hours that were measured, by the weather of the patches around it.
using UrbanRadiation = UrbanHour;
std::vector<UrbanRadiation> urban_radiation(const UrbanSite& site, const UrbanDay& day);

/// Short and long wave from above, from below and from the four sides together, over all days:
/// root mean square errors of the hours.
std::vector<SkillRow> urban_rows(const UrbanSite& site);

}  // namespace petrichor::cli

#endif
