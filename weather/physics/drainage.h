#ifndef PETRICHOR_WEATHER_PHYSICS_DRAINAGE_H
#define PETRICHOR_WEATHER_PHYSICS_DRAINAGE_H

namespace petrichor::weather {

/// Film of water over a step: dw/dt = net - rate max(0, w - threshold), solved exactly.
struct FilmStep {
    double water_kg_m2 = 0.0;    ///< at the end, >= 0
    double drained_kg_m2 = 0.0;  ///< ran off, >= 0
    double shortfall_kg_m2 =
        0.0;  ///< part of a negative net supply that an empty film could not give
};
///   net_kg_m2_s   supply minus evaporation, constant over the step
///   rate_1_s      > 0; 0.003 for water on roads, 0.0003 for slush (Crevier & Delage 2001)
///   threshold     held back by the texture, >= 0
/// water + drained - shortfall == before + net dt, to rounding.
FilmStep drain_film(double water_kg_m2, double net_kg_m2_s, double rate_1_s, double threshold_kg_m2,
                    double dt_s);

/// Film thickness on sloped pavement in steady rain, mm (Russam & Ross 1968): 0.046 sqrt(L I)
/// N^0.2.
///   length_m  drainage path; rate_mm_h  rain; slope_n  slope 1:N
double rrl_film_mm(double length_m, double rate_mm_h, double slope_n);
/// Sheet flow after Manning, mm: (n q / sqrt(s))^(3/5), q = I L.
double manning_film_mm(double length_m, double rate_mm_h, double manning_n, double slope);

/// Horton's infiltration: rate decays from first to last while the ground is wet, recovers when
/// dry.
struct HortonParams {
    double first_mm_h = 0.0;    ///< dry ground, >= last
    double last_mm_h = 0.0;     ///< long wet ground, >= 0
    double decay_1_h = 4.0;     ///< > 0
    double recovery_1_h = 0.1;  ///< >= 0
};
/// Depth that wet ground takes up in hours, starting dry, mm.
double horton_depth_mm(const HortonParams& params, double hours);

}  // namespace petrichor::weather

#endif
