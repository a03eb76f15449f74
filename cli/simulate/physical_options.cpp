#include <CLI/CLI.hpp>

#include "cli/simulate/physical.h"

namespace petrichor::cli {

void add_site_options(CLI::App& command, SiteOptions& site, const std::string& group)
{
    command.add_option("--latitude", site.latitude_deg, "degrees north, if the file does not say")
        ->group(group);
    command.add_option("--longitude", site.longitude_deg, "degrees east")->group(group);
    command.add_option("--elevation-m", site.elevation_m, "above the sea")->group(group);
    command
        .add_option("--temp-height-m", site.temp_height_m,
                    "of the thermometer above ground (default 2)")
        ->group(group);
    command
        .add_option("--wind-height-m", site.wind_height_m,
                    "of the anemometer above ground (default 10)")
        ->group(group);
    command
        .add_option("--surface", site.surface,
                    "asphalt, concrete, paving_stones, grass, soil, roof_metal, ..")
        ->group(group)
        ->capture_default_str();
    command
        .add_option("--station", site.station,
                    "of a METAR file (default: the one with most reports)")
        ->group(group);
    command.add_option("--month", site.month, "of METAR reports, like 2024-02")->group(group);
    command
        .add_option("--taf", site.taf,
                    "TEMPO and PROB groups of forecasts: expected mixes them in by their share "
                    "(TEMPO 0.5, PROB30 0.3), prevailing leaves them out, worst takes the worst")
        ->check(CLI::IsMember({"expected", "prevailing", "worst"}))
        ->group(group)
        ->capture_default_str();
    command
        .add_option(
            "--missing-precip", site.missing_precip,
            "where the file gives no amount: dry, or estimate from cloud, humidity and sight")
        ->check(CLI::IsMember({"dry", "estimate"}))
        ->group(group)
        ->capture_default_str();
}

void add_physical_options(CLI::App& command, PhysicalRun& run)
{
    add_site_options(command, run.site,
                     "Weather files (EPW, TMY3, PVGIS, Open-Meteo, METAR, SMET, ISD-Lite, "
                     "GHCN-daily, SURFRAD, FSM, CSV)");
    const char* group = "Physical model";
    command.add_option("--phase", run.phase, "rain or snow: linear, humidity, wet-bulb, threshold")
        ->group(group)
        ->capture_default_str();
    command
        .add_option("--ensemble", run.members,
                    "members with perturbed weather; percentiles instead of one state")
        ->group(group);
    command.add_option("--seed", run.seed, "of the ensemble")->group(group)->capture_default_str();
    command
        .add_option("--threads", run.threads,
                    "of ensembles and grids; 0: all cores; results do not depend on it")
        ->group(group)
        ->capture_default_str();
    command.add_flag("--sensitivity", run.sensitivity, "print what changes of the weather do")
        ->group(group);
}

}  // namespace petrichor::cli
