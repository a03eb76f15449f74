#ifndef PETRICHOR_CLI_SIMULATE_SIMULATE_OPTIONS_H
#define PETRICHOR_CLI_SIMULATE_SIMULATE_OPTIONS_H

#include <optional>
#include <string>
#include <vector>

#include "cli/simulate/physical.h"
#include "cli/simulate/terrain.h"
#include "weather/models/physical/coupling.h"

namespace CLI {
class App;
}

namespace petrichor::cli {

/// The words of `petrichor simulate`, as given.
struct SimulateOptions {
    std::vector<std::string> inputs;
    std::string model = "auto";  ///< auto, artist, physical
    std::string mode = "exact";  ///< of the artist model: exact, stepped
    std::string step, every;     ///< durations
    std::string interpolation;   ///< of CSV keys: hold, linear, smooth
    std::string params;          ///< a TOML file
    std::string from, to;        ///< times
    std::vector<std::string> outputs;
    std::string plot = "auto";
    std::string observed;                 ///< a file
    std::string grid_point = "bilinear";  ///< of NetCDF and GRIB: bilinear, nearest
    std::string checkpoint, resume;
    bool json = false;
    bool hash = false;
    bool list = false;
    bool fit_artist = false;
    std::string height_map;
    double height_range_m = 0.02;
    std::string road, road_observed;  ///< station and observation of METRo
    weather::CouplingParams coupling;  ///< of road_observed; a window of 0 h: none
    std::string horizon, events;      ///< files, or empty
    std::string initial;              ///< "surface=-0.9,ground=-0.7@0.4", C and m
    std::string physics;              ///< a TOML file of constants
    std::optional<double> albedo, conductivity, traffic_heat, slush_rate, deep_temp_c,
        precip_factor;  ///< words for constants that are often set
    bool list_physics = false;
    TerrainOptions terrain;
    int weather_parts = 0;  ///< of a terrain's side, each with the weather of its middle
    std::vector<std::string> maps, map_times;
    PhysicalRun physical;
};

/// Declares them on the command, in groups that a person reads in a minute, with examples below.
void add_simulate_options(CLI::App& command, SimulateOptions& options);

}  // namespace petrichor::cli

#endif
