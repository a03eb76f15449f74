#include "cli/simulate/physical.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <toml++/toml.h>

#include "base/error.h"
#include "weather/physics/air.h"
#include "weather/artist/fit.h"
#include "weather/physics/constants.h"
#include "weather/ensemble.h"
#include "weather/mapping.h"
#include "weather/readers/text.h"

namespace petrichor::cli {
namespace {

using weather::Field;

constexpr const char* kColumns[] = {
    "time_s", "air_temp_c", "rel_humidity_pct", "wind_m_s", "pressure_pa", "sw_down_w_m2", "lw_down_w_m2", "cloud_fraction",
    "rain_kg_m2_s", "snowfall_kg_m2_s",
    "snow_depth_m", "swe_kg_m2", "snow_liquid_kg_m2", "snow_density_kg_m3", "snow_temp_c", "snow_albedo", "surface_temp_c",
    "ground_temp_5cm_c", "film_kg_m2", "crack_kg_m2", "puddle_kg_m2", "ice_kg_m2", "film_ice_kg_m2", "crack_ice_kg_m2",
    "puddle_ice_kg_m2",
    "sw_net_w_m2", "lw_net_w_m2", "sensible_w_m2", "latent_w_m2", "ground_heat_w_m2", "melt_w_m2", "runoff_kg_m2",
    "total_precip_kg_m2", "total_evaporation_kg_m2", "total_sublimation_kg_m2", "total_drainage_kg_m2",
    "total_infiltration_kg_m2", "total_melt_kg_m2", "mass_residual_kg_m2", "energy_residual_w_m2",
    "fog_extinction_1_m", "rain_drop_mean_mm",
    "rainfall", "rain", "snowfall", "wetness", "cracks", "puddles", "water_to_snow", "snow",
};

void apply_params(const PhysicalRun& run, PhysicalRun& out)
{
    out = run;
    if (run.fetch_params.empty()) return;
    try {
        const toml::table table = toml::parse(run.fetch_params);
        for (const auto& [key, value] : table) {
            if (key.str() != "site" && key.str() != "artist") {
                throw Error("simulate: --params: unknown table [" + std::string(key.str()) + "]", "Use [site] with the physical model.");
            }
        }
        const toml::table* site = table["site"].as_table();
        if (!site) return;
        const auto number = [&](const toml::node& node, std::string_view key) {
            const auto v = node.value<double>();
            if (!v) throw Error("simulate: --params: site." + std::string(key) + " must be a number", "Write it as in latitude = 45.3.");
            return *v;
        };
        for (const auto& [key, node] : *site) {
            const std::string_view k = key.str();
            if (k == "latitude") out.latitude_deg = run.latitude_deg.value_or(number(node, k));
            else if (k == "longitude") out.longitude_deg = run.longitude_deg.value_or(number(node, k));
            else if (k == "elevation_m") out.elevation_m = run.elevation_m.value_or(number(node, k));
            else if (k == "temp_height_m") out.temp_height_m = run.temp_height_m.value_or(number(node, k));
            else if (k == "wind_height_m") out.wind_height_m = run.wind_height_m.value_or(number(node, k));
            else if (k == "surface") out.surface = node.value<std::string>().value_or("");
            else {
                throw Error("simulate: --params: unknown key site." + std::string(k),
                            "Use latitude, longitude, elevation_m, temp_height_m, wind_height_m or surface.");
            }
        }
    } catch (const toml::parse_error& error) {
        throw Error("simulate: --params line " + std::to_string(error.source().begin.line) + ": " + std::string(error.description()),
                    "Repair the TOML.");
    }
}

weather::PhaseLaw phase_named(const std::string& name)
{
    if (name == "linear") return weather::PhaseLaw::Linear;
    if (name == "humidity") return weather::PhaseLaw::Humidity;
    if (name == "wet-bulb") return weather::PhaseLaw::WetBulb;
    if (name == "threshold") return weather::PhaseLaw::Threshold;
    throw Error("simulate: there is no phase law '" + name + "'", "Use linear, humidity, wet-bulb or threshold.");
}

struct Prepared {
    weather::ReadResult read;
    weather::PhysicalParams params;
};

Prepared prepare(std::string_view text, const PhysicalRun& run)
{
    weather::ReadOptions options;
    options.site.latitude_deg = run.latitude_deg.value_or(weather::kMissing);
    options.site.longitude_deg = run.longitude_deg.value_or(weather::kMissing);
    options.site.elevation_m = run.elevation_m.value_or(weather::kMissing);
    options.station = run.station;
    if (!run.month.empty()) {
        const auto day = weather::us_from_iso(run.month + "-01");
        if (!day) throw Error("simulate: --month must be like 2024-02, got '" + run.month + "'", "Give year and month.");
        const auto civil = weather::civil_from_us(*day);
        options.year = static_cast<int>(civil.year);
        options.month = civil.month;
    }
    Prepared p;
    p.read = weather::read_weather(text, options);
    weather::Site& site = p.read.table.site;
    site.temp_height_m = run.temp_height_m.value_or(site.temp_height_m);
    site.wind_height_m = run.wind_height_m.value_or(site.wind_height_m);
    if (!(site.temp_height_m >= 0.3 && site.temp_height_m <= 200.0) || !(site.wind_height_m >= 0.6 && site.wind_height_m <= 500.0)) {
        throw Error("simulate: sensor heights must be 0.3..200 m (temperature) and 0.6..500 m (wind)",
                    "Set --temp-height-m and --wind-height-m.");
    }
    p.params.surface = weather::surface_preset(run.surface);
    p.params.phase.law = phase_named(run.phase);
    p.params.step_s = run.step_s;
    return p;
}

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> out;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) out.push_back(line);
    return out;
}

