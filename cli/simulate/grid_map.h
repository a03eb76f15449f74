#ifndef PETRICHOR_CLI_SIMULATE_GRID_MAP_H
#define PETRICHOR_CLI_SIMULATE_GRID_MAP_H

#include <filesystem>

#include "cli/simulate/grid.h"

namespace petrichor::cli {

/// Writes the state of a terrain as an image: .exr with a layer for each quantity (snow_depth.m,
/// swe.kg_m2, surface_temp.C, .., elevation.m, mask.snow, ..; outside the terrain 0), or .png to
/// look at: the shaded land with its snow, water and ice as they would look, at least 512 pixels
/// wide, and below it the time, the snow and a bar of length. North is up.
///   throws  Error for any other kind of file
void write_grid_map(const std::filesystem::path& path, const Terrain& terrain, const GridMap& map,
                    const PhysicalRun& model);

/// OUT.exr -> OUT_20060201T1200.exr when several times are written.
std::filesystem::path map_path(const std::filesystem::path& path, std::int64_t time_us,
                               bool several);

}  // namespace petrichor::cli

#endif
