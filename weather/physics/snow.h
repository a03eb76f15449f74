#ifndef PETRICHOR_WEATHER_PHYSICS_SNOW_H
#define PETRICHOR_WEATHER_PHYSICS_SNOW_H

namespace petrichor::weather {

enum class NewSnowDensity {
    Pahaut,           ///< max(50, 109 + 6 T + 26 sqrt(U)); Pahaut 1976, as in Crocus
    HedstromPomeroy,  ///< 67.92 + 51.25 exp(T / 2.59), T <= 0; Hedstrom & Pomeroy 1998
    Constant,         ///< constant_density_kg_m3
};
enum class Settling {
    Overburden,   ///< weight against viscosity, and crystals breaking down; Anderson 1976
    Exponential,  ///< towards a cold or a melting limit, e-folding 200 h
};

/// A snow pack of 1 to 3 layers. Defaults are those of the literature named, for any site.
struct SnowParams {
    int max_layers =
        3;  ///< 1..3; layers of 0.1 and 0.2 m from the top where the pack is deep enough
    NewSnowDensity new_density = NewSnowDensity::Pahaut;
    double constant_density_kg_m3 = 100.0;
    Settling settling = Settling::Overburden;
    double albedo_max = 0.85;            ///< fresh snow
    double albedo_min = 0.5;             ///< old snow
    double albedo_cold_h = 1000.0;       ///< decay of cold snow (Verseghy 1991)
    double albedo_melting_h = 100.0;     ///< decay of melting snow
    double albedo_refresh_kg_m2 = 10.0;  ///< snowfall that renews 1 - 1/e of the albedo
    double irreducible_water = 0.03;     ///< of the pores, held against gravity
    double cover_depth_m = 0.1;          ///< cover fraction tanh(D / this) for albedo and roughness
    double roughness_m = 0.003;  ///< middle (geometric) of the 0.001..0.01 m measured over snow
    double emissivity = 0.98;
};

// The laws of the pack, one by one. Temperatures in kelvin, densities in kg/m3.

double new_snow_density_pahaut(double air_temp_k, double wind_m_s);
double new_snow_density_hedstrom_pomeroy(double air_temp_k);

/// Density after dt of exponential settling towards the limit; unchanged above it.
double settled_density(double density, double limit, double dt_s);
/// Albedo after dt of ageing.
double aged_albedo(const SnowParams& params, double albedo, double dt_s, bool melting);
/// Albedo after snowfall.
double refreshed_albedo(const SnowParams& params, double albedo, double snowfall_kg_m2);

/// 2.22 (rho/917)^1.88, W m-1 K-1 (Yen 1981).
double snow_conductivity(double density);
/// J/m2 that would warm the ice to the melting point, >= 0.
double cold_content_j_m2(double ice_kg_m2, double temp_k);
/// Liquid held against gravity: 1000 wirr (D - I/917), kg/m2.
double liquid_capacity_kg_m2(const SnowParams& params, double depth_m, double ice_kg_m2);
/// Melt of a flux over a time, kg/m2.
double melt_kg_m2(double flux_w_m2, double dt_s);
/// Share of the ground that snow of a depth hides, 0..1.
double snow_cover_fraction(const SnowParams& params, double depth_m);

}  // namespace petrichor::weather

#endif
