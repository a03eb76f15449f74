#ifndef PETRICHOR_WEATHER_PHYSICS_SURFACES_H
#define PETRICHOR_WEATHER_PHYSICS_SURFACES_H

#include <string>
#include <string_view>
#include <vector>

#include "weather/physics/drainage.h"
#include "weather/physics/ground.h"
#include "weather/physics/stores.h"

namespace petrichor::weather {

/// What a surface is made of, as far as weather is concerned.
struct Surface {
    std::string name = "asphalt";
    double albedo_dry = 0.12;
    double albedo_wet = 0.08;
    double emissivity = 0.95;
    double roughness_m = 0.005;        ///< aerodynamic, z0
    double heat_roughness_share = 0.1;  ///< z0h / z0, of heat and vapour
    double film_capacity_kg_m2 = 0.4;  ///< held by pores and texture before it runs, > 0
    double film_rate_1_s = 0.003;      ///< drainage above the capacity, > 0
    /// Covers all of the ground: thinner films leave the tops of stones dry. The capacity where that is more.
    double film_full_kg_m2 = 1.0;
    /// The same under snow and in slush, > 0. METRo takes 0.0003; then the film under melting snow
    /// is up to 0.016 kg/m2 (root mean square of a rough year) from steps of a minute, not 0.010.
    double slush_rate_1_s = 0.003;
    Hypsometry cracks = {1.5, {}, {}};
    Hypsometry puddles = {15.0, {}, {}};
    HortonParams infiltration;
    /// From the top: asphalt, concrete, sand, ..; below them the ground of the next two values.
    std::vector<GroundLayer> layers{};
    bool open_below = false;  ///< a bridge: air below the layers, or below 0.3 m of the ground
    double conductivity_w_m_k = 0.75;      ///< of the ground
    double heat_capacity_j_m3_k = 1.94e6;  ///< of the ground
    double traffic_loss_1_h = 0.0;  ///< film sprayed away by vehicles, 0.1..1.5 on roads in use
    double traffic_wind_m_s = 0.0;  ///< wind is raised to this by day, to 0.27 of it by night
    /// Snow that wheels and ploughs throw off the road; METRo takes 1.08 (0.0003 1/s).
    double snow_clearing_1_h = 0.0;
    double traffic_heat_w_m2 = 0.0;  ///< of tyres, engines and what lies below; METRo takes 10
    double salt_loss_1_h = 0.0;      ///< salt that wheels throw off, wet or dry; 0 without traffic
    /// > 0: leaves and blades of that width, which give heat and vapour to the air on both sides besides, as plates
    /// in the wind of their place (leaf_exchange); 0: none.
    double leaf_width_m = 0.0;
};

/// Presets: asphalt, concrete, paving_stones, cobblestone, brick, soil, sand, gravel, grass,
/// lawn (grass with a skin of blades), roof_metal, roof_tile, wood, rock; road (asphalt in use:
/// crowned, ploughed, warmed by traffic) and bridge (the same over air). Each value is a default to start from, not a measurement.
const std::vector<Surface>& surface_presets();

/// Preset by name; spaces, hyphens and letter case do not matter.
///   throws  Error that lists the names
Surface surface_preset(std::string_view name);

/// Throws Error that names the field when a value cannot be used.
void check_surface(const Surface& surface);

}  // namespace petrichor::weather

#endif
