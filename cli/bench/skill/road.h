#ifndef PETRICHOR_CLI_BENCH_SKILL_ROAD_H
#define PETRICHOR_CLI_BENCH_SKILL_ROAD_H

#include <string>
#include <vector>

#include "cli/bench/skill/skill_row.h"
#include "weather/models/physical/physical.h"
#include "weather/readers/metro_xml.h"

namespace petrichor::cli {

/// A road weather station with a forecast and METRo's answer to it.
struct RoadCase {
    std::string name;
    weather::MetroStation station;
    weather::MetroObservation observed;
    weather::ForcingTable forecast;
    weather::MetroRoadcast roadcast;
};

/// Mean absolute difference to METRo's road temperature, under the air and radiation that METRo
/// used, from the measured start, without the wind of traffic, which METRo does not have, and with
/// it; and beside them that of the air. Snow on the road counts. `params` are of a road or a bridge;
/// its layers are the station's.
std::vector<SkillRow> road_rows(const RoadCase& road, const weather::PhysicalParams& params);

}  // namespace petrichor::cli

#endif
