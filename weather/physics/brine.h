#ifndef PETRICHOR_WEATHER_PHYSICS_BRINE_H
#define PETRICHOR_WEATHER_PHYSICS_BRINE_H

namespace petrichor::weather {

// Rock salt (NaCl) in water. Freezing points: Bodnar 1993 (Geochim. Cosmochim. Acta 57, 683), a fit
// to measurements within 0.05 % of salt, from water to the eutectic.

inline constexpr double kEutecticDepression_k = 21.2;  ///< below -21.2 C brine is ice and salt
inline constexpr double kNoSalt_kg_m2 = 1e-7;          ///< less than this is none

/// Share of salt in brine that begins to freeze at a temperature, 0..0.233 by mass; 0 at 0 C and
/// above, that of the eutectic below -21.2 C.
double brine_strength(double temp_c);

/// Where brine with a share of salt begins to freeze, C; the eutectic for stronger brine.
double freezing_point_c(double salt_share);

/// Where the water of a cell begins to freeze, by its salt and its water, kg/m2. Dry salt: the
/// eutectic; no salt: 0.
double freezing_point_c(double salt_kg_m2, double water_kg_m2);

/// Water that salt keeps liquid at a temperature, kg/m2, of the water and ice that are there.
double brine_water_kg_m2(double salt_kg_m2, double water_kg_m2, double temp_c);

}  // namespace petrichor::weather

#endif
