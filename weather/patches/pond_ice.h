#ifndef PETRICHOR_WEATHER_PATCHES_POND_ICE_H
#define PETRICHOR_WEATHER_PATCHES_POND_ICE_H

namespace petrichor::weather {

/// What the air and the sky do to water that stands, by its surface. All that a surface at 0 C gains, and
/// how much less it gains for each kelvin above that.
struct PondAir {
    double gain_w_m2 = 0.0;
    double loss_w_m2_k = 10.0;      ///< > 0
    double cover_m2_k_w = 0.0;      ///< thermal resistance of the snow on its ice, >= 0
    double ice_gain_w_m2 = 0.0;     ///< as gain_w_m2, of ice: another albedo, another latent heat
    double ice_loss_w_m2_k = 10.0;  ///< > 0
};

/// Heat of water that stands, J per kg over water at 0 C: what is below 0 is ice by its latent heat. Water
/// is mixed and ice floats on it, with as much heat in itself as its mean leaves; what freezes to the
/// ground is no colder than that (Semtner 1976, his model without layers).
///
/// A step changes the heat by what the surface gains: of water at the temperature that the water has, of
/// ice at that which lets as much through as the air takes. Ice in 0 C water melts from above.
///
///   water_kg_m2  how much stands there, ice included, > 0
///   returns      -latent heat of fusion .. ; the same number for dt_s = 0
///   source       Semtner 1976, A model for the thermodynamic growth of sea ice, J. Phys. Oceanogr. 6.
double step_pond_heat(double heat_j_kg, double water_kg_m2, const PondAir& air, double dt_s);

/// Of water with that heat: the share that is ice, 0..1, and its temperature, C.
double pond_ice_share(double heat_j_kg);
double pond_water_c(double heat_j_kg);

}  // namespace petrichor::weather

#endif
