// Formulas that the cell kernel and the public functions share, as templates over double and Lanes.
// Temperatures here are in degrees Celsius where the name ends in _c; the public headers document
// the sources.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_FORMULAS_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_FORMULAS_H

#include "weather/physics/constants.h"
#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather::detail {

// Saturation (form of Buck 1981): scale exp(a T / (b + T)).
inline constexpr double kWaterA = 17.5043, kWaterB = 241.3, kWaterScale_pa = 611.213;
inline constexpr double kIceA = 22.4422, kIceB = 272.186, kIceScale_pa = 611.15;

template <class Real>
PETRICHOR_INLINE Real saturation_water_pa(const Real& t_c)
{
    return exponential(t_c * kWaterA / (t_c + kWaterB)) * kWaterScale_pa;
}
template <class Real>
PETRICHOR_INLINE Real saturation_ice_pa(const Real& t_c)
{
    return exponential(t_c * kIceA / (t_c + kIceB)) * kIceScale_pa;
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

// The wet-bulb equation by bisection on [T-40, T], 26 halvings: below 1e-6 K.
template <class Real>
PETRICHOR_INLINE Real wet_bulb_c_of(const Real& t_c, const Real& vapour_pa, const Real& pressure_pa)
{
    Real low = t_c - 40.0;
    Real high = t_c;
    for (int i = 0; i < 26; ++i) {
        const Real middle = (low + high) * 0.5;
        const Real f =
            saturation_water_pa(middle) - pressure_pa * 6.65e-4 * (t_c - middle) - vapour_pa;
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

// Coefficient of heat in neutral air, from the logarithms of zU / z0 and zT / z0h.
template <class Real>
PETRICHOR_INLINE Real neutral_exchange_of(const Real& log_wind, const Real& log_temp)
{
    return kVonKarman * kVonKarman / (log_wind * log_temp);
}

// Bulk Richardson number a kelvin between air and surface, from 1 / (T U^2).
template <class Real>
PETRICHOR_INLINE Real richardson_per_k_of(const Real& per_air_wind2, double wind_height_m)
{
    return per_air_wind2 * (kGravity_m_s2 * wind_height_m);
}

// Louis 1979. Both branches in one square root and one division:
//   stable    1 / (1 + 15 Ri sqrt(1 + 5 Ri))
//   unstable  1 + 15 |Ri| / (1 + C sqrt(|Ri|))
// `convection` is C: 75 CHn sqrt(zU/z0) with Louis; convection_of else.
template <class Real>
PETRICHOR_INLINE Real stability_factor_of(const Real& richardson, const Real& convection)
{
    const auto is_stable = richardson >= 0.0;
    const Real size = larger(richardson, richardson * -1.0);
    const Real steep = size * 15.0;
    const Real root = square_root(select(is_stable, size * 5.0 + 1.0, size));
    const Real under = select(is_stable, steep, convection) * root + 1.0;
    return select(is_stable, Real(1.0), under + steep) / under;
}
// C where the roughness of heat is not that of momentum, from the logarithms of zU / z0 and z0 /
// z0h: Mascart, Noilhan & Giordani 1995 (Boundary-Layer Meteorol. 72, 331).
inline double convection_of(double log_wind, double log_share)
{
    const double m = log_share;
    const double star = 3.2165 + m * (4.3431 + m * (0.5360 - m * 0.0781));
    const double power_h = 0.5802 + m * (-0.1571 + m * (0.0327 - m * 0.0026));
    const double drag = kVonKarman * kVonKarman / (log_wind * log_wind);
    const double log_heat = log_wind + m;
    return 15.0 * star * drag * exponential(power_h * log_heat) * (log_wind / log_heat);
}

// Pahaut 1976; snow_conductivity_of: Yen 1981.
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
// Its inverse, without the division, for the kernel.
template <class Real>
PETRICHOR_INLINE Real snow_resistivity_of(const Real& density)
{
    const Real share = clamped(density, Real(1.0), Real(2000.0)) * (1.0 / kIceDensity);
    return power_short(share, -1.88) * (1.0 / 2.22);
}

}  // namespace petrichor::weather::detail

#endif
