#ifndef PETRICHOR_CLI_BENCH_SKILL_WINTER_H
#define PETRICHOR_CLI_BENCH_SKILL_WINTER_H

#include <cstdint>
#include <string>
#include <vector>

#include "cli/bench/skill/skill_row.h"
#include "cli/simulate/observations.h"
#include "weather/models/physical/physical.h"

namespace petrichor::cli {

/// A season of weather with what was seen of its snow.
struct Winter {
    std::string name;
    weather::ForcingTable table;
    Observations observed;  ///< columns as in physical_columns(); daily
};

/// Snow of each whole hour from the beginning of a run, in any model's words. NaN: not modelled.
struct SnowHour {
    double depth_m, swe_kg_m2, surface_c, albedo, shortwave_w_m2;
};
struct SnowHours {
    std::int64_t begin_us = 0;
    std::vector<SnowHour> hours;
};

/// Our model over the winter, and degree days over it (snow_simple.h), which know SWE and, at 300
/// kg/m3, depth.
SnowHours model_hours(const Winter& winter, const weather::PhysicalParams& params);
SnowHours degree_day_hours(const Winter& winter);

/// One row a quantity that was seen. Depth and SWE at 12 h; surface temperature and albedo as daily
/// means (albedo weighted by the sun) on days with more than 0.1 m; the day on which the snow of
/// the season has gone: the first without snow after the last with more than 0.1 m.
std::vector<SkillRow> winter_rows(const Winter& winter, const SnowHours& model);

}  // namespace petrichor::cli

#endif
