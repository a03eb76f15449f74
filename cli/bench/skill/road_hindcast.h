#ifndef PETRICHOR_CLI_BENCH_SKILL_ROAD_HINDCAST_H
#define PETRICHOR_CLI_BENCH_SKILL_ROAD_HINDCAST_H

#include <vector>

#include "cli/bench/skill/road.h"
#include "weather/models/physical/coupling.h"

namespace petrichor::cli {

/// Forecasts that could have been made while a road was measured, held against what was measured
/// later. Each begins at a measured value, knows the road up to it, and later the air, dew point,
/// wind and whether something falls as measured (a forecast without error), clouds as
/// weather::observed_weather has them. Beside it the air, and the last measured value kept.
///
/// Three sets of them, each row a root mean square error:
///   all ahead   one forecast, from the first measured value on: nothing to couple with
///   half ahead  one forecast, from the last value of the first half of the measured hours on
///   6 h ahead   one from each hour on that has three hours before it, each over the next six
/// Each begins with the water that the hours before have left on the road (weather::observed_water).
/// Of each: "road coupled" (weather::couple_radiation), "road started" (the same start, no
/// correction), "air" and "road kept".
///
/// Empty where fewer than three hours or two values are measured, the last two sets where fewer than
/// six of either.
std::vector<SkillRow> road_hindcast_rows(const RoadCase& road,
                                         const weather::PhysicalParams& params,
                                         const weather::CouplingParams& coupling = {});

}  // namespace petrichor::cli

#endif