std::vector<PlotPanel> panels()
{
    return {
        {"air temperature, C", true, {{"air_temp_c", "air", "#c0392b"}}, 0, 0},
        {"precipitation, kg m-2 s-1", true, {{"rain_kg_m2_s", "rain", "#2471a3"}, {"snowfall_kg_m2_s", "snow", "#7f8c8d"}}, 0, 0},
        {"radiation, W/m2", true, {{"sw_down_w_m2", "sun", "#d68910"}, {"lw_down_w_m2", "sky", "#884ea0"}}, 0, 0},
        {"snow depth, m", false, {{"snow_depth_m", "depth", "#5d6d7e", true}}, 0, 0},
        {"snow water, kg/m2", false, {{"swe_kg_m2", "SWE", "#1f618d"}}, 0, 0},
        {"surface temperature, C", false, {{"surface_temp_c", "surface", "#b03a2e"}}, 0, 0},
        {"water on the ground, kg/m2", false,
         {{"film_kg_m2", "film", "#2e86c1"}, {"crack_kg_m2", "cracks", "#117a65"}, {"puddle_kg_m2", "puddles", "#1a5276"}, {"ice_kg_m2", "ice", "#85929e"}}, 0, 0},
        {"masks", false,
         {{"wetness", "wetness", "#2e86c1"}, {"puddles", "puddles", "#1a5276"}, {"snow", "snow", "#5d6d7e"}, {"water_to_snow", "frozen", "#a569bd"}}, 0, 1},
    };
}

std::vector<double> row_of(const Prepared& p, const weather::CellState& c, const weather::CellState& initial, std::int64_t begin_us,
                           std::int64_t us, double interval_s)
{
    const auto& table = p.read.table;
    const auto at = [&](Field f) { return weather::value_at(table, f, us); };
    const auto d = weather::diagnostics(c);
    const auto masks = weather::weather_masks({}, p.params.surface, c, interval_s);
    const double per_s = 1.0 / interval_s;
    const double visibility = at(Field::Visibility);
    const double rain_mm_h = c.step_rain * per_s * 3600.0;
    return {
        static_cast<double>(us - begin_us) * 1e-6, at(Field::AirTemp) - weather::kZeroCelsiusK, at(Field::RelHumidity), at(Field::Wind),
        at(Field::Pressure), at(Field::Shortwave), at(Field::Longwave), at(Field::Cloud), c.step_rain * per_s, c.step_snow * per_s,
        d.snow_depth_m, d.swe_kg_m2, d.snow_liquid_kg_m2, d.snow_density_kg_m3, d.snow_temp_k - weather::kZeroCelsiusK,
        c.snow_albedo, c.surface_temp_c, c.ground_temp_c[2], c.film, c.crack, c.puddle, d.surface_ice_kg_m2, c.film_ice, c.crack_ice,
        c.puddle_ice, c.flux_shortwave, c.flux_longwave, c.flux_sensible, c.flux_latent, c.flux_ground, c.flux_melt, c.step_runoff,
        c.total_precip, c.total_evaporation, c.total_sublimation, c.total_drainage, c.total_infiltration, c.total_melt,
        weather::mass_balance_kg_m2(c, initial), weather::energy_residual_rms_w_m2(c),
        visibility > 0.0 ? weather::extinction_1_m(visibility, weather::VisibilityKind::Optical5Percent) : 0.0,
        rain_mm_h > 1e-6 ? weather::rain_drops(rain_mm_h).mean_diameter_mm : 0.0,
        masks.rainfall, masks.rain, masks.snowfall, masks.wetness, masks.cracks, masks.puddles, masks.water_to_snow, masks.snow,
    };
}

