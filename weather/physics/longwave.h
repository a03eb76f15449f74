#ifndef PETRICHOR_WEATHER_PHYSICS_LONGWAVE_H
#define PETRICHOR_WEATHER_PHYSICS_LONGWAVE_H

#include <cstdint>

namespace petrichor::weather {

/// Emissivity of a clear sky, 0..1, from Dilley & O'Brien 1998: (59.38 + 113.7 (T/273.16)^6 + 96.96
/// sqrt(w/25)) / (sb T^4), with w = 4.65 e[Pa]/T kg/m2 of vapour above (Prata 1996).
double clear_sky_emissivity(double temp_k, double vapour_pa);

/// What the hour adds to that: 0.013 cos(2 pi h / 24), h by the mean sun (Martin & Berdahl 1984).
/// Air at two metres is warmer than what radiates above it by day, and colder by night.
double emissivity_of_hour(std::int64_t time_us, double longitude_deg);

/// Longwave radiation from the sky, W/m2: of a clear sky ea; under cloud ea + (0.955 - ea) N^2.5:
/// the form of Konzelmann et al. 1994, whose N^4 leaves half a cover too cold at Col de Porte, as
/// Unsworth & Monteith's N leaves it too warm at Bondville (docs/weather.md).
///   cloud_fraction  0..1
///   of_hour         emissivity_of_hour; 0: of no hour
double longwave_from_sky_w_m2(double temp_k, double vapour_pa, double cloud_fraction,
                              double of_hour = 0.0);
/// The inverse: cloud fraction 0..1 from measured longwave; 0 at or below the clear sky.
double cloud_of_longwave(double temp_k, double vapour_pa, double longwave_w_m2,
                         double of_hour = 0.0);

}  // namespace petrichor::weather

#endif
