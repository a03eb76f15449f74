#ifndef PETRICHOR_WEATHER_PHYSICS_SURFACE_ENERGY_H
#define PETRICHOR_WEATHER_PHYSICS_SURFACE_ENERGY_H

#include "weather/physics/exchange.h"

namespace petrichor::weather {

/// What reaches a surface point. Fluxes toward the surface are positive.
struct SurfaceForcing {
    double shortwave_w_m2 = 0.0;
    double longwave_w_m2 = 300.0;
    double air_temp_k = 283.15;
    double rel_humidity_pct = 80.0;
    double wind_m_s = 2.0;
    double pressure_pa = 101325.0;
    double rain_kg_m2_s = 0.0;
};
struct SurfaceSkin {
    double albedo = 0.2;
    double emissivity = 0.98;
    double roughness_m = 0.01;
    double wet_fraction = 1.0;        ///< beta: share that evaporates, 0..1
    bool icy = false;                 ///< vapour over ice and heat of sublimation, else over water
    double conductance_w_m2_k = 0.0;  ///< G0, to the first layer below
    double below_temp_k = 273.15;     ///< T1
    double wind_height_m = 10.0;
    double temp_height_m = 2.0;
    double gravity_across = 1.0;  ///< cosine of the tilt: 1 level, 0 a wall, -1 a ceiling
};
/// Fluxes at a surface temperature; sensible and latent are positive upward (a loss).
struct SurfaceFluxes {
    double surface_temp_k = 273.15;
    double net_radiation_w_m2 = 0.0;
    double sensible_w_m2 = 0.0;
    double latent_w_m2 = 0.0;
    double vapour_kg_m2_s = 0.0;
    double ground_w_m2 = 0.0;  ///< into the ground
    double rain_heat_w_m2 = 0.0;
    double balance_w_m2 = 0.0;  ///< F: what is left to melt ice or to heat the surface
};

/// The balance F(Ts) of the surface at a given temperature.
///   source  Essery 2015 (form), Louis 1979 (exchange)
SurfaceFluxes surface_balance(const SurfaceForcing& forcing, const SurfaceSkin& skin,
                              const ExchangeParams& exchange, double surface_temp_k);

/// Temperature at which the balance is zero, by exactly three Newton steps from `first_guess_k`;
/// the fluxes there. balance_w_m2 is the residual.
SurfaceFluxes solve_surface(const SurfaceForcing& forcing, const SurfaceSkin& skin,
                            const ExchangeParams& exchange, double first_guess_k);

}  // namespace petrichor::weather

#endif
