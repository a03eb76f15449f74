// One surface point: its energy balance and Newton's method on it. Degrees Celsius inside.
#ifndef PETRICHOR_WEATHER_DETAIL_SURFACE_KERNEL_H
#define PETRICHOR_WEATHER_DETAIL_SURFACE_KERNEL_H

#include "weather/physics/detail/formulas.h"
#include "weather/physics/exchange.h"

namespace petrichor::weather::detail {

// Everything that does not change during the iterations.
template <class Real, class Mask>
struct SurfacePoint {
    Real absorbed;      // (1-albedo) SW + eps LW, W/m2
    Real emitting;      // eps * sb
    Real air_c;
    Real air_k;
    Real q_air;
    Real pressure;
    Real exchange;      // rho * CHn * U, kg m-2 s-1
    Real neutral;       // CHn
    Real richardson_k;  // g zU / (Ta U^2), 1/K
    Real root_z;        // sqrt(zU/z0)
    Real beta;
    Real most_vapour;   // kg m-2 s-1 that can leave: the store over the step
    Mask icy;
    Real latent_heat;   // J/kg
    Real rain_heat;     // p cw, W m-2 K-1
    Real conductance;   // to the ground below
    Real below_c;       // its temperature
};

template <class Real>
struct PointFluxes {
    Real net_radiation, sensible, latent, vapour, ground, rain_heat, balance, slope;
};

// rho CH U with the stability of a surface temperature.
template <class Real, class Mask>
PETRICHOR_INLINE Real exchange_at(const SurfacePoint<Real, Mask>& p, const ExchangeParams& params,
                                  const Real& surface_c)
{
    if (params.stability == Stability::Neutral) return p.exchange;
    Real ri = p.richardson_k * (p.air_c - surface_c);
    if (params.stability == Stability::LouisCapped) ri = smaller(ri, Real(params.max_richardson));
    return p.exchange * stability_factor_of(ri, p.neutral, p.root_z);
}

constexpr double kLongestStep_k = 20.0;

// F and -dF/dTs at a surface temperature with a given exchange.
template <class Real, class Mask>
PETRICHOR_INLINE PointFluxes<Real> fluxes_at(const SurfacePoint<Real, Mask>& p, const Real& surface_c,
                                             const Real& exchange)
{
    const Real a = select(p.icy, Real(22.4422), Real(17.5043));
    const Real b = select(p.icy, Real(272.186), Real(241.3));
    const Real scale = select(p.icy, Real(611.15), Real(611.213));
    const Real inverse = 1.0 / (b + surface_c);
    const Real vapour_pa = scale * exponential(a * surface_c * inverse);
    const Real dry = 1.0 / (p.pressure - vapour_pa * (1.0 - kWaterToAirMass));
    const Real q = vapour_pa * kWaterToAirMass * dry;
    // dq/dT = q P / (P - 0.378 e) * d(ln e)/dT
    const Real dq = q * p.pressure * dry * (a * b) * inverse * inverse;
    const Real surface_k = surface_c + kZeroCelsiusK;
    const Real cubed = surface_k * surface_k * surface_k;
    // Dew and frost settle on dry ground too: only a loss is scaled by the wet fraction.
    const Real beta = select(q < p.q_air, Real(1.0), p.beta);
    PointFluxes<Real> f;
    f.net_radiation = p.absorbed - p.emitting * cubed * surface_k;
    f.sensible = exchange * kAirHeatCapacity * (surface_c - p.air_c);
    const Real wanted = beta * exchange * (q - p.q_air);
    const auto limited = wanted > p.most_vapour;
    f.vapour = select(limited, p.most_vapour, wanted);
    f.latent = p.latent_heat * f.vapour;
    f.ground = p.conductance * (surface_c - p.below_c);
    f.rain_heat = p.rain_heat * (p.air_c - surface_c);
    f.balance = f.net_radiation - f.sensible - f.latent - f.ground + f.rain_heat;
    f.slope = p.emitting * cubed * 4.0 + exchange * kAirHeatCapacity +
              select(limited, Real(0.0), p.latent_heat * beta * exchange * dq) + p.conductance + p.rain_heat;
    // No step of Newton's is longer than 20 K: in calm air a cold surface in strong sun would be thrown beyond boiling.
    f.slope = larger(f.slope, larger(f.balance, -f.balance) * (1.0 / kLongestStep_k));
    return f;
}

}  // namespace petrichor::weather::detail

#endif
