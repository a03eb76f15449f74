#ifndef PETRICHOR_CLI_BENCH_SKILL_FIND_SETS_H
#define PETRICHOR_CLI_BENCH_SKILL_FIND_SETS_H

#include <string>
#include <vector>

#include "cli/bench/skill/road.h"
#include "cli/bench/skill/snow_maps.h"
#include "cli/bench/skill/urban_site.h"
#include "cli/bench/skill/winter.h"

namespace petrichor::cli {

/// A file of weather with measured longwave, and another with its place.
struct LongwaveStation {
    std::string name;
    weather::ForcingTable raw;  ///< as read, nothing filled
    /// A row each, NaN where missing; empty where not measured: volt of a sensor of wetness, and what
    /// an infrared thermometer saw of the ground.
    std::vector<double> wetness_v, skin_c;
};
struct WinterSet {
    Winter winter;
    weather::ForcingTable raw;  ///< as read, nothing filled
    std::string weather_file, observed_file;
};
struct SkillSets {
    std::vector<WinterSet> winters;
    std::vector<RoadCase> roads;
    std::vector<LongwaveStation> stations;
    std::vector<UrbanSite> towns;
    std::vector<SnowMapSet> landscapes;
    std::vector<std::string> notes;  ///< what was found and could not be used, and why
};

/// Every data set below a folder:
///
///   met_X.txt or .csv beside obs_X.txt or .csv, X_met_hourly.csv beside X_obs_daily.csv: winters
///   station.xml, observation.xml and roadcast_reference.xml in one folder: a road of METRo
///   *.dly and ghcn* of GHCN-daily with snow depths: winters whose weather is a day's extremes
///   DSM_X.tif and what belongs to it in a folder kronenhuset or gustav_adolfs: places in a town
///   dem.asc, weather.* and snow_YYYY-MM-DD.asc in one folder: a landscape seen by Sentinel-2
///   *.dat of SURFRAD, and Bondville's champaign_*.dat: stations with longwave
///
/// A file site.toml in the folder of a winter or landscape gives its place (table [site]); winters
/// of Col de Porte are known by name.
///   throws  Error when the folder does not exist or holds none of these
SkillSets find_skill_sets(const std::string& folder);

}  // namespace petrichor::cli

#endif
