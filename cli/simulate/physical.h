#ifndef PETRICHOR_CLI_SIMULATE_PHYSICAL_H
#define PETRICHOR_CLI_SIMULATE_PHYSICAL_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "cli/simulate/table.h"
#include "weather/physical.h"
#include "weather/readers/read_weather.h"

namespace CLI {
class App;
}

namespace petrichor::cli {

/// How the physical model is run. What is not given comes from the file, then from defaults.
struct PhysicalRun {
    std::optional<double> latitude_deg, longitude_deg, elevation_m, temp_height_m, wind_height_m;
    std::string surface = "asphalt";
    std::string phase = "linear";    ///< linear, humidity, wet-bulb, threshold
    std::string station;             ///< of a METAR file
    std::string month;               ///< "2024-02": of METAR reports, which name only the day
    std::string fetch_params;        ///< text of a TOML with [site], or empty
    double step_s = 3600.0;
    double every_s = 3600.0;
    std::optional<double> from_s, to_s;
    std::string resume;              ///< text of a checkpoint, or empty
    std::string* checkpoint = nullptr;
    int members = 0;                 ///< > 0: an ensemble, percentiles instead of one state
    std::uint64_t seed = 1;
    int threads = 1;
    bool sensitivity = false;        ///< adds the sensitivity table to the notes
    bool fit_artist = false;         ///< adds the fitted rates to the notes
    std::string* report_json = nullptr;  ///< where to put the read report as JSON, or null
};

/// Reads a weather file of any kind and runs the physical model over it.
///
/// The notes hold what was read, missing and filled. Row 0 is the initial state. Columns: time_s, the forcing, every
/// state in SI, fluxes, running totals and residuals, then the 0..1 masks; time_utc is written beside time_s.
SimulationTable run_physical(std::string_view text, const std::string& name, const PhysicalRun& run);

/// The fitted rates as a TOML [artist] table with the residuals as comments.
std::string fitted_artist_toml(std::string_view text, const PhysicalRun& run);

/// Declares the options above on a command.
void add_physical_options(CLI::App& command, PhysicalRun& run);

}  // namespace petrichor::cli

#endif
