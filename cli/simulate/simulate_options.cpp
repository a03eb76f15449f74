#include "cli/simulate/simulate_options.h"

#include <CLI/CLI.hpp>

#include "weather/readers/formats.h"

namespace petrichor::cli {
namespace {

// One option: where it stands on the page, what its value is called, what it does.
template <class Value>
CLI::Option* add(CLI::App& command, const char* group, const char* name, const char* type,
                 Value& value, const char* help)
{
    return command.add_option(name, value, help)->group(group)->type_name(type);
}

// The kinds of files that are read, in lines of a page of help.
std::string weather_kinds()
{
    constexpr std::size_t kWidth = 78;
    std::string all, line;
    const auto add_word = [&](const std::string& word) {
        if (!line.empty() && line.size() + 2 + word.size() > kWidth) {
            all += line + ",\n";
            line.clear();
        }
        line += (line.empty() ? "" : ", ") + word;
    };
    for (const weather::Reader* reader : weather::weather_readers()) add_word(reader->name);
    for (const char* other : {"NetCDF", "GRIB", "and .gz or .zip of all of these"})
        add_word(other);
    return all + line + ";";
}

void add_input(CLI::App& command, SimulateOptions& o)
{
    const char* group = "Input";
    command
        .add_option(
            "INPUT", o.inputs,
            "weather files of one place (the kind is found from the content):\n" + weather_kinds() +
                "\nor CSV keys of the artist model (time_s,temperature_c,rainfall; - is standard "
                "input),\nor a weather TOML, or a preset")
        ->type_name("");
    command.add_flag("--list", o.list, "list the presets")->group(group);
    add(command, group, "--interp", "WORD", o.interpolation,
        "between CSV keys: hold (default), linear, smooth")
        ->check(CLI::IsMember({"hold", "linear", "smooth"}));
    SiteOptions& site = o.physical.site;
    add(command, group, "--station", "CODE", site.station,
        "of a file with several; METAR: default the one with most reports");
    add(command, group, "--month", "YYYY-MM", site.month,
        "of METAR reports, which say only the day");
    add(command, group, "--taf", "WORD", site.taf,
        "TEMPO and PROB groups of forecasts: expected (default; by their share:\nTEMPO 0.5, PROB30 "
        "0.3), prevailing (left out), worst")
        ->check(CLI::IsMember({"expected", "prevailing", "worst"}));
    add(command, group, "--missing-precip", "WORD", site.missing_precip,
        "where a file gives no amount: dry (default), or estimate from cloud,\nhumidity and sight")
        ->check(CLI::IsMember({"dry", "estimate"}));
}

void add_model(CLI::App& command, SimulateOptions& o)
{
    const char* group = "Model";
    add(command, group, "--model", "WORD", o.model,
        "physical (SI), artist (0..1), or auto (default): physical for weather files")
        ->check(CLI::IsMember({"auto", "artist", "physical"}));
    add(command, group, "--mode", "WORD", o.mode,
        "artist: exact (default, closed form) or stepped, as the original by --dt")
        ->check(CLI::IsMember({"exact", "stepped"}));
    add(command, group, "--dt", "TIME", o.step, "step: physical 1h, stepped artist 1/60");
    add(command, group, "--phase", "WORD", o.physical.phase,
        "rain or snow: linear (default), humidity, wet-bulb, threshold");
    add(command, group, "--params", "P.toml", o.params,
        "tables [artist], [artist.initial] and [site]");
    command
        .add_flag("--fit-artist", o.fit_artist,
                  "write artist rates fitted to the weather file (-o P.toml), no states")
        ->group(group);
}

void add_time(CLI::App& command, SimulateOptions& o)
{
    const char* group =
        "Time (90, 1/60, 30min, 6h, 1d; weather files also 2005-12-01T06:00, 12-01)";
    add(command, group, "--from", "TIME", o.from, "first row");
    add(command, group, "--to", "TIME", o.to, "last row (default: the last of the input)");
    command
        .add_flag("--utc", o.physical.utc,
                  "times in UTC, also those of --from, not by the clock of the file")
        ->group(group);
    add(command, group, "--every", "TIME", o.every,
        "rows at whole multiples: keys 1 s, weather files 1h, --grid 1d");
}

void add_site(CLI::App& command, SimulateOptions& o)
{
    const char* group = "Site and surface";
    SiteOptions& site = o.physical.site;
    add(command, group, "--point", "WORD", o.grid_point,
        "of a NetCDF or GRIB grid: bilinear (default) or nearest")
        ->check(CLI::IsMember({"bilinear", "nearest"}));
    add(command, group, "--file-zone", "HOURS", site.file_zone_h,
        "ahead of UTC: of times in the file that name no zone (default: UTC)");
    add(command, group, "--date-order", "WORD", site.date_order,
        "dmy or mdy: of dates such as 01/02/2024 where no row shows which")
        ->check(CLI::IsMember({"dmy", "mdy"}));
    add(command, group, "--ignore", "NAMES", site.ignore,
        "columns of the file that may stay unread, by comma; or all");
    add(command, group, "--latitude", "DEG", site.latitude_deg,
        "north; this and the next two if the file does not say");
    add(command, group, "--longitude", "DEG", site.longitude_deg, "east");
    add(command, group, "--elevation-m", "M", site.elevation_m, "above the sea");
    add(command, group, "--temp-height-m", "M", site.temp_height_m,
        "thermometer above ground (default 2)");
    add(command, group, "--wind-height-m", "M", site.wind_height_m,
        "anemometer above ground (default 10)");
    add(command, group, "--surface", "NAME", site.surface,
        "asphalt (default), concrete, paving_stones, cobblestone, brick, soil, sand,\ngravel, "
        "grass, lawn, roof_metal, roof_tile, wood, rock, road (in use), bridge");
    add(command, group, "--max-gap", "DAYS", site.max_gap_days,
        "longest time between two rows of a weather file (default 60)");
    add(command, group, "--sky-view", "SHARE", site.sky_view,
        "of the sky that is seen, 0..1 (default 1); houses and trees hide it");
    add(command, group, "--canopy-vai", "M2", site.canopy_vai,
        "leaves and branches above a m2 of ground (default 0, forests 1 to 4):\nthey catch snow "
        "first");
    add(command, group, "--height-map", "IMAGE", o.height_map,
        "of the material, white is high: its own cracks and puddles");
    add(command, group, "--height-range-m", "M", o.height_range_m,
        "of that image from black to white (default 0.02)");
}

void add_physics(CLI::App& command, SimulateOptions& o)
{
    const char* group = "Physics (constants of the physical model)";
    add(command, group, "--road", "STATION.xml", o.road,
        "a METRo station: its layers, road or bridge, place; INPUT may be METRo's forecast");
    add(command, group, "--road-observed", "OBS.xml", o.road_observed,
        "what it measured: the run begins at its last temperature, under radiation that the\nhours "
        "before it correct (docs/weather.md)");
    add(command, group, "--coupling", "HOURS", o.coupling.window_h,
        "of --road-observed that correct the radiation (default 3, 0: none)")
        ->check(CLI::Range(0.0, 48.0));
    add(command, group, "--coupling-fade", "HOURS", o.coupling.relaxation_h,
        "in which that correction falls to 1/e (default 4)")
        ->check(CLI::Range(0.01, 1000.0));
    add(command, group, "--horizon", "FILE", o.horizon,
        "what hides the sun: lines of azimuth and elevation, degrees (--road brings its own)");
    add(command, group, "--events", "FILE.csv", o.events,
        "salt, brine and ploughs: time,salt|brine|plough,amount (g/m2, g/m2, share)");
    add(command, group, "--initial", "WORDS", o.initial,
        "measured start: surface=-0.9,ground=-0.7@0.4 (C, at a depth in m)");
    add(command, group, "--layers", "WORDS", o.physical.layers,
        "of a road from the top: asphalt:0.2,gravel:0.4 (asphalt, concrete, gravel,\nsand)");
    add(command, group, "--albedo", "SHARE", o.albedo, "of the surface, dry and wet");
    add(command, group, "--conductivity", "W/m/K", o.conductivity, "of the ground");
    add(command, group, "--deep-temp-c", "C", o.deep_temp_c,
        "of the ground far below (default: the year's mean of the file)");
    add(command, group, "--traffic-heat", "W/m2", o.traffic_heat, "on bare road; METRo takes 10");
    add(command, group, "--slush-rate", "1/s", o.slush_rate,
        "drainage under snow; METRo takes 0.0003");
    add(command, group, "--precip-factor", "X", o.precip_factor,
        "on all precipitation: gauges catch too little in wind");
    add(command, group, "--physics", "FILE.toml", o.physics,
        "tables [surface], [snow], [exchange], [phase], [model]");
    add(command, group, "--set", "NAME=X", o.physical.settings,
        "any constant by name, may be repeated: snow.albedo_min=0.45")
        ->allow_extra_args(false);
    command.add_flag("--list-physics", o.list_physics, "print all names and values")->group(group);
}

void add_output(CLI::App& command, SimulateOptions& o)
{
    const char* group = "Output";
    add(command, group, "-o,--output", "FILE", o.outputs,
        ".csv, .json, .svg, .png or .html, may be repeated; - is CSV on standard\noutput (default)")
        ->allow_extra_args(false);
    add(command, group, "--plot", "WORDS", o.plot,
        "panels: auto (default), all, or some of snow,heat,water,masks,road\n(of the artist model: "
        "snow,water)");
    add(command, group, "--observed", "FILE", o.observed,
        "measured values to plot and score: CSV with date and the names of our\ncolumns, or FSM's");
    command
        .add_flag("--json", o.json,
                  "print a summary: what was read and filled, scores, ranges, hashes")
        ->group(group);
    command.add_flag("--hash", o.hash, "end the CSV with a line of state hashes")->group(group);
}

void add_uncertainty(CLI::App& command, SimulateOptions& o)
{
    const char* group = "Uncertainty";
    add(command, group, "--ensemble", "N", o.physical.members,
        "members with perturbed weather; percentiles instead of one state");
    add(command, group, "--seed", "N", o.physical.seed, "of the ensemble (default 1)");
    command
        .add_flag("--sensitivity", o.physical.sensitivity,
                  "print what changes of the weather would do")
        ->group(group);
}

void add_grid(CLI::App& command, SimulateOptions& o)
{
    const char* group = "Landscape (the physical model on every cell; -o gets the region's series)";
    add(command, group, "--grid", "FILE", o.terrain.file,
        "terrain: ESRI ASCII grid (.asc), float TIFF or EXR in metres, or an image");
    add(command, group, "--cell-size-m", "M", o.terrain.cell_size_m, "of a texel of the terrain");
    add(command, group, "--grid-height-m", "LOW:HIGH", o.terrain.height_range_m,
        "metres of black and white of an image");
    add(command, group, "--grid-size", "N", o.terrain.longest_side,
        "cells along the longer side (default 128); larger terrains are averaged");
    add(command, group, "--surface-mask", "IMAGE", o.terrain.mask, "surfaces over the terrain");
    add(command, group, "--surfaces", "A,B,..", o.terrain.surfaces,
        "names for the mask, from black to white: grass,rock");
    add(command, group, "--weather-parts", "N", o.weather_parts,
        "a NetCDF or GRIB grid over the terrain: N x N parts, each under the weather of its\n"
        "middle, from there by 6.5 K/km; --latitude and --longitude are the terrain's middle")
        ->check(CLI::Range(1, 32));
    add(command, group, "--map", "FILE", o.maps,
        "write a map: .exr (a layer a state) or .png (to look at), may be repeated")
        ->allow_extra_args(false);
    add(command, group, "--at", "TIME", o.map_times,
        "when to write maps (default: the end), may be repeated")
        ->allow_extra_args(false);
}

void add_advanced(CLI::App& command, SimulateOptions& o)
{
    const char* group = "Advanced";
    add(command, group, "--checkpoint", "FILE", o.checkpoint,
        "write the state at the end to this file; a grid also when Ctrl-C stops it");
    add(command, group, "--resume", "FILE", o.resume,
        "go on from such a file, with identical bits");
    add(command, group, "--threads", "N", o.physical.threads,
        "of ensembles and grids (default: all cores); results do not depend on it");
}

}  // namespace

void add_simulate_options(CLI::App& command, SimulateOptions& o)
{
    add_input(command, o);
    add_model(command, o);
    add_time(command, o);
    add_site(command, o);
    add_physics(command, o);
    add_output(command, o);
    add_uncertainty(command, o);
    add_grid(command, o);
    add_advanced(command, o);
    command.footer(
        "Examples:\n"
        "  petrichor simulate rain-then-snow -o report.html            a preset, as a report\n"
        "  petrichor simulate keys.csv --interp linear -o state.csv    a few keys of an artist\n"
        "  petrichor simulate denver.epw --from 04-20 --to 04-28 -o april.png\n"
        "  petrichor simulate road.metar --month 2024-01 --surface asphalt -o road.html\n"
        "  petrichor simulate met.txt --latitude 45.3 --longitude 5.77 --elevation-m 1325 \\\n"
        "      --surface grass --observed obs.txt -o winter.html       model and observation\n"
        "  petrichor simulate denver.epw --fit-artist -o rates.toml\n"
        "  petrichor simulate forecast.xml --road station.xml --events salt.csv -o road.html\n"
        "  petrichor simulate alps.csv --grid dem.asc --at 2006-02-01 --map snow.png -o "
        "region.csv");
}

}  // namespace petrichor::cli
