#include "cli/simulate/physical_table.h"

#include <algorithm>
#include <cmath>

#include "cli/report/plot_axes.h"
#include "weather/models/physical/mapping.h"
#include "weather/physics/air.h"
#include "weather/physics/brine.h"
#include "weather/physics/constants.h"
#include "weather/physics/friction.h"

namespace petrichor::cli {
namespace {

using weather::Field;

constexpr const char* kColumns[] = {
    "time_s",
    "air_temp_c",
    "rel_humidity_pct",
    "wind_m_s",
    "pressure_pa",
    "sw_down_w_m2",
    "lw_down_w_m2",
    "cloud_fraction",
    "rain_kg_m2_s",
    "snowfall_kg_m2_s",
    "snow_depth_m",
    "swe_kg_m2",
    "snow_liquid_kg_m2",
    "snow_density_kg_m3",
    "snow_temp_c",
    "snow_albedo",
    "canopy_snow_kg_m2",
    "surface_temp_c",
    "ground_temp_5cm_c",
    "film_kg_m2",
    "crack_kg_m2",
    "puddle_kg_m2",
    "ice_kg_m2",
    "film_ice_kg_m2",
    "crack_ice_kg_m2",
    "puddle_ice_kg_m2",
    "slush",
    "sw_net_w_m2",
    "lw_net_w_m2",
    "sensible_w_m2",
    "latent_w_m2",
    "ground_heat_w_m2",
    "melt_w_m2",
    "runoff_kg_m2",
    "total_precip_kg_m2",
    "total_evaporation_kg_m2",
    "total_sublimation_kg_m2",
    "total_drainage_kg_m2",
    "total_infiltration_kg_m2",
    "total_melt_kg_m2",
    "mass_residual_kg_m2",
    "energy_residual_w_m2",
    "fog_extinction_1_m",
    "rain_drop_mean_mm",
    "rainfall",
    "rain",
    "snowfall",
    "wetness",
    "cracks",
    "puddles",
    "water_to_snow",
    "snow",
    "wheel_friction",
    "glaze_mm",
    "road_condition",
    "black_ice",
    "salt_g_m2",
    "freezing_point_c",
};

// Files say -14.9 C and 3 tenths; kelvin or shares and back must not make it -14.899999999999977 and
// 0.30000000000000004.
double to_nine_digits(double value)
{
    return std::round(value * 1e9) / 1e9;
}
double to_celsius(double kelvin)
{
    return to_nine_digits(kelvin - weather::kZeroCelsiusK);
}

PlotSeries line(const char* column, const char* label, const char* color, double scale = 1.0)
{
    return {.column = column, .label = label, .color = color, .scale = scale};
}
PlotSeries area(const char* column, const char* label, const char* color, double scale = 1.0)
{
    return {.column = column, .label = label, .color = color, .filled = true, .scale = scale};
}
PlotSeries rate(const char* column, const char* label, const char* color, double scale)
{
    PlotSeries series = area(column, label, color, scale);
    series.steps = true;
    return series;
}

}  // namespace

const std::vector<std::string>& physical_columns()
{
    static const std::vector<std::string> kNames(std::begin(kColumns), std::end(kColumns));
    return kNames;
}

std::vector<double> physical_row(const weather::ForcingTable& table,
                                 const weather::Surface& surface, const weather::CellState& c,
                                 const weather::CellState& initial, std::int64_t us,
                                 double interval_s)
{
    const auto at = [&](Field f) { return weather::value_at(table, f, us); };
    const auto d = weather::diagnostics(c);
    const bool slush = weather::cover_of(c, surface.film_capacity_kg_m2) == weather::Cover::Slush;
    const auto masks = weather::weather_masks({}, surface, c, interval_s);
    const double per_s = 1.0 / interval_s;
    const double visibility = at(Field::Visibility);
    const double rain_mm_h = c.step_rain * per_s * 3600.0;
    return {
        static_cast<double>(us - table.time_us.front()) * 1e-6,
        to_celsius(at(Field::AirTemp)),
        at(Field::RelHumidity),
        at(Field::Wind),
        at(Field::Pressure),
        at(Field::Shortwave),
        at(Field::Longwave),
        to_nine_digits(at(Field::Cloud)),
        c.step_rain * per_s,
        c.step_snow * per_s,
        d.snow_depth_m,
        d.swe_kg_m2,
        d.snow_liquid_kg_m2,
        d.snow_density_kg_m3,
        to_celsius(d.snow_temp_k),
        c.snow_albedo,
        c.canopy_snow,
        c.surface_temp_c,
        c.ground_temp_c[2],
        c.film,
        c.crack,
        c.puddle,
        d.surface_ice_kg_m2,
        c.film_ice,
        c.crack_ice,
        c.puddle_ice,
        slush ? 1.0 : 0.0,
        c.flux_shortwave,
        c.flux_longwave,
        c.flux_sensible,
        c.flux_latent,
        c.flux_ground,
        c.flux_melt,
        c.step_runoff,
        c.total_precip,
        c.total_evaporation,
        c.total_sublimation,
        c.total_drainage,
        c.total_infiltration,
        c.total_melt,
        weather::mass_balance_kg_m2(c, initial),
        weather::energy_residual_rms_w_m2(c),
        visibility > 0.0
            ? weather::extinction_1_m(visibility, weather::VisibilityKind::Optical5Percent)
            : 0.0,
        rain_mm_h > 1e-6 ? weather::rain_drops(rain_mm_h).mean_diameter_mm : 0.0,
        masks.rainfall,
        masks.rain,
        masks.snowfall,
        masks.wetness,
        masks.cracks,
        masks.puddles,
        masks.water_to_snow,
        masks.snow,
        weather::wheel_friction(c),
        weather::glaze_mm(c),
        static_cast<double>(weather::road_condition(c)),
        weather::black_ice(c) ? 1.0 : 0.0,
        1e3 * c.salt,
        weather::freezing_point_c(c.salt, c.film + c.crack + c.puddle),
    };
}

std::vector<PlotPanel> physical_panels()
{
    const auto free = [](const char* title, const char* group, std::vector<PlotSeries> series,
                         bool forcing = false) {
        return PlotPanel{.title = title,
                         .forcing = forcing,
                         .series = std::move(series),
                         .low = 0.0,
                         .high = 0.0,
                         .group = group};
    };
    const auto unit = [](const char* title, const char* group, std::vector<PlotSeries> series) {
        return PlotPanel{.title = title, .series = std::move(series), .group = group};
    };
    return {
        free("air temperature, \u00b0C", "weather", {line("air_temp_c", "", "#c8442e")}, true),
        free("precipitation, mm/h", "weather",
             {rate("rain_kg_m2_s", "rain", "#1d5fc1", 3600.0),
              rate("snowfall_kg_m2_s", "snow", "#56b4e9", 3600.0)},
             true),
        free("radiation, W/m\u00b2", "heat",
             {line("sw_down_w_m2", "sun", "#e09c14"), line("lw_down_w_m2", "sky", "#8450b0")},
             true),
        free("snow depth, m", "snow", {area("snow_depth_m", "model", "#4a80bd")}),
        free("snow water equivalent, kg/m\u00b2", "snow", {line("swe_kg_m2", "model", "#1f5f9e")}),
        unit("snow albedo, 0..1", "albedo",
             {{.column = "snow_albedo",
               .label = "model",
               .color = "#8a6d3b",
               .only_where = "snow_depth_m",
               .only_above = 0.001}}),
        free("surface temperature, \u00b0C", "heat", {line("surface_temp_c", "model", "#c8442e")}),
        free("water on the ground, kg/m\u00b2", "water",
             {line("film_kg_m2", "film", "#0e9f8e"), line("crack_kg_m2", "cracks", "#d55e00"),
              line("puddle_kg_m2", "puddles", "#2456c4"), line("ice_kg_m2", "ice", "#56b4e9")}),
        unit("water masks, 0..1", "masks",
             {line("wetness", "wetness", "#0e9f8e"), line("cracks", "cracks", "#d55e00"),
              line("puddles", "puddles", "#2456c4")}),
        unit("snow masks, 0..1", "masks",
             {area("snow", "snow", "#4a80bd"), line("water_to_snow", "frozen", "#d97706")}),
    };
}

std::vector<PlotPanel> road_panels()
{
    return {{.title = "wheel friction, 0..1",
             .series = {line("wheel_friction", "", "#444c56")},
             .group = "road"},
            {.title = "salt, g/m\u00b2",
             .series = {area("salt_g_m2", "", "#b08900")},
             .low = 0.0,
             .high = 0.0,
             .group = "road"}};
}

void add_physical_events(SimulationTable& table)
{
    const auto column = [&](const char* name) { return column_index(table, name); };
    struct Watch {
        std::size_t column;
        double level;
        const char* rises;
        const char* falls;
    };
    const Watch watches[] = {{column("snow_depth_m"), 0.01, "snow on the ground", "snow gone"},
                             {column("puddles"), 0.95, "puddles full", ""},
                             {column("ice_kg_m2"), 0.1, "ice on the ground", "ice gone"}};
    for (const Watch& w : watches) {
        for (std::size_t i = 1; i < table.rows.size() && table.events.size() < 400; ++i) {
            const double before = table.rows[i - 1][w.column], now = table.rows[i][w.column];
            if (before <= w.level && now > w.level && *w.rises)
                table.events.push_back({table.rows[i][0], w.rises});
            if (before > w.level && now <= w.level && *w.falls)
                table.events.push_back({table.rows[i][0], w.falls});
        }
    }
    std::stable_sort(table.events.begin(), table.events.end(),
                     [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
}

}  // namespace petrichor::cli
