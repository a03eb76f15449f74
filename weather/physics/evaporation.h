#ifndef PETRICHOR_WEATHER_PHYSICS_EVAPORATION_H
#define PETRICHOR_WEATHER_PHYSICS_EVAPORATION_H

namespace petrichor::weather {

/// Evaporation from a wet surface when only station data are known (no surface temperature):
/// Penman-Monteith with zero surface resistance (Monteith 1965).
struct PenmanForcing {
    double net_radiation_w_m2 = 0.0;
    double ground_flux_w_m2 = 0.0;  ///< into the ground
    double air_temp_k = 283.15;
    double rel_humidity_pct = 80.0;
    double pressure_pa = 101325.0;
    double wind_m_s = 2.0;                 ///< > 0
    double exchange_coefficient = 3.0e-3;  ///< CH of exchange.h
};
struct PenmanResult {
    double aerodynamic_resistance_s_m = 0.0;
    double latent_w_m2 = 0.0;
    double rate_kg_m2_s = 0.0;
};
PenmanResult penman_monteith(const PenmanForcing& forcing);

}  // namespace petrichor::weather

#endif
