// One surface point: its energy balance and Newton's method on it. Degrees Celsius inside.
#ifndef PETRICHOR_WEATHER_DETAIL_SURFACE_KERNEL_H
#define PETRICHOR_WEATHER_DETAIL_SURFACE_KERNEL_H

#include "weather/physics/detail/formulas.h"
#include "weather/physics/detail/saturation_curve.h"
#include "weather/physics/exchange.h"

namespace petrichor::weather::detail {

// Everything that does not change during the iterations.
template <class Real, class Mask>
struct SurfacePoint {
    Real absorbed;  // (1-albedo) SW + eps LW, W/m2
    Real emitting;  // eps * sb
    Real air_c;
    Real q_air;
    Real pressure;
    Real exchange;      // rho * CHn * U, kg m-2 s-1
    Real neutral;       // CHn
    Real richardson_k;  // g zU / (Ta U^2), 1/K
    Real root_z;        // sqrt(zU/z0)
    Real beta;
    Real most_vapour;  // kg m-2 s-1 that can leave: the store over the step
    Mask icy;
    Real latent_heat;  // J/kg
    Real rain_heat;    // p cw, W m-2 K-1
    Real conductance;  // to the ground below
    Real below_c;      // its temperature
};

template <class Real>
struct PointFluxes {
    Real net_radiation, sensible, latent, vapour, ground, rain_heat, balance, slope;
};

// Saturation humidity of the surface near a temperature.
template <class Real>
struct SurfaceVapour {
    SaturationCurve<Real> curve;
    Real dry;  // 1 / (P - 0.378 e) at the middle of the curve
};
template <class Real, class Mask>
PETRICHOR_INLINE void centre_dry(SurfaceVapour<Real>& v, const SurfacePoint<Real, Mask>& p)
{
    v.dry = 1.0 / (p.pressure - v.curve.pressure_pa * (1.0 - kWaterToAirMass));
}
template <class Real, class Mask>
PETRICHOR_INLINE SurfaceVapour<Real> surface_vapour(const SurfacePoint<Real, Mask>& p,
                                                    const Real& surface_c)
{
    SurfaceVapour<Real> v;
    v.curve = surface_curve(p.icy, surface_c);
    centre_dry(v, p);
    return v;
}
template <class Real, class Mask>
PETRICHOR_INLINE SurfaceVapour<Real> chosen(const Mask& mask, const SurfaceVapour<Real>& a,
                                            const SurfaceVapour<Real>& b)
{
    SurfaceVapour<Real> v = b;
    v.curve.middle_c = select(mask, a.curve.middle_c, b.curve.middle_c);
    v.curve.inverse = select(mask, a.curve.inverse, b.curve.inverse);
    v.curve.pressure_pa = select(mask, a.curve.pressure_pa, b.curve.pressure_pa);
    v.curve.slope = select(mask, a.curve.slope, b.curve.slope);
    v.dry = select(mask, a.dry, b.dry);
    return v;
}
// Expands again where a temperature is out of the curve's reach.
template <class Real, class Mask>
PETRICHOR_INLINE void follow(SurfaceVapour<Real>& v, const SurfacePoint<Real, Mask>& p,
                             const Real& surface_c)
{
    const Real step = surface_c - v.curve.middle_c;
    const auto far = (step > kCurveReach_k) | (step < -kCurveReach_k);
    if (!any(far)) return;
    SurfaceVapour<Real> fresh = v;
    centre_curve(fresh.curve, surface_c);
    centre_dry(fresh, p);
    v = chosen(far, fresh, v);
}
// At the melting point no exponential is needed: e is the constant of its law.
template <class Real, class Mask>
PETRICHOR_INLINE SurfaceVapour<Real> vapour_at_melting_point(const SurfaceVapour<Real>& v,
                                                             const SurfacePoint<Real, Mask>& p)
{
    SurfaceVapour<Real> at_zero = v;
    at_zero.curve.middle_c = Real(0.0);
    at_zero.curve.inverse = select(p.icy, Real(1.0 / kIceB), Real(1.0 / kWaterB));
    at_zero.curve.pressure_pa = v.curve.scale;
    at_zero.curve.slope = select(p.icy, Real(kIceA / kIceB), Real(kWaterA / kWaterB));
    centre_dry(at_zero, p);
    return at_zero;
}

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

// F and -dF/dTs at a surface temperature, with a given exchange. The vapour at it: pressure
// `vapour_pa`, its slope d ln e / dT, and `dry` = 1 / (P - 0.378 e).
template <class Real, class Mask>
PETRICHOR_INLINE PointFluxes<Real> fluxes_with(const SurfacePoint<Real, Mask>& p,
                                               const Real& vapour_pa, const Real& vapour_slope,
                                               const Real& dry, const Real& surface_c,
                                               const Real& exchange)
{
    const Real q = vapour_pa * kWaterToAirMass * dry;
    // dq/dT = q P / (P - 0.378 e) * d(ln e)/dT
    const Real dq = q * p.pressure * dry * vapour_slope;
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
              select(limited, Real(0.0), p.latent_heat * beta * exchange * dq) + p.conductance +
              p.rain_heat;
    // No step of Newton's is longer than 20 K: in calm air a cold surface in strong sun would be
    // thrown beyond boiling.
    f.slope = larger(f.slope, larger(f.balance, -f.balance) * (1.0 / kLongestStep_k));
    return f;
}

// At the middle of the curve.
template <class Real, class Mask>
PETRICHOR_INLINE PointFluxes<Real> fluxes_at_middle(const SurfacePoint<Real, Mask>& p,
                                                    const SurfaceVapour<Real>& v,
                                                    const Real& exchange)
{
    return fluxes_with(p, v.curve.pressure_pa, v.curve.slope, v.dry, v.curve.middle_c, exchange);
}
// At a temperature within reach of the curve.
template <class Real, class Mask>
PETRICHOR_INLINE PointFluxes<Real> fluxes_at(const SurfacePoint<Real, Mask>& p,
                                             const SurfaceVapour<Real>& v, const Real& surface_c,
                                             const Real& exchange)
{
    const SaturationPoint<Real> s = point_of(v.curve, surface_c);
    // 1 / (P - 0.378 e) from its value at the middle; h is at most a few thousandths.
    const Real h = v.curve.pressure_pa * s.growth * v.dry * (1.0 - kWaterToAirMass);
    const Real dry = v.dry * ((h + 1.0) * (h * h + 1.0));
    return fluxes_with(p, s.pressure_pa, s.slope, dry, surface_c, exchange);
}

// Newton's three steps from a first guess; the exchange and the vapour curve of the last one.
template <class Real>
struct SurfaceRoot {
    Real surface_c, exchange;
    SurfaceVapour<Real> vapour;
};
template <class Real, class Mask>
PETRICHOR_INLINE SurfaceRoot<Real> surface_root(const SurfacePoint<Real, Mask>& p,
                                                const ExchangeParams& params,
                                                const Real& first_guess_c)
{
    SurfaceRoot<Real> root;
    root.vapour = surface_vapour(p, first_guess_c);
    root.exchange = exchange_at(p, params, first_guess_c);
    const auto first = fluxes_at_middle(p, root.vapour, root.exchange);
    root.surface_c = first_guess_c + first.balance / first.slope;
    for (int i = 1; i < 3; ++i) {
        follow(root.vapour, p, root.surface_c);
        root.exchange = exchange_at(p, params, root.surface_c);
        const auto f = fluxes_at(p, root.vapour, root.surface_c, root.exchange);
        root.surface_c = root.surface_c + f.balance / f.slope;
    }
    follow(root.vapour, p, root.surface_c);
    return root;
}

}  // namespace petrichor::weather::detail

#endif
