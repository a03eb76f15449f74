// One surface point: its energy balance and Newton's method on it. Degrees Celsius inside.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_SURFACE_KERNEL_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_SURFACE_KERNEL_H

#include "weather/physics/detail/formulas.h"
#include "weather/physics/detail/saturation_curve.h"
#include "weather/physics/exchange.h"

namespace petrichor::weather::detail {

// The share of the surface that evaporates: mean of the step, and at its end, which is also how
// much a little more evaporation would add.
template <class Real>
struct WetShare {
    Real mean, end;
};
// A share that does not depend on how much evaporates.
template <class Real>
struct FixedShares {
    WetShare<Real> all;
};
template <class Real, class Mask>
PETRICHOR_INLINE void take(const Mask& mask, const FixedShares<Real>& from, FixedShares<Real>& to)
{
    to.all.mean = select(mask, from.all.mean, to.all.mean);
    to.all.end = select(mask, from.all.end, to.all.end);
}
template <class Real>
struct FixedShare {
    using Shares = FixedShares<Real>;
    Real beta;
    PETRICHOR_INLINE void share(const Real& /*potential_rate*/, Shares& out) const
    {
        out.all.mean = out.all.end = beta;
    }
};
// What evaporates as a line through one evaluation of the shares.
template <class Wetness, class Real>
struct WetLine {
    typename Wetness::Shares shares;
    Real offset;  // kg m-2 s-1: mean share and slope of the line differ

