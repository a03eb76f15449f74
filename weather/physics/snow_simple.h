#ifndef PETRICHOR_WEATHER_PHYSICS_SNOW_SIMPLE_H
#define PETRICHOR_WEATHER_PHYSICS_SNOW_SIMPLE_H

namespace petrichor::weather {

// Snow from temperature and precipitation alone: for users without radiation, and as the plain
// model that the energy balance is compared with. Also small laws about snow that the cell does not
// step.

struct DegreeDayParams {
    double melt_kg_m2_k_day = 3.0;  ///< 2..6
    double all_snow_k = 273.15;
    double all_rain_k = 275.15;
};
/// Integral of max(0, T) over dt, T going linearly between two temperatures; K s.
double positive_degree_seconds(double from_k, double to_k, double dt_s);
/// Melt that a linear temperature segment could do, kg/m2.
double degree_day_melt_kg_m2(double from_k, double to_k, double dt_s, double melt_kg_m2_k_day);
/// Melt rate from temperature and absorbed shortwave, kg m-2 h-1; 0 at or below 1 C (Pellicciotti
/// 2005).
double radiation_melt_kg_m2_h(double temp_k, double albedo, double shortwave_w_m2);

/// Wind at 10 m above which dry (or wet) snow drifts, m/s; Li & Pomeroy 1997.
double drift_threshold_m_s(double temp_k, bool wet_snow);

/// Snow caught by branches during a step, kg/m2: (Imax - I0)(1 - exp(-s/Imax)), Imax = 4.4 VAI.
double canopy_interception_kg_m2(double held_kg_m2, double snowfall_kg_m2,
                                 double vegetation_area_index);
/// Snow that falls off branches during a step, kg/m2: e-folding 240 h cold, 2.4 h melting.
double canopy_unloading_kg_m2(double held_kg_m2, double dt_s, bool melting);

}  // namespace petrichor::weather

#endif
