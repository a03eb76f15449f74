#ifndef PETRICHOR_WEATHER_PATCHES_SKY_LIGHT_H
#define PETRICHOR_WEATHER_PATCHES_SKY_LIGHT_H

namespace petrichor::weather {

// Sunlight and heat of the sky on planes that face anywhere.

/// Air mass relative to the zenith, Kasten & Young 1989. `zenith_rad` 0 .. pi/2.
double relative_air_mass(double zenith_rad);

/// What the sun sends through the clearest air there is (Linke turbidity 2), W/m2 on a plane that faces
/// it: the beam of ESRA, Rigollier et al. 2000, with the optical depth of Kasten 1996.
///   outside   W/m2 outside the air on that plane; height_m above the sea, of NaN: 0
double clear_beam_w_m2(double outside_w_m2, double zenith_rad, double height_m);

/// How the diffuse light of the sky gathers about the sun and along the horizon.
struct SkyGlow {
    double sun = 0.0;      ///< F1, 0..1 of it comes from about the sun
    double horizon = 0.0;  ///< F2, so much of it comes from the horizon, less where negative
};
/// Perez et al. 1990, the anisotropic model of hourly data.
///   diffuse   W/m2 on flat ground, > 0; direct: W/m2 on a plane that faces the sun, >= 0
///   outside   W/m2 outside the air on that plane, > 0
SkyGlow perez_glow(double diffuse_w_m2, double direct_w_m2, double outside_w_m2, double zenith_rad);
/// The same glow when the sky sends `all` instead of `diffuse` and what is more comes evenly; about the
/// sun no more than `most`, W/m2 on flat ground.
SkyGlow glow_below(SkyGlow glow, double diffuse_w_m2, double all_w_m2, double most_w_m2);
/// What a patch sees of the sky, for its diffuse light.
struct SkySeen {
    double sky = 1.0;        ///< SkyShares::sky
    double horizon = 1.0;    ///< SkyShares::horizon
    double sun = 1.0;        ///< V (n.s)+ / max(up, cos 85)
    double sine_tilt = 0.0;  ///< sin b
};
/// Diffuse light of the sky on a patch, W/m2, >= 0.
double sky_light_w_m2(double diffuse_w_m2, const SkyGlow& glow, const SkySeen& seen);

/// What a clear sky gives beyond its mean because it is warmer towards the horizon: .09 (l - 1/2)
/// (1 - N) sb Ta^4, W/m2 a whole hemisphere (Unsworth & Monteith 1975).
double warm_horizon_w_m2(double log_secant, double cloud_fraction, double air_temp_k);

}  // namespace petrichor::weather

#endif
