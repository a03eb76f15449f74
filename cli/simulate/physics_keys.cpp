#include "cli/simulate/physics_keys.h"

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "base/error.h"
#include "base/words.h"
#include "weather/physics/constants.h"
#include "weather/readers/metro_xml.h"
#include "weather/readers/text.h"

namespace petrichor::cli {
namespace {

using weather::PhysicalParams;

struct Key {
    const char* name;
    double* (*of)(PhysicalParams&);
    double shift = 0.0;  // added to what is given: C to K
};

// Plain constants. What is not a double stands in set_special.
const Key kKeys[] = {
    {"surface.albedo_dry", [](PhysicalParams& p) { return &p.surface.albedo_dry; }},
    {"surface.albedo_wet", [](PhysicalParams& p) { return &p.surface.albedo_wet; }},
    {"surface.emissivity", [](PhysicalParams& p) { return &p.surface.emissivity; }},
    {"surface.roughness_m", [](PhysicalParams& p) { return &p.surface.roughness_m; }},
    {"surface.heat_roughness_share",
     [](PhysicalParams& p) { return &p.surface.heat_roughness_share; }},
    {"surface.salt_loss_1_h", [](PhysicalParams& p) { return &p.surface.salt_loss_1_h; }},
    {"surface.leaf_width_m", [](PhysicalParams& p) { return &p.surface.leaf_width_m; }},
    {"surface.film_capacity_kg_m2",
     [](PhysicalParams& p) { return &p.surface.film_capacity_kg_m2; }},
    {"surface.film_rate_1_s", [](PhysicalParams& p) { return &p.surface.film_rate_1_s; }},
    {"surface.film_full_kg_m2", [](PhysicalParams& p) { return &p.surface.film_full_kg_m2; }},
    {"surface.slush_rate_1_s", [](PhysicalParams& p) { return &p.surface.slush_rate_1_s; }},
    {"surface.infiltration_first_mm_h",
     [](PhysicalParams& p) { return &p.surface.infiltration.first_mm_h; }},
    {"surface.infiltration_last_mm_h",
     [](PhysicalParams& p) { return &p.surface.infiltration.last_mm_h; }},
    {"surface.infiltration_decay_1_h",
     [](PhysicalParams& p) { return &p.surface.infiltration.decay_1_h; }},
    {"surface.infiltration_recovery_1_h",
     [](PhysicalParams& p) { return &p.surface.infiltration.recovery_1_h; }},
    {"surface.conductivity_w_m_k", [](PhysicalParams& p) { return &p.surface.conductivity_w_m_k; }},
    {"surface.heat_capacity_j_m3_k",
     [](PhysicalParams& p) { return &p.surface.heat_capacity_j_m3_k; }},
    {"surface.traffic_loss_1_h", [](PhysicalParams& p) { return &p.surface.traffic_loss_1_h; }},
    {"surface.traffic_wind_m_s", [](PhysicalParams& p) { return &p.surface.traffic_wind_m_s; }},
    {"surface.traffic_heat_w_m2", [](PhysicalParams& p) { return &p.surface.traffic_heat_w_m2; }},
    {"surface.snow_clearing_1_h", [](PhysicalParams& p) { return &p.surface.snow_clearing_1_h; }},
    {"snow.constant_density_kg_m3",
     [](PhysicalParams& p) { return &p.snow.constant_density_kg_m3; }},
    {"snow.new_density_factor", [](PhysicalParams& p) { return &p.snow.new_density_factor; }},
    {"snow.viscosity_pa_s", [](PhysicalParams& p) { return &p.snow.viscosity_pa_s; }},
    {"snow.viscosity_density_m3_kg",
     [](PhysicalParams& p) { return &p.snow.viscosity_density_m3_kg; }},
    {"snow.viscosity_wetness", [](PhysicalParams& p) { return &p.snow.viscosity_wetness; }},
    {"snow.albedo_max", [](PhysicalParams& p) { return &p.snow.albedo_max; }},
    {"snow.albedo_min", [](PhysicalParams& p) { return &p.snow.albedo_min; }},
    {"snow.albedo_cold_h", [](PhysicalParams& p) { return &p.snow.albedo_cold_h; }},
    {"snow.albedo_melting_h", [](PhysicalParams& p) { return &p.snow.albedo_melting_h; }},
    {"snow.albedo_refresh_kg_m2", [](PhysicalParams& p) { return &p.snow.albedo_refresh_kg_m2; }},
    {"snow.irreducible_water", [](PhysicalParams& p) { return &p.snow.irreducible_water; }},
    {"snow.cover_depth_m", [](PhysicalParams& p) { return &p.snow.cover_depth_m; }},
    {"snow.roughness_m", [](PhysicalParams& p) { return &p.snow.roughness_m; }},
    {"snow.emissivity", [](PhysicalParams& p) { return &p.snow.emissivity; }},
    {"exchange.max_richardson", [](PhysicalParams& p) { return &p.exchange.max_richardson; }},
    {"exchange.min_wind_m_s", [](PhysicalParams& p) { return &p.exchange.min_wind_m_s; }},
    {"exchange.max_unstable", [](PhysicalParams& p) { return &p.exchange.max_unstable; }},
    {"exchange.rain_heat", [](PhysicalParams& p) { return &p.exchange.rain_heat; }},
    {"phase.all_snow_c", [](PhysicalParams& p) { return &p.phase.all_snow_k; },
     weather::kZeroCelsiusK},
    {"phase.all_rain_c", [](PhysicalParams& p) { return &p.phase.all_rain_k; },
     weather::kZeroCelsiusK},
    {"phase.threshold_c", [](PhysicalParams& p) { return &p.phase.threshold_k; },
     weather::kZeroCelsiusK},
    {"model.deep_temp_c", [](PhysicalParams& p) { return &p.deep_temp_k; }, weather::kZeroCelsiusK},
    {"model.precip_factor", [](PhysicalParams& p) { return &p.precip_factor; }},
    {"model.sky_view", [](PhysicalParams& p) { return &p.sky_view; }},
    {"model.canopy_vai", [](PhysicalParams& p) { return &p.canopy_vai; }},
    {"model.substep_s", [](PhysicalParams& p) { return &p.substep_s; }},
};

// What is not one number of the model.
bool set_special(const std::string& name, double value, PhysicalParams& params)
{
    if (name == "surface.crack_depth_mm")
        params.surface.cracks = weather::uniform_hypsometry(value);
    else if (name == "surface.puddle_depth_mm")
        params.surface.puddles = weather::uniform_hypsometry(value);
    else if (name == "surface.open_below")
        params.surface.open_below = value != 0.0;
    else if (name == "snow.max_layers" && value >= 1.0 && value <= 100.0)
        params.snow.max_layers = static_cast<int>(value);
    else
        return false;
    return true;
}
constexpr const char* kSpecial[] = {"surface.crack_depth_mm", "surface.puddle_depth_mm",
                                    "surface.open_below", "snow.max_layers"};

void set(const std::string& name, double value, PhysicalParams& params)
{
    for (const Key& key : kKeys) {
        if (name != key.name) continue;
        *key.of(params) = value + key.shift;
        return;
    }
    if (set_special(name, value, params)) return;
    std::vector<std::string> names(std::begin(kSpecial), std::end(kSpecial));
    for (const Key& key : kKeys) names.emplace_back(key.name);
    throw Error("physics: there is no constant '" + name + "'",
                "Use one of: " + join_words(names, ", ") + ".");
}

double number_in(const toml::node& node, const std::string& name)
{
    if (const auto value = node.value<double>()) return *value;
    if (const auto flag = node.value<bool>()) return *flag ? 1.0 : 0.0;
    throw Error("physics: " + name + " is not a number", "Write " + name + " = 0.5, for example.");
}

void read_layers(const toml::node& node, PhysicalParams& params)
{
    const toml::array* layers = node.as_array();
    std::vector<weather::GroundLayer> read;
    for (std::size_t i = 0; layers && i < layers->size(); ++i) {
        const toml::table* one = (*layers)[i].as_table();
        if (!one) {
            layers = nullptr;
            break;
        }
        weather::GroundLayer layer;
        for (const auto& [key, value] : *one) {
            const std::string name(key.str());
            double* to = name == "thickness_m"            ? &layer.thickness_m
                         : name == "conductivity_w_m_k"   ? &layer.conductivity_w_m_k
                         : name == "heat_capacity_j_m3_k" ? &layer.heat_capacity_j_m3_k
                                                          : nullptr;
            if (!to)
                throw Error("physics: a layer has no '" + name + "'",
                            "Use thickness_m, conductivity_w_m_k and heat_capacity_j_m3_k.");
            *to = number_in(value, "surface.layers." + name);
        }
        read.push_back(layer);
    }
    if (!layers)
        throw Error("physics: surface.layers is not a list of tables",
                    "Write layers = [{thickness_m = 0.2, conductivity_w_m_k = 0.8}].");
    params.surface.layers = std::move(read);
}

}  // namespace

void apply_physics_toml(const std::string& text, const std::string& file, PhysicalParams& params)
{
    toml::table whole;
    try {
        whole = toml::parse(text, file);
    } catch (const toml::parse_error& e) {
        std::ostringstream where;
        where << file << " line " << e.source().begin.line << ": " << e.description();
        throw Error("physics: " + where.str(), "Repair the TOML file.");
    }
    for (const auto& [table, node] : whole) {
        const toml::table* inner = node.as_table();
        if (!inner)
            throw Error("physics: '" + std::string(table.str()) + "' stands outside a table",
                        "Put constants into [surface], [snow], [exchange], [phase] or [model].");
        for (const auto& [key, value] : *inner) {
            const std::string name = std::string(table.str()) + "." + std::string(key.str());
            if (name == "surface.layers")
                read_layers(value, params);
            else
                set(name, number_in(value, name), params);
        }
    }
}

void apply_physics_setting(const std::string& setting, PhysicalParams& params)
{
    const std::size_t equals = setting.find('=');
    const auto value = equals == std::string::npos
                           ? std::nullopt
                           : weather::to_number(std::string_view(setting).substr(equals + 1));
    if (!value)
        throw Error("physics: --set '" + setting + "' is not NAME=NUMBER",
                    "Write --set snow.albedo_min=0.45; --list-physics shows all names.");
    set(std::string(weather::trimmed(std::string_view(setting).substr(0, equals))), *value, params);
}

void apply_layers(const std::string& text, PhysicalParams& params)
{
    params.surface.layers.clear();
    for (const std::string_view part : weather::split(text, ',', 100)) {
        const std::size_t colon = part.find(':');
        const auto thickness = colon == std::string_view::npos
                                   ? std::nullopt
                                   : weather::to_number(part.substr(colon + 1));
        const auto layer =
            weather::road_layer(part.substr(0, colon), thickness.value_or(weather::kMissing));
        if (!thickness || !layer)
            throw Error("physics: --layers '" + std::string(part) + "' is not MATERIAL:METRES",
                        "Use asphalt, concrete, gravel or sand, as in asphalt:0.2,gravel:0.4.");
        params.surface.layers.push_back(*layer);
    }
}

std::string physics_listing(const PhysicalParams& params)
{
    PhysicalParams copy = params;
    std::string out;
    char line[120];
    for (const Key& key : kKeys) {
        const double value = *key.of(copy) - key.shift;
        if (std::isnan(value))
            std::snprintf(line, sizeof line, "%-36s from the file\n", key.name);
        else
            std::snprintf(line, sizeof line, "%-36s %.6g\n", key.name, value);
        out += line;
    }
    std::snprintf(line, sizeof line, "%-36s %d\n", "snow.max_layers", copy.snow.max_layers);
    out += line;
    std::snprintf(line, sizeof line, "%-36s %.6g\n", "surface.crack_depth_mm",
                  copy.surface.cracks.depth_mm);
    out += line;
    std::snprintf(line, sizeof line, "%-36s %.6g\n", "surface.puddle_depth_mm",
                  copy.surface.puddles.depth_mm);
    out += line;
    std::snprintf(line, sizeof line, "%-36s %d\n", "surface.open_below",
                  copy.surface.open_below ? 1 : 0);
    out += line;
    for (const weather::GroundLayer& layer : copy.surface.layers) {
        std::snprintf(line, sizeof line, "%-36s %.6g m, %.6g W/m/K, %.6g J/m3/K\n",
                      "surface.layers", layer.thickness_m, layer.conductivity_w_m_k,
                      layer.heat_capacity_j_m3_k);
        out += line;
    }
    return out;
}

}  // namespace petrichor::cli
