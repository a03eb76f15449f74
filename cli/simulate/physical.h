#ifndef PETRICHOR_CLI_SIMULATE_PHYSICAL_H
#define PETRICHOR_CLI_SIMULATE_PHYSICAL_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/report/table.h"
#include "cli/rooms.h"
#include "film/weather/weather_input.h"
#include "weather/models/physical/observed_water.h"
#include "weather/models/physical/physical.h"
#include "weather/readers/metro_xml.h"
#include "weather/readers/read_weather.h"

namespace petrichor::cli {

/// How the physical model is run.
struct PhysicalRun {
    SiteOptions site;
    std::string phase = "linear";               ///< linear, humidity, wet-bulb, threshold
    std::string physics, physics_file;          ///< text of a TOML file of constants, and its name
    std::vector<std::string> settings;          ///< NAME=NUMBER, after the file
    std::optional<weather::Surface> road;       ///< of a METRo station, instead of the preset
    weather::MetroObservation road_observed{};  ///< the run begins at its last temperature
    weather::ForcingTable road_weather{};       ///< of the hours that it was observed in
    weather::RoadWater road_water{};            ///< that they have left on it
    double road_depth_m = 0.4;                  ///< of its sub-surface thermometer
    weather::Horizon horizon{};                 ///< empty: open
    std::vector<weather::RoadEvent> events{};   ///< salt and ploughs
    std::string layers;                         ///< asphalt:0.2,gravel:0.4, or empty
    std::optional<double> initial_surface_c, initial_ground_c;  ///< measured start
    double initial_depth_m = 0.4;                               ///< of the ground's temperature
    std::optional<weather::Hypsometry> cracks,
        puddles;  ///< of a height map, instead of the surface's own
    double step_s = 3600.0;
    double every_s = 3600.0;
    std::optional<double> from_s, to_s;  ///< of the rows; the run itself begins with the file
    std::string resume;                  ///< text of a checkpoint, or empty
    std::string* checkpoint = nullptr;
    int members = 0;  ///< > 0: an ensemble, percentiles instead of one state
    std::uint64_t seed = 1;
    int threads = 0;              ///< 0 becomes all cores at the command line; else >= 1
    bool sensitivity = false;     ///< adds the sensitivity table to notes and JSON
    bool utc = false;             ///< times in UTC, not by the file's clock
    double clock_offset_s = 0.0;  ///< of the clock that times are shown in
    std::string observed;         ///< text of observations to compare with, or empty
    std::string observed_file;    ///< its name
};

/// Parameters of the model that a run asks for. Throws Error for a surface or phase law that does
/// not exist.
weather::PhysicalParams physical_params(const PhysicalRun& run);

/// Runs the physical model over a weather file that has been read.
///
/// The notes hold what was read, missing and filled, and so does the JSON (key "read"). Row 0 is
/// the initial state. Columns: physical_table.h; time_utc is written beside time_s.
SimulationTable run_physical(const weather::ReadResult& read, const std::string& name,
                             const PhysicalRun& run);

/// The fitted rates as a TOML [artist] table with the residuals as comments.
std::string fitted_artist_toml(const weather::ReadResult& read, const PhysicalRun& run);

/// Notes, warnings and JSON of what was read, for any model.
void add_read_report(SimulationTable& table, const weather::ReadResult& read);

}  // namespace petrichor::cli

#endif
