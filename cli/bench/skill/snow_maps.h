#ifndef PETRICHOR_CLI_BENCH_SKILL_SNOW_MAPS_H
#define PETRICHOR_CLI_BENCH_SKILL_SNOW_MAPS_H

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/bench/skill/skill_row.h"
#include "cli/simulate/terrain.h"
#include "weather/readers/read_weather.h"

namespace petrichor::cli {

enum class SnowSeen : std::int8_t { Unknown, Bare, Snow };

/// A landscape under one weather, and what a satellite saw of its snow.
struct SnowMapSet {
    struct Map {
        std::int64_t time_us = 0;
        std::vector<SnowSeen> cells;  ///< as those of the terrain
    };
    std::string name;
    weather::ReadResult weather;
    Terrain terrain;
    std::vector<Map> maps;  ///< by time
};

/// True for a folder with dem.asc and at least one snow_YYYY-MM-DD.asc (or snow_YYYYMMDD.asc).
bool is_snow_map_set(const std::filesystem::path& folder);

/// Heights (dem.asc, at most 256 cells a side), the one file weather.* of any kind that is text,
/// and all maps of snow; ESRI ASCII grids of the same cells. The codes of a map are those of the
/// Theia and Copernicus products from Sentinel-2: 0 bare, 100 (or 1) snow, 205 cloud, 254, 255 and
/// NODATA_value unknown. A map is of 10:30 by the sun, when Sentinel-2 passes.
///   site  where the file of weather does not say it
///   throws  Error for grids that do not fit, other codes, no or two files of weather, maps outside
///           the weather
SnowMapSet read_snow_map_set(const std::filesystem::path& folder, const weather::Site& site);

/// 1 less Cohen's kappa of snow in all cells that were seen, and the snow line of the maps (RMSE
/// over those with both snow and bare ground). Snow is 0.02 m or more, as for Theia's product
/// (Gascoin et al. 2019, Earth Syst. Sci. Data 11, 493).
///   settings  NAME=NUMBER: constants of the model; those of roads are left out
std::vector<SkillRow> snow_map_rows(const SnowMapSet& set,
                                    const std::vector<std::string>& settings = {});

}  // namespace petrichor::cli

#endif
