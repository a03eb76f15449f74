#ifndef PETRICHOR_CLI_SIMULATE_PHYSICS_KEYS_H
#define PETRICHOR_CLI_SIMULATE_PHYSICS_KEYS_H

#include <string>
#include <vector>

#include "weather/models/physical/physical.h"

namespace petrichor::cli {

/// Every constant of the physical model by its name, as in a TOML file ("snow.albedo_min" is
/// albedo_min of the table [snow]) and after --set. Temperatures in C.
///
///   [surface]   albedo_dry, roughness_m, traffic_heat_w_m2, .. and layers, from the top:
///               layers = [{thickness_m = 0.2, conductivity_w_m_k = 0.8, heat_capacity_j_m3_k =
///               2.1e6}, ..]
///   [snow], [exchange], [phase], [model]
///
/// Sets what the text names and leaves the rest.
///   throws  Error for a key that does not exist (names the nearest), a value that is not a number,
///           or a text that is not TOML; ranges are checked by the model
void apply_physics_toml(const std::string& text, const std::string& file,
                        weather::PhysicalParams& params);
/// "snow.albedo_min=0.45".
void apply_physics_setting(const std::string& setting, weather::PhysicalParams& params);
/// "asphalt:0.2,gravel:0.4": materials of METRo with their thickness in metres, from the top.
void apply_layers(const std::string& text, weather::PhysicalParams& params);

/// A line a key with its value in `params`, for --list-physics.
std::string physics_listing(const weather::PhysicalParams& params);

}  // namespace petrichor::cli

#endif
