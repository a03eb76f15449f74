#include <CLI/CLI.hpp>

#include "cli/simulate/physical.h"

namespace petrichor::cli {

void add_physical_options(CLI::App& command, PhysicalRun& run)
{
    const char* group = "Physical model (INPUT is a weather file: EPW, TMY3, PVGIS, Open-Meteo, METAR, SMET, ..)";
    command.add_option("--latitude", run.latitude_deg, "degrees north, if the file does not say")->group(group);
    command.add_option("--longitude", run.longitude_deg, "degrees east")->group(group);
    command.add_option("--elevation-m", run.elevation_m, "above the sea")->group(group);
    command.add_option("--temp-height-m", run.temp_height_m, "of the thermometer above ground (default 2)")->group(group);
    command.add_option("--wind-height-m", run.wind_height_m, "of the anemometer above ground (default 10)")->group(group);
    command.add_option("--surface", run.surface, "asphalt, concrete, paving_stones, grass, soil, roof_metal, ..")->group(group)->capture_default_str();
    command.add_option("--phase", run.phase, "rain or snow: linear, humidity, wet-bulb, threshold")->group(group)->capture_default_str();
    command.add_option("--station", run.station, "of a METAR file (default: the one with most reports)")->group(group);
    command.add_option("--month", run.month, "of METAR reports, like 2024-02")->group(group);
    command.add_option("--ensemble", run.members, "members with perturbed weather; percentiles instead of one state")->group(group);
    command.add_option("--seed", run.seed, "of the ensemble")->group(group)->capture_default_str();
    command.add_option("--threads", run.threads, "of the ensemble")->group(group)->capture_default_str();
    command.add_flag("--sensitivity", run.sensitivity, "print what changes of the weather do")->group(group);
    command.add_flag("--fit-artist", run.fit_artist, "write artist parameters fitted to the file as TOML instead (-o P.toml)")->group(group);
}

}  // namespace petrichor::cli
