#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>

#include "base/error.h"
#include "base/output_file.h"
#include "base/words.h"
#include "cli/simulate/relief.h"
#include "cli/simulate/simulations.h"
#include "film/weather/times.h"
#include "weather/forcing/cut_forcing.h"
#include "weather/readers/horizon_text.h"
#include "weather/readers/road_events_text.h"
#include "weather/readers/text.h"

namespace petrichor::cli {

std::string params_text(const SimulateOptions& options)
{
    return options.params.empty() ? "" : read_input_file(options.params);
}

std::optional<double> time_of(const std::string& text, const char* option,
                              std::optional<std::int64_t> start_us, double offset_s)
{
    if (text.empty()) return std::nullopt;
    return parse_time(text, option, start_us, offset_s);
}

std::string title_of(const std::vector<Input>& inputs)
{
    return inputs.size() == 1
               ? inputs.front().name
               : inputs.front().name + " and " + std::to_string(inputs.size() - 1) + " more";
}

namespace {

// A century of hours. A row of the table and its state take some 2 KB.
constexpr double kMostRows = 1e6;
constexpr double kMostSteps = 2e7;

void check_rows(const PhysicalRun& run, double last_s)
{
    const double end_s = std::min(run.to_s.value_or(last_s), last_s);
    const double rows = (end_s - std::max(run.from_s.value_or(0.0), 0.0)) / run.every_s;
    const double steps = end_s / run.step_s;
    if (rows <= kMostRows && steps <= kMostSteps) return;
    throw Error("simulate: " + number_text(std::round(end_s / 864.0 / 365.25) / 100.0) +
                    " years are " + number_text(std::round(rows)) + " rows and " +
                    number_text(std::round(steps)) + " steps, at most " + number_text(kMostRows) +
                    " and " + number_text(kMostSteps) + " are computed",
                "Name a part with --from and --to, or longer steps with --every and --dt.");
}

// The file, then words for constants as settings, then --set.
void read_constants(const SimulateOptions& options, PhysicalRun& run)
{
    if (!options.physics.empty()) {
        run.physics = read_input_file(options.physics);
        run.physics_file = options.physics;
    }
    std::vector<std::string> settings;
    const auto put = [&](const char* name, const std::optional<double>& value) {
        char text[80];
        if (!value) return;
        std::snprintf(text, sizeof text, "%s=%.17g", name, *value);
        settings.emplace_back(text);
    };
    put("surface.albedo_dry", options.albedo);
    put("surface.albedo_wet", options.albedo);
    put("surface.conductivity_w_m_k", options.conductivity);
    put("surface.traffic_heat_w_m2", options.traffic_heat);
    put("surface.slush_rate_1_s", options.slush_rate);
    put("model.deep_temp_c", options.deep_temp_c);
    put("model.precip_factor", options.precip_factor);
    run.settings.insert(run.settings.begin(), settings.begin(), settings.end());
}

// "surface=-0.9,ground=-0.7@0.4"
void read_initial(const std::string& text, PhysicalRun& run)
{
    for (const std::string_view part : weather::split(text, ',', 10)) {
        const std::string_view word = weather::trimmed(part);
        const std::size_t equals = word.find('='), at = word.find('@');
        const std::string_view name = word.substr(0, equals);
        const auto value =
            equals == std::string_view::npos
                ? std::nullopt
                : weather::to_number(
                      word.substr(equals + 1, at == std::string_view::npos ? at : at - equals - 1));
        const auto depth_m = at == std::string_view::npos ? std::optional(0.4)
                                                          : weather::to_number(word.substr(at + 1));
        const bool good = value && depth_m && *value > -90.0 && *value < 100.0 && *depth_m > 0.0 &&
                          *depth_m < 20.0 && (name == "surface" || name == "ground");
        if (!good) {
            throw Error("simulate: --initial '" + std::string(word) + "'",
                        "Write surface=-0.9 or surface=-0.9,ground=-0.7@0.4: degrees in -90..100 "
                        "and a depth in metres below 20.");
        }
        if (name == "surface") {
            run.initial_surface_c = value;
        } else {
            run.initial_ground_c = value;
            run.initial_depth_m = *depth_m;
        }
    }
    if (!run.initial_surface_c)
        throw Error("simulate: --initial has no surface temperature",
                    "Write surface=-0.9,ground=-0.7@0.4.");
}

// A METRo station is the site and the surface.
void read_road(const std::string& file, PhysicalRun& run)
{
    const weather::MetroStation station = weather::read_metro_station(read_input_file(file));
    SiteOptions& site = run.site;
    if (!site.latitude_deg) site.latitude_deg = station.site.latitude_deg;
    if (!site.longitude_deg && !std::isnan(station.site.longitude_deg))
        site.longitude_deg = station.site.longitude_deg;
    run.road = weather::surface_preset(station.bridge ? "bridge" : "road");
    run.road->layers = station.layers;
    run.road_depth_m = station.subsurface_depth_m;
    run.horizon = station.horizon_rad;
}

// Salt and ploughs; an event outside the run would be dropped without a word.
void read_events(const std::string& file, PhysicalInput& input)
{
    PhysicalRun& run = input.run;
    const auto& times = input.read.table.time_us;
    run.events = weather::read_road_events(read_input_file(file), file, run.clock_offset_s);
    if (run.events.empty())
        throw Error("road events: " + file + " has none",
                    "Write lines time,salt|brine|plough,amount.");
    for (const weather::RoadEvent& e : run.events) {
        if (e.time_us >= times.front() && e.time_us <= times.back()) continue;
        throw Error("road events: " + file + ": " + weather::iso_from_us(e.time_us) +
                        " is outside the weather, " + weather::iso_from_us(times.front()) + " to " +
                        weather::iso_from_us(times.back()),
                    "Give events of the run alone; times without a zone are by the file's clock.");
    }
}

// The forecast from the last measured temperature of the road on.
void begin_at_measurement(const std::string& file, PhysicalInput& input)
{
    weather::MetroObservation& o = input.run.road_observed;
    o = weather::read_metro_observation(read_input_file(file));
    input.run.road_weather = weather::observed_weather(o, input.read.table);
    std::size_t count = o.surface_c.size();
    while (count > 0 && std::isnan(o.surface_c[count - 1])) --count;
    o.surface_c.resize(count);
    o.subsurface_c.resize(count);
    o.table.time_us.resize(count);
    weather::ForcingTable& t = input.read.table;
    const bool inside = count > 0 && o.table.time_us.back() < t.time_us.back();
    const std::int64_t at_us = inside ? o.table.time_us.back() : 0;
    if (!inside || at_us < t.time_us.front() - 6LL * 3600 * 1000000) {
        throw Error("simulate: --road-observed " + file +
                        " has no road temperature in the time of the weather, or in the six hours "
                        "before it",
                    "Give the observation that belongs to the forecast.");
    }
    // Before the forecast its first row holds.
    t = weather::cut_forcing(t, at_us, t.time_us.back());
    input.notes.push_back("the run begins at " + weather::iso_from_us(at_us) +
                          " with the measured road");
    if (o.fallen_to_zero > 0)
        input.notes.push_back("the measured road: " + weather::fallen_to_zero_text(o));
    // As other columns of nothing but zeros; METRo takes it as it is.
    const auto zero = std::count(o.subsurface_c.begin(), o.subsurface_c.end(), 0.0);
    if (zero >= 6 && zero == std::count_if(o.subsurface_c.begin(), o.subsurface_c.end(),
                                           [](double c) { return !std::isnan(c); }))
        input.notes.push_back("the temperature below the road is exactly 0 C in all " +
                              std::to_string(zero) +
                              " rows and taken as it is: if nothing measured it, leave <sst> out");
}

// What the rain of the measured hours has left on the road.
void wet_by_measurement(PhysicalInput& input)
{
    PhysicalRun& run = input.run;
    weather::ReadReport unheard;  // the same fills are told of the forecast
    weather::fill_forcing(run.road_weather, unheard);
    const weather::MetroObservation& o = run.road_observed;
    run.road_water =
        weather::observed_water(run.road_weather, physical_params(run),
                                {o.table.time_us, o.surface_c, o.subsurface_c, run.road_depth_m});
    if (run.road_water.sum() < 0.01) return;
    char line[100];
    std::snprintf(line, sizeof line, "the measured hours leave %.2f kg/m2 of water on the road",
                  run.road_water.sum());
    input.notes.emplace_back(line);
}

// What the measured road says about the radiation before the run, kept on into it.
void couple_to_measurement(const SimulateOptions& options, PhysicalInput& input)
{
    PhysicalRun& run = input.run;
    const weather::MetroObservation& o = run.road_observed;
    const auto correction = weather::couple_radiation(
        run.road_weather, physical_params(run),
        {o.table.time_us, o.surface_c, o.subsurface_c, run.road_depth_m}, options.coupling);
    weather::correct_radiation(input.read.table, correction);
    input.notes.push_back(weather::to_text(correction));
}

}  // namespace

weather::PhysicalParams asked_params(const SimulateOptions& options)
{
    PhysicalRun run = options.physical;
    read_constants(options, run);
    return physical_params(run);
}

PhysicalInput physical_input(const std::vector<Input>& inputs, const SimulateOptions& options)
{
    if (inputs.front().kind != InputKind::Weather) {
        throw Error(
            "simulate: " + inputs.front().file + " holds keys of the artist model, not weather",
            "Give the physical model an EPW, TMY3, METAR, CSV or other weather file.");
    }
    const weather::CouplingParams usual;
    if (options.road_observed.empty() && (options.coupling.window_h != usual.window_h ||
                                          options.coupling.relaxation_h != usual.relaxation_h))
        throw Error("simulate: --coupling and --coupling-fade are of a measured road",
                    "Give --road-observed, too, or leave them out.");
    PhysicalInput input;
    PhysicalRun& run = input.run;
    run = options.physical;
    run.site = with_site_table(run.site, params_text(options));
    if (!options.road.empty()) read_road(options.road, run);
    input.read = read_forcing(inputs, run.site);
    if (!options.road_observed.empty()) begin_at_measurement(options.road_observed, input);
    const std::int64_t start_us = input.read.table.time_us.front();
    const double zone_h = input.read.table.site.utc_offset_h;
    const double offset_s = run.utc || std::isnan(zone_h) ? 0.0 : zone_h * 3600.0;
    run.clock_offset_s = offset_s;
    run.from_s = time_of(options.from, "--from", start_us, offset_s);
    run.to_s = time_of(options.to, "--to", start_us, offset_s);
    if (!options.step.empty()) run.step_s = parse_duration(options.step, "--dt").value();
    run.every_s =
        options.every.empty() ? run.step_s : parse_duration(options.every, "--every").value();
    check_rows(run, static_cast<double>(input.read.table.time_us.back() - start_us) * 1e-6);
    if (run.threads == 0)
        run.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    if (!options.resume.empty()) run.resume = read_checkpoint_file(options.resume);
    if (!options.observed.empty()) {
        run.observed = read_input_file(options.observed);
        run.observed_file = options.observed;
        if (run.observed.empty())
            throw Error("observations: " + options.observed + " is empty",
                        "Give a file with observations.");
    }
    read_constants(options, run);
    if (!options.horizon.empty())
        run.horizon = weather::read_horizon(read_input_file(options.horizon), options.horizon);
    if (!run.horizon.empty()) {
        char line[100];
        std::snprintf(line, sizeof line, "the horizon leaves %.1f %% of the sky",
                      100.0 * weather::horizon_sky_view(run.horizon));
        input.notes.emplace_back(line);
    }
    if (!options.events.empty()) read_events(options.events, input);
    if (!run.road_weather.time_us.empty()) wet_by_measurement(input);
    if (!run.road_weather.time_us.empty() && options.coupling.window_h != 0.0)
        couple_to_measurement(options, input);
    if (!options.initial.empty()) read_initial(options.initial, run);
    if (!options.height_map.empty()) {
        const Relief relief = read_relief(options.height_map, options.height_range_m);
        run.cracks = relief.cracks;
        run.puddles = relief.puddles;
        input.notes.push_back(relief.note);
    }
    return input;
}

SimulationTable simulate_physical(const std::vector<Input>& inputs, const SimulateOptions& options)
{
    PhysicalInput input = physical_input(inputs, options);
    std::string checkpoint;
    if (!options.checkpoint.empty()) input.run.checkpoint = &checkpoint;
    SimulationTable table = run_physical(input.read, title_of(inputs), input.run);
    table.notes.insert(table.notes.end(), input.notes.begin(), input.notes.end());
    if (!options.checkpoint.empty()) write_text_file(options.checkpoint, checkpoint);
    return table;
}

std::string fitted_toml(const std::vector<Input>& inputs, const SimulateOptions& options,
                        SimulationTable& said)
{
    const PhysicalInput input = physical_input(inputs, options);
    add_read_report(said, input.read);
    said.notes.insert(said.notes.end(), input.notes.begin(), input.notes.end());
    return fitted_artist_toml(input.read, input.run);
}

}  // namespace petrichor::cli
