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
    /// On Pahaut's law. Fitted: ten winters of Col de Porte together (docs/weather.md).
    double new_density_factor = 1.1;
    Settling settling = Settling::Overburden;
    double viscosity_pa_s = 3.7e7;  ///< at 0 kg/m3 and 0 C (Anderson 1976)
    /// Growth of its logarithm with density. 0.018 in the reference, 0.016 to 0.023 in the
    /// literature; fitted as new_density_factor.
    double viscosity_density_m3_kg = 0.0165;
    /// Water makes snow soft: viscosity / (1 + this x liquid volume fraction) (Vionnet et al.
    /// 2012).
    double viscosity_wetness = 60.0;
    double albedo_max = 0.85;            ///< fresh snow
    double albedo_min = 0.5;             ///< old snow
    double albedo_cold_h = 1000.0;       ///< decay of cold snow (Verseghy 1991)
    double albedo_melting_h = 100.0;     ///< decay of melting snow
    double albedo_refresh_kg_m2 = 10.0;  ///< snowfall that renews 1 - 1/e of the albedo
    /// Of the pores, held against gravity: 0.02 to 0.05 measured (Crocus 0.05, FSM2 0.03).
    double irreducible_water = 0.04;
    /// Cover fraction tanh(D / this) for albedo and roughness: even ground such as roads and mown
    /// meadows; 0.1 for rough terrain.
    double cover_depth_m = 0.03;
    double roughness_m = 0.003;  ///< middle (geometric) of the 0.001..0.01 m measured over snow
    double emissivity = 0.98;
};

// The laws of the pack, one by one. Temperatures in kelvin, densities in kg/m3.

double new_snow_density_pahaut(double air_temp_k, double wind_m_s);
double new_snow_density_hedstrom_pomeroy(double air_temp_k);

/// Density after dt of exponential settling towards the limit; unchanged above it.
double settled_density(double density, double limit, double dt_s);
/// Rate of compaction under `load_kg_m2`, kg m-3 s-1: rho g load / eta plus the breaking down of
/// crystals 2.8e-6 rho exp((T - Tm)/23.8 - max(rho-150, 0)/21.7) (Anderson 1976).
///   eta  viscosity_pa_s exp(0.081 (Tm - T) + viscosity_density rho) / (1 + viscosity_wetness wet)
///   wet  liquid water, m3 a m3
double compaction_rate(const SnowParams& params, double density, double load_kg_m2, double temp_k,
                       double wet);

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