    PETRICHOR_INLINE Real vapour(const Real& potential) const
    {
        return smaller(shares.all.end * potential + offset, potential);
    }
};

// Everything that does not change during the iterations. `Wetness` gives the share that evaporates
// for a potential rate of evaporation.
template <class Real, class Mask, class Wetness>
struct SurfacePoint {
    Real absorbed;  // (1-albedo) SW + eps LW, W/m2
    Real emitting;  // eps * sb
    Real air_c;
    Real q_air;
    Real pressure;
    Real exchange;      // rho * CHn * U, kg m-2 s-1
    Real of_leaves;     // what leaves add, whatever the air's stability
    Real richardson_k;  // g zU / (Ta U^2), 1/K; g across the surface
    Real upright;       // 0 of what lies level, 1 of a wall
    Real convection;    // of stability_factor_of
    Wetness wet;
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
// What Newton's method asks for: F and -dF/dTs, and what F holds of the air.
template <class Real>
struct PointBalance {
    Real balance, slope, vapour;
    Real turbulent, turbulent_slope;  // sensible and latent heat
};

// Saturation humidity of the surface near a temperature: at the middle of the curve, and the curve.
template <class Real>
struct SurfaceVapour {
    SaturationCurve<Real> curve;
    Real q;
};
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE void centre_vapour(SurfaceVapour<Real>& v,
                                    const SurfacePoint<Real, Mask, Wetness>& p,
                                    const Real& surface_c)
{
    const Real a = select(p.icy, Real(kIceA), Real(kWaterA));
    const Real b = select(p.icy, Real(kIceB), Real(kWaterB));
    const Real scale = select(p.icy, Real(kIceScale_pa), Real(kWaterScale_pa));
    const Real vapour_pa = centre_curve(v.curve, a, b, scale, surface_c);
    v.q = specific_humidity_of(vapour_pa, p.pressure);
}
// Takes `from` where the mask says so. In place: copies of structs of lanes cost more than the
// arithmetic.
template <class Real, class Mask>
PETRICHOR_INLINE void take(const Mask& mask, const SurfaceVapour<Real>& from,
                           SurfaceVapour<Real>& v)
{
    v.curve.middle_c = select(mask, from.curve.middle_c, v.curve.middle_c);
    v.curve.inverse = select(mask, from.curve.inverse, v.curve.inverse);
    v.curve.slope = select(mask, from.curve.slope, v.curve.slope);
    v.q = select(mask, from.q, v.q);
}
// Expands again where a temperature is out of the curve's reach.
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE void follow(SurfaceVapour<Real>& v, const SurfacePoint<Real, Mask, Wetness>& p,
                             const Real& surface_c)
{
    const Real step = surface_c - v.curve.middle_c;
    const auto far = step * step > kCurveReach_k * kCurveReach_k;
    if (!any(far)) return;
    SurfaceVapour<Real> fresh;
    centre_vapour(fresh, p, surface_c);
    take(far, fresh, v);
}
// At the melting point no exponential is needed: e is the constant of its law.
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE void centre_at_melting_point(SurfaceVapour<Real>& v,
                                              const SurfacePoint<Real, Mask, Wetness>& p)
{
    v.curve.middle_c = Real(0.0);
    v.curve.inverse = select(p.icy, Real(1.0 / kIceB), Real(1.0 / kWaterB));
    v.curve.slope = select(p.icy, Real(kIceA / kIceB), Real(kWaterA / kWaterB));
    v.q = specific_humidity_of(select(p.icy, Real(kIceScale_pa), Real(kWaterScale_pa)), p.pressure);
}

// Air sinks along a cold wall and rises along a warm one.
//   dT  kelvin between air and surface; kg m-2 s-1
template <class Real>
PETRICHOR_INLINE Real wall_convection_of(const Real& dt_k)
{
    const Real size = larger(larger(dt_k, -dt_k), Real(1e-6));
    return power_short(size, 1.0 / 3.0) * (kWallConvection_w_m2 / kAirHeatCapacity);
}

// rho CH U with the stability of a surface temperature, and what a wall adds.
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE Real exchange_at(const SurfacePoint<Real, Mask, Wetness>& p,
                                  const ExchangeParams& params, const Real& surface_c)
{
    if (params.stability == Stability::Neutral) return p.exchange + p.of_leaves;
    Real ri = p.richardson_k * (p.air_c - surface_c);
    if (params.stability == Stability::LouisCapped) ri = smaller(ri, Real(params.max_richardson));
    const Real level =
        p.exchange * smaller(stability_factor_of(ri, p.convection), Real(params.max_unstable)) + p.of_leaves;
    if (!any(p.upright > 0.0)) return level;
    return level + p.upright * wall_convection_of(p.air_c - surface_c);
}

constexpr double kLongestStep_k = 20.0;
constexpr double kOvershoot_w_m2 = 20.0;

// Saturation humidity of the surface and its slope.
template <class Real>
struct SurfaceHumidity {
    Real q, dq;
};
constexpr double kQPerDry = (1.0 - kWaterToAirMass) / kWaterToAirMass;
// dq/dT = q P / (P - 0.378 e) d(ln e)/dT, and P / (P - 0.378 e) = 1 + q 0.378 / 0.622
template <class Real>
PETRICHOR_INLINE SurfaceHumidity<Real> humidity_with(const Real& q, const Real& slope)
{
    return {q, q * slope * (q * kQPerDry + 1.0)};
}
// At the middle of the curve.
template <class Real>
PETRICHOR_INLINE SurfaceHumidity<Real> humidity_at_middle(const SurfaceVapour<Real>& v)
{
    return humidity_with(v.q, v.curve.slope);
}
// At a temperature within reach of the curve.
template <class Real>
PETRICHOR_INLINE SurfaceHumidity<Real> humidity_at(const SurfaceVapour<Real>& v,
                                                   const Real& surface_c)
{
    const SaturationPoint<Real> s = point_of(v.curve, surface_c);
    // (P - 0.378 e0) / (P - 0.378 e) = 1 / (1 - h); h is at most a few hundredths.
    const Real h = s.growth * (v.q * kQPerDry);
    return humidity_with((v.q * s.growth + v.q) * ((h + 1.0) * (h * h + 1.0)), s.slope);
}

// Structs of lanes go by reference: copying them costs more than the arithmetic.
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE void lay_wet_line(const SurfacePoint<Real, Mask, Wetness>& p,
                                   const SurfaceHumidity<Real>& at, const Real& exchange,
                                   WetLine<Wetness, Real>& line)
{
    const Real potential_rate = exchange * (at.q - p.q_air);
    p.wet.share(potential_rate, line.shares);
    line.offset = (line.shares.all.mean - line.shares.all.end) * potential_rate;
}

// What leaves as vapour, and how much more a little more potential would add.
template <class Real>
struct VapourRate {
    Real rate, gain;
};
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE VapourRate<Real> vapour_with(const SurfacePoint<Real, Mask, Wetness>& p,
                                              const Real& q, const WetLine<Wetness, Real>& wet,
                                              const Real& exchange)
{
    // Dew and frost settle on dry ground too: only a loss is scaled by the wet fraction.
    const auto dew = q < p.q_air;
    const Real potential = exchange * (q - p.q_air);
    const Real wanted = select(dew, potential, wet.vapour(potential));
    const auto limited = wanted > p.most_vapour;
    return {select(limited, p.most_vapour, wanted),
            select(limited, Real(0.0), select(dew, Real(1.0), wet.shares.all.end))};
}

// A slope with which no step of Newton's is longer than 20 K: in calm air a cold surface in strong
// sun would be thrown beyond boiling.
template <class Real>
PETRICHOR_INLINE Real at_most_20_k(const Real& slope, const Real& balance)
{
    return larger(slope, larger(balance, -balance) * (1.0 / kLongestStep_k));
}

// F and -dF/dTs at a surface temperature, with a given exchange.
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE PointBalance<Real> balance_with(const SurfacePoint<Real, Mask, Wetness>& p,
                                                 const SurfaceHumidity<Real>& at,
                                                 const WetLine<Wetness, Real>& wet,
                                                 const Real& surface_c, const Real& exchange)
{
    const Real surface_k = surface_c + kZeroCelsiusK;
    const Real emitted = p.emitting * (surface_k * surface_k * surface_k);
    const Real heat = exchange * kAirHeatCapacity;
    const auto vapour = vapour_with(p, at.q, wet, exchange);
    PointBalance<Real> f;
    f.vapour = vapour.rate;
    f.turbulent = heat * (surface_c - p.air_c) + p.latent_heat * vapour.rate;
    f.balance = (p.absorbed - emitted * surface_k) - f.turbulent -
                p.conductance * (surface_c - p.below_c) + p.rain_heat * (p.air_c - surface_c);
    f.turbulent_slope = heat + p.latent_heat * exchange * (vapour.gain * at.dq);
    f.slope =
        at_most_20_k(emitted * 4.0 + f.turbulent_slope + (p.conductance + p.rain_heat), f.balance);
    return f;
}

// The same F, flux by flux.
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE PointFluxes<Real> fluxes_with(const SurfacePoint<Real, Mask, Wetness>& p,
                                               const SurfaceHumidity<Real>& at,
                                               const WetLine<Wetness, Real>& wet,
                                               const Real& surface_c, const Real& exchange)
{
    const Real surface_k = surface_c + kZeroCelsiusK;
    const Real emitted = p.emitting * (surface_k * surface_k * surface_k);
    const Real heat = exchange * kAirHeatCapacity;
    const auto vapour = vapour_with(p, at.q, wet, exchange);
    PointFluxes<Real> f;
    f.net_radiation = p.absorbed - emitted * surface_k;
    f.sensible = heat * (surface_c - p.air_c);
    f.vapour = vapour.rate;
    f.latent = p.latent_heat * f.vapour;
    f.ground = p.conductance * (surface_c - p.below_c);
    f.rain_heat = p.rain_heat * (p.air_c - surface_c);
    f.balance = f.net_radiation - f.sensible - f.latent - f.ground + f.rain_heat;
    f.slope = at_most_20_k(emitted * 4.0 + heat + p.latent_heat * exchange * (vapour.gain * at.dq) +
                               (p.conductance + p.rain_heat),
                           f.balance);
    return f;
}

// Newton's three steps from a first guess; what the last one used. The wet shares of the second
// step serve the third: by then the temperature hardly moves.
template <class Real, class Wetness>
struct SurfaceRoot {
    Real surface_c, exchange;
    Real slope, turbulent;  // -dF/dTs, and sensible and latent heat
    SurfaceVapour<Real> vapour;
    WetLine<Wetness, Real> wet;
};
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE void take(const Mask& mask, const SurfaceRoot<Real, Wetness>& from,
                           SurfaceRoot<Real, Wetness>& root)
{
    root.surface_c = select(mask, from.surface_c, root.surface_c);
    root.exchange = select(mask, from.exchange, root.exchange);
    take(mask, from.vapour, root.vapour);
    root.wet.offset = select(mask, from.wet.offset, root.wet.offset);
    take(mask, from.wet.shares, root.wet.shares);
}
// The next step of Newton's from the balance at `surface_c`.
template <class Real, class Wetness>
PETRICHOR_INLINE void step_root(SurfaceRoot<Real, Wetness>& root, const Real& surface_c,
                                const PointBalance<Real>& at)
{
    const Real step = at.balance / at.slope;
    root.surface_c = surface_c + step;
    root.slope = at.slope;
    root.turbulent = at.turbulent + at.turbulent_slope * step;
}
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE void surface_root(const SurfacePoint<Real, Mask, Wetness>& p,
                                   const ExchangeParams& params, const Real& first_guess_c,
                                   SurfaceRoot<Real, Wetness>& root)
{
    centre_vapour(root.vapour, p, first_guess_c);
    root.exchange = exchange_at(p, params, first_guess_c);
    const auto humidity = humidity_at_middle(root.vapour);
    lay_wet_line(p, humidity, root.exchange, root.wet);
    const auto first = balance_with(p, humidity, root.wet, first_guess_c, root.exchange);
    const Real second_c = first_guess_c + first.balance / first.slope;

    follow(root.vapour, p, second_c);
    const Real second_exchange = exchange_at(p, params, second_c);
    const auto second_humidity = humidity_at(root.vapour, second_c);
    lay_wet_line(p, second_humidity, second_exchange, root.wet);
    const auto second = balance_with(p, second_humidity, root.wet, second_c, second_exchange);
    const Real third_c = second_c + second.balance / second.slope;

    follow(root.vapour, p, third_c);
    root.exchange = exchange_at(p, params, third_c);
    const auto third =
        balance_with(p, humidity_at(root.vapour, third_c), root.wet, third_c, root.exchange);
    step_root(root, third_c, third);
    // In calm air the exchange itself depends so much on the surface that Newton's steps overshoot:
    // the root lies between the last two, and so does its exchange.
    const auto overshot = (second.balance * third.balance < 0.0) &
                          (larger(third.balance, -third.balance) > kOvershoot_w_m2);
    if (any(overshot)) {
        const Real share = second.balance / (second.balance - third.balance);
        const Real between_c = second_c + (third_c - second_c) * share;
        SurfaceRoot<Real, Wetness> inner;
        inner.exchange = second_exchange + (root.exchange - second_exchange) * share;
        inner.vapour = root.vapour;
        follow(inner.vapour, p, between_c);
        const auto at = humidity_at(inner.vapour, between_c);
        lay_wet_line(p, at, inner.exchange, inner.wet);
        step_root(inner, between_c, balance_with(p, at, inner.wet, between_c, inner.exchange));
        take(overshot, inner, root);
        root.slope = select(overshot, inner.slope, root.slope);
        root.turbulent = select(overshot, inner.turbulent, root.turbulent);
    }
    follow(root.vapour, p, root.surface_c);
}
// The fluxes at the root.
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE PointFluxes<Real> fluxes_at(const SurfacePoint<Real, Mask, Wetness>& p,
                                             const SurfaceRoot<Real, Wetness>& root)
{
    return fluxes_with(p, humidity_at(root.vapour, root.surface_c), root.wet, root.surface_c,
                       root.exchange);
}

}  // namespace petrichor::weather::detail

#endif