void add_events(SimulationTable& table)
{
    const auto column = [&](const char* name) {
        return static_cast<std::size_t>(std::find(table.columns.begin(), table.columns.end(), name) - table.columns.begin());
    };
    struct Watch {
        std::size_t column;
        double level;
        const char* rises;
        const char* falls;
    };
    const Watch watches[] = {{column("snow_depth_m"), 0.01, "snow on the ground", "snow gone"},
                             {column("surface_temp_c"), 0.0, "", ""},
                             {column("puddles"), 0.95, "puddles full", ""}};
    for (const Watch& w : watches) {
        for (std::size_t i = 1; i < table.rows.size() && table.events.size() < 400; ++i) {
            const double before = table.rows[i - 1][w.column], now = table.rows[i][w.column];
            if (before <= w.level && now > w.level && *w.rises) table.events.push_back({table.rows[i][0], w.rises});
            if (before > w.level && now <= w.level && *w.falls) table.events.push_back({table.rows[i][0], w.falls});
        }
    }
    std::stable_sort(table.events.begin(), table.events.end(), [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
}

SimulationTable ensemble_table(const Prepared& p, const PhysicalRun& run, SimulationTable table)
{
    weather::EnsembleParams ensemble;
    ensemble.members = run.members;
    ensemble.seed = run.seed;
    ensemble.threads = run.threads;
    const auto every = static_cast<std::size_t>(std::max(1.0, std::round(run.every_s / run.step_s)));
    const auto rows = weather::run_ensemble(p.read.table, p.params, ensemble, every);
    table.columns = {"time_s"};
    for (const char* name : {"snow_depth_m", "swe_kg_m2", "film_kg_m2", "puddle_kg_m2", "surface_temp_c"}) {
        for (const char* share : {"p10", "p50", "p90"}) table.columns.push_back(std::string(name) + "_" + share);
    }
    for (const auto& r : rows) {
        std::vector<double> row{static_cast<double>(r.time_us - rows.front().time_us) * 1e-6};
        for (const double* three : {r.depth_m, r.swe_kg_m2, r.film_kg_m2, r.puddle_kg_m2, r.surface_c}) row.insert(row.end(), three, three + 3);
        table.rows.push_back(std::move(row));
    }
    const auto panel = [](const char* title, const std::string& name) {
        return PlotPanel{title, false, {{name + "_p10", "10 %", "#85c1e9"}, {name + "_p50", "50 %", "#1f618d"}, {name + "_p90", "90 %", "#85c1e9"}}, 0, 0};
    };
    table.panels = {panel("snow depth, m", "snow_depth_m"), panel("snow water, kg/m2", "swe_kg_m2"), panel("film, kg/m2", "film_kg_m2"),
                    panel("puddles, kg/m2", "puddle_kg_m2"), panel("surface temperature, C", "surface_temp_c")};
    table.notes.push_back("ensemble of " + std::to_string(run.members) + " members, seed " + std::to_string(run.seed));
    return table;
}

}  // namespace

SimulationTable run_physical(std::string_view text, const std::string& name, const PhysicalRun& given)
{
    PhysicalRun run;
    apply_params(given, run);
    const Prepared p = prepare(text, run);
    SimulationTable table;
    table.title = name;
    table.model = "physical";
    table.mode = p.params.surface.name;
    table.notes = lines_of(weather::to_text(p.read.report));
    if (run.report_json) *run.report_json = weather::to_json(p.read.report);
    if (run.sensitivity) {
        table.notes.push_back("sensitivity: change, peak SWE kg/m2, snow days, mean film, mean puddle kg/m2, mean surface C");
        for (const auto& s : weather::sensitivity_table(p.read.table, p.params)) {
            char line[160];
            std::snprintf(line, sizeof line, "  %-20s %8.1f %7.1f %8.4f %8.4f %7.2f", s.change.c_str(), s.peak_swe_kg_m2, s.snow_days,
                          s.mean_film_kg_m2, s.mean_puddle_kg_m2, s.mean_surface_c);
            table.notes.emplace_back(line);
        }
    }
    table.utc = true;
    table.utc_start_us = p.read.table.time_us.front();
    if (run.members > 0) return ensemble_table(p, run, std::move(table));

    std::optional<weather::PhysicalTimeline> timeline;
    if (run.resume.empty()) {
        timeline.emplace(p.read.table, p.params);
    } else {
        // "<time in microseconds>\n<state>"
        const auto end = run.resume.find('\n');
        const auto at = end == std::string::npos ? std::nullopt : weather::to_integer(std::string_view(run.resume).substr(0, end));
        if (!at) throw Error("simulate: --resume: this is not a checkpoint of the physical model", "Give a file that --checkpoint wrote.");
        timeline.emplace(p.read.table, p.params, weather::load_state(std::string_view(run.resume).substr(end + 1)), *at);
    }
    const auto every_us = static_cast<std::int64_t>(std::llround(run.every_s * 1e6));
    const std::int64_t origin = p.read.table.time_us.front();
    const std::int64_t end_us = timeline->end_us();
    const auto time_of = [&](double s) { return origin + static_cast<std::int64_t>(std::llround(s * 1e6)); };
    std::int64_t from = std::max(run.from_s ? time_of(*run.from_s) : timeline->begin_us(), timeline->begin_us());
    from = origin + (from - origin + every_us - 1) / every_us * every_us;  // rows at whole multiples
    const std::int64_t to = std::min(run.to_s ? time_of(*run.to_s) : end_us, end_us);
    if (to < from) throw Error("simulate: there is nothing between --from and --to", "Give times inside the file, in seconds from its first row.");
    if ((to - from) / every_us > 20000000) throw Error("simulate: more than 20 million rows", "Use a longer --every.");
    const auto states = timeline->series(from, to, every_us);
    table.columns.assign(std::begin(kColumns), std::end(kColumns));
    const weather::CellState initial = timeline->state_at(timeline->begin_us());
    table.rows.reserve(states.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
        // A row between two steps belongs to a shorter step.
        const std::int64_t us = from + static_cast<std::int64_t>(i) * every_us;
        const double into = std::fmod(static_cast<double>(us - origin) * 1e-6, run.step_s);
        table.rows.push_back(row_of(p, states[i], initial, origin, us, into > 0.0 ? into : run.step_s));
    }
    table.panels = panels();
    add_events(table);
    table.state_hash = weather::state_hash(states.back());
    table.table_hash = weather::state_hash(states);
    if (run.checkpoint) {
        const auto step_us = static_cast<std::int64_t>(std::llround(run.step_s * 1e6));
        const std::int64_t at = to == end_us ? to : origin + (to - origin) / step_us * step_us;
        *run.checkpoint = std::to_string(at) + "\n" + weather::save_state(timeline->state_at(at));
    }
    char books[160];
    std::snprintf(books, sizeof books, "mass closes within %.1e kg/m2 a step, energy within %.4f W/m2 RMS; visibility is the 5 %% optical range",
                  states.back().mass_residual_most, weather::energy_residual_rms_w_m2(states.back()));
    table.notes.emplace_back(books);
    return table;
}

std::string fitted_artist_toml(std::string_view text, const PhysicalRun& given)
{
    PhysicalRun run;
    apply_params(given, run);
    const Prepared p = prepare(text, run);
    const auto fit = weather::fit_artist(p.read.table, p.params);
    std::string out = "# Artist rates fitted to the physical model on " + p.params.surface.name + "; rates per hour, time in seconds.\n[artist]\n";
    char line[200];
    std::snprintf(line, sizeof line, "time_scale = %.17g\n", fit.params.time_scale);
    out += line;
    const auto put = [&](const char* key, double value, const weather::FittedRate& rate) {
        if (rate.hours == 0) std::snprintf(line, sizeof line, "%s = %.9g  # default: nothing in the file tells\n", key, value);
        else std::snprintf(line, sizeof line, "%s = %.9g  # residual %.4f RMS a step, %zu steps\n", key, value, rate.rms_residual, rate.hours);
        out += line;
    };
    put("accumulation_rate_wetness", fit.params.accumulation_rate_wetness, fit.wetness);
    put("accumulation_rate_cracks", fit.params.accumulation_rate_cracks, fit.cracks);
    put("accumulation_rate_puddles", fit.params.accumulation_rate_puddles, fit.puddles);
    put("accumulation_rate_snow", fit.params.accumulation_rate_snow, fit.snow);
    put("evaporation_rate_wetness", fit.params.evaporation_rate_wetness, fit.dry_wetness);
    put("evaporation_rate_cracks", fit.params.evaporation_rate_cracks, fit.dry_cracks);
    put("evaporation_rate_puddles", fit.params.evaporation_rate_puddles, fit.dry_puddles);
    return out;
}

}  // namespace petrichor::cli
