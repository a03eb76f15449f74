// The laws of the snow pack as templates over double and Lanes: the kernel and the public functions
// of snow.h run this one text. Temperatures in degrees Celsius.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_SNOW_LAWS_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_SNOW_LAWS_H

#include "weather/physics/constants.h"
#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather::detail {

// Hedstrom & Pomeroy 1998, kg/m3.
template <class Real>
PETRICHOR_INLINE Real new_snow_density_hedstrom_of(const Real& t_c)
{
    return exponential(smaller(t_c, Real(0.0)) * (1.0 / 2.59)) * 51.25 + 67.92;
}

// What a decay that takes `efolding_h` to fall to 1/e leaves after dt.
inline double kept_after(double dt_s, double efolding_h)
{
    return exponential(-dt_s / (3600.0 * efolding_h));
}
inline constexpr double kSettling_h = 200.0;  // e-folding of exponential settling

// Density that is on its way to a limit; denser snow stays as it is.
//   keep  kept_after(dt, kSettling_h)
template <class Real>
PETRICHOR_INLINE Real settled_density_of(const Real& density, const Real& limit, double keep)
{
    return select(density < limit, limit + (density - limit) * keep, density);
}

// Albedo that decays to that of old snow (Verseghy 1991), and one that snowfall renews.
template <class Real>
PETRICHOR_INLINE Real aged_albedo_of(const Real& albedo, const Real& keep, double albedo_min)
{
    return (albedo - albedo_min) * keep + albedo_min;
}
template <class Real>
PETRICHOR_INLINE Real refreshed_albedo_of(const Real& albedo, const Real& snowfall,
                                          double albedo_max, double refresh_kg_m2)
{
    return albedo + (albedo_max - albedo) * (1.0 - exponential(snowfall * (-1.0 / refresh_kg_m2)));
}

// Liquid that the pores hold against gravity, kg/m2.
template <class Real>
PETRICHOR_INLINE Real held_liquid_of(const Real& thickness_m, const Real& ice,
                                     double irreducible_water)
{
    return larger((thickness_m - ice * (1.0 / kIceDensity)) * (1000.0 * irreducible_water),
                  Real(0.0));
}

}  // namespace petrichor::weather::detail

#endif
