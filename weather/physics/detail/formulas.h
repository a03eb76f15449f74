// Formulas that the cell kernel and the public functions share, as templates over double and Lanes.
// Temperatures here are in degrees Celsius where the name ends in _c; the public headers document the
// sources.
#ifndef PETRICHOR_WEATHER_DETAIL_FORMULAS_H
#define PETRICHOR_WEATHER_DETAIL_FORMULAS_H

#include "weather/physics/constants.h"
#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather::detail {

template <class Real>
PETRICHOR_INLINE Real saturation_water_pa(const Real& t_c)
{
    return exponential(t_c * 17.5043 / (t_c + 241.3)) * 611.213;
}
template <class Real>
PETRICHOR_INLINE Real saturation_ice_pa(const Real& t_c)
{
    return exponential(t_c * 22.4422 / (t_c + 272.186)) * 611.15;
}

template <class Real>
PETRICHOR_INLINE Real specific_humidity_of(const Real& vapour_pa, const Real& pressure_pa)
{
    return vapour_pa * kWaterToAirMass / (pressure_pa - vapour_pa * (1.0 - kWaterToAirMass));
}

template <class Real>
PETRICHOR_INLINE Real air_density_of(const Real& temp_k, const Real& q, const Real& pressure_pa)
{
    return pressure_pa / (temp_k * kAirGasConstant * (q * 0.608 + 1.0));
}

// B.2. Saturation of the wet-bulb equation by bisection on [T-40, T], 26 halvings: below 1e-6 K.
template <class Real>
PETRICHOR_INLINE Real wet_bulb_c_of(const Real& t_c, const Real& vapour_pa, const Real& pressure_pa)
{
    Real low = t_c - 40.0;
    Real high = t_c;
    for (int i = 0; i < 26; ++i) {
        const Real middle = (low + high) * 0.5;
        const Real f = saturation_water_pa(middle) - pressure_pa * 6.65e-4 * (t_c - middle) - vapour_pa;
        const auto above = f > 0.0;
        high = select(above, middle, high);
        low = select(above, low, middle);
    }
    return (low + high) * 0.5;
}
template <class Real>
PETRICHOR_INLINE Real snow_fraction_humidity_of(const Real& t_c, const Real& rh_pct)
{
    return 1.0 / (exponential(t_c * 1.41 + rh_pct * 0.09 - 10.04) + 1.0);
}
template <class Real>
PETRICHOR_INLINE Real snow_fraction_wet_bulb_of(const Real& wet_bulb_c)
{
    return 1.0 / (exponential((wet_bulb_c + 3.97) * 2.0) * 6.99e-5 + 1.0);
}

// B.3. Louis 1979. `root_z_over_z0` is sqrt(zU / z0).
template <class Real>
PETRICHOR_INLINE Real stability_factor_of(const Real& richardson, const Real& neutral, const Real& root_z_over_z0)
{
    const auto is_stable = richardson >= 0.0;
    Real stable = 1.0;
    if (any(is_stable)) {
        const Real ri = larger(richardson, Real(0.0));
        stable = 1.0 / (ri * 15.0 * square_root(ri * 5.0 + 1.0) + 1.0);
        if (!any(!is_stable)) return stable;
    }
    const Real ri = larger(richardson * -1.0, Real(0.0));
    const Real unstable = ri * 15.0 / (neutral * 75.0 * square_root(ri) * root_z_over_z0 + 1.0) + 1.0;
    return select(is_stable, stable, unstable);
}

// B.5
template <class Real>
PETRICHOR_INLINE Real new_snow_density_pahaut_of(const Real& t_c, const Real& wind_m_s)
{
    return larger(t_c * 6.0 + 109.0 + square_root(wind_m_s) * 26.0, Real(50.0));
}
template <class Real>
PETRICHOR_INLINE Real snow_conductivity_of(const Real& density)
{
    return power(density * (1.0 / kIceDensity), 1.88) * 2.22;
}

}  // namespace petrichor::weather::detail

#endif
