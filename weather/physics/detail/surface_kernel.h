// One surface point: its energy balance and Newton's method on it. Degrees Celsius inside.
#ifndef PETRICHOR_WEATHER_DETAIL_SURFACE_KERNEL_H
#define PETRICHOR_WEATHER_DETAIL_SURFACE_KERNEL_H

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
PETRICHOR_INLINE FixedShares<Real> chosen(const Mask& mask, const FixedShares<Real>& a,
                                          const FixedShares<Real>& b)
{
    return {{select(mask, a.all.mean, b.all.mean), select(mask, a.all.end, b.all.end)}};
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
// What evaporates as a line through one evaluation of the shares, at `potential_rate`.
template <class Wetness, class Real>
struct WetLine {
    typename Wetness::Shares shares;
    Real potential_rate;

    PETRICHOR_INLINE Real vapour(const Real& potential) const
    {
        const Real line =
            shares.all.mean * potential_rate + shares.all.end * (potential - potential_rate);
        return smaller(line, potential);
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
    Real neutral;       // CHn
    Real richardson_k;  // g zU / (Ta U^2), 1/K
    Real root_z;        // sqrt(zU/z0)
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

// Saturation humidity of the surface near a temperature.
template <class Real>
struct SurfaceVapour {
    SaturationCurve<Real> curve;
    Real dry;  // 1 / (P - 0.378 e) at the middle of the curve
};
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE void centre_dry(SurfaceVapour<Real>& v, const SurfacePoint<Real, Mask, Wetness>& p)
{
    v.dry = 1.0 / (p.pressure - v.curve.pressure_pa * (1.0 - kWaterToAirMass));
}
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE void centre_vapour(SurfaceVapour<Real>& v,
                                    const SurfacePoint<Real, Mask, Wetness>& p,
                                    const Real& surface_c)
{
    v.curve.a = select(p.icy, Real(kIceA), Real(kWaterA));
    v.curve.b = select(p.icy, Real(kIceB), Real(kWaterB));
    v.curve.scale = select(p.icy, Real(kIceScale_pa), Real(kWaterScale_pa));
    centre_curve(v.curve, surface_c);
    centre_dry(v, p);
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
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE void follow(SurfaceVapour<Real>& v, const SurfacePoint<Real, Mask, Wetness>& p,
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
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE SurfaceVapour<Real> vapour_at_melting_point(
    const SurfaceVapour<Real>& v, const SurfacePoint<Real, Mask, Wetness>& p)
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
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE Real exchange_at(const SurfacePoint<Real, Mask, Wetness>& p,
                                  const ExchangeParams& params, const Real& surface_c)
{
    if (params.stability == Stability::Neutral) return p.exchange;
    Real ri = p.richardson_k * (p.air_c - surface_c);
    if (params.stability == Stability::LouisCapped) ri = smaller(ri, Real(params.max_richardson));
    return p.exchange * stability_factor_of(ri, p.neutral, p.root_z);
}

constexpr double kLongestStep_k = 20.0;
constexpr double kOvershoot_w_m2 = 20.0;

// Saturation humidity of the surface and its slope.
template <class Real>
struct SurfaceHumidity {
    Real q, dq;
};
//   dry  1 / (P - 0.378 e)
template <class Real>
PETRICHOR_INLINE SurfaceHumidity<Real> humidity_of(const Real& pressure, const Real& vapour_pa,
                                                   const Real& vapour_slope, const Real& dry)
{
    // dq/dT = q P / (P - 0.378 e) * d(ln e)/dT
    const Real q = vapour_pa * kWaterToAirMass * dry;
    return {q, q * pressure * dry * vapour_slope};
}
// At the middle of the curve.
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE SurfaceHumidity<Real> humidity_at_middle(
    const SurfacePoint<Real, Mask, Wetness>& p, const SurfaceVapour<Real>& v)
{
    return humidity_of(p.pressure, v.curve.pressure_pa, v.curve.slope, v.dry);
}
// At a temperature within reach of the curve.
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE SurfaceHumidity<Real> humidity_at(const SurfacePoint<Real, Mask, Wetness>& p,
                                                   const SurfaceVapour<Real>& v,
                                                   const Real& surface_c)
{
    const SaturationPoint<Real> s = point_of(v.curve, surface_c);
    // 1 / (P - 0.378 e) from its value at the middle; h is at most a few thousandths.
    const Real h = v.curve.pressure_pa * s.growth * v.dry * (1.0 - kWaterToAirMass);
    return humidity_of(p.pressure, s.pressure_pa, s.slope, v.dry * ((h + 1.0) * (h * h + 1.0)));
}

// Structs of lanes go by reference: copying them costs more than the arithmetic.
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE void lay_wet_line(const SurfacePoint<Real, Mask, Wetness>& p,
                                   const SurfaceHumidity<Real>& at, const Real& exchange,
                                   WetLine<Wetness, Real>& line)
{
    line.potential_rate = exchange * (at.q - p.q_air);
    p.wet.share(line.potential_rate, line.shares);
}

// F and -dF/dTs at a surface temperature, with a given exchange.
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE PointFluxes<Real> fluxes_with(const SurfacePoint<Real, Mask, Wetness>& p,
                                               const SurfaceHumidity<Real>& at,
                                               const WetLine<Wetness, Real>& wet,
                                               const Real& surface_c, const Real& exchange)
{
    const Real surface_k = surface_c + kZeroCelsiusK;
    const Real cubed = surface_k * surface_k * surface_k;
    // Dew and frost settle on dry ground too: only a loss is scaled by the wet fraction.
    const auto dew = at.q < p.q_air;
    PointFluxes<Real> f;
    f.net_radiation = p.absorbed - p.emitting * cubed * surface_k;
    f.sensible = exchange * kAirHeatCapacity * (surface_c - p.air_c);
    const Real potential = exchange * (at.q - p.q_air);
    const Real wanted = select(dew, potential, wet.vapour(potential));
    const auto limited = wanted > p.most_vapour;
    f.vapour = select(limited, p.most_vapour, wanted);
    f.latent = p.latent_heat * f.vapour;
    f.ground = p.conductance * (surface_c - p.below_c);
    f.rain_heat = p.rain_heat * (p.air_c - surface_c);
    f.balance = f.net_radiation - f.sensible - f.latent - f.ground + f.rain_heat;
    f.slope =
        p.emitting * cubed * 4.0 + exchange * kAirHeatCapacity +
        select(limited, Real(0.0),
               p.latent_heat * select(dew, Real(1.0), wet.shares.all.end) * exchange * at.dq) +
        p.conductance + p.rain_heat;
    // No step of Newton's is longer than 20 K: in calm air a cold surface in strong sun would be
    // thrown beyond boiling.
    f.slope = larger(f.slope, larger(f.balance, -f.balance) * (1.0 / kLongestStep_k));
    return f;
}

// Newton's three steps from a first guess; what the last one used. The wet shares of the second
// step serve the third: by then the temperature hardly moves.
template <class Real, class Wetness>
struct SurfaceRoot {
    Real surface_c, exchange;
    SurfaceVapour<Real> vapour;
    WetLine<Wetness, Real> wet;
};
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE SurfaceRoot<Real, Wetness> chosen(const Mask& mask,
                                                   const SurfaceRoot<Real, Wetness>& a,
                                                   const SurfaceRoot<Real, Wetness>& b)
{
    SurfaceRoot<Real, Wetness> root;
    root.surface_c = select(mask, a.surface_c, b.surface_c);
    root.exchange = select(mask, a.exchange, b.exchange);
    root.vapour = chosen(mask, a.vapour, b.vapour);
    root.wet.potential_rate = select(mask, a.wet.potential_rate, b.wet.potential_rate);
    root.wet.shares = chosen(mask, a.wet.shares, b.wet.shares);
    return root;
}
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE SurfaceRoot<Real, Wetness> surface_root(const SurfacePoint<Real, Mask, Wetness>& p,
                                                         const ExchangeParams& params,
                                                         const Real& first_guess_c)
{
    SurfaceRoot<Real, Wetness> root;
    centre_vapour(root.vapour, p, first_guess_c);
    root.exchange = exchange_at(p, params, first_guess_c);
    const auto humidity = humidity_at_middle(p, root.vapour);
    lay_wet_line(p, humidity, root.exchange, root.wet);
    const auto first = fluxes_with(p, humidity, root.wet, first_guess_c, root.exchange);
    const Real second_c = first_guess_c + first.balance / first.slope;

    follow(root.vapour, p, second_c);
    const Real second_exchange = exchange_at(p, params, second_c);
    const auto second_humidity = humidity_at(p, root.vapour, second_c);
    lay_wet_line(p, second_humidity, second_exchange, root.wet);
    const auto second = fluxes_with(p, second_humidity, root.wet, second_c, second_exchange);
    const Real third_c = second_c + second.balance / second.slope;

    follow(root.vapour, p, third_c);
    root.exchange = exchange_at(p, params, third_c);
    const auto third =
        fluxes_with(p, humidity_at(p, root.vapour, third_c), root.wet, third_c, root.exchange);
    root.surface_c = third_c + third.balance / third.slope;
    // In calm air the exchange itself depends so much on the surface that Newton's steps overshoot:
    // the root lies between the last two, and so does its exchange.
    const auto overshot = (second.balance * third.balance < 0.0) &
                          (larger(third.balance, -third.balance) > kOvershoot_w_m2);
    if (any(overshot)) {
        const Real share = second.balance / (second.balance - third.balance);
        const Real between_c = second_c + (third_c - second_c) * share;
        auto inner = root;
        inner.exchange = second_exchange + (root.exchange - second_exchange) * share;
        follow(inner.vapour, p, between_c);
        const auto at = humidity_at(p, inner.vapour, between_c);
        lay_wet_line(p, at, inner.exchange, inner.wet);
        const auto f = fluxes_with(p, at, inner.wet, between_c, inner.exchange);
        inner.surface_c = between_c + f.balance / f.slope;
        root = chosen(overshot, inner, root);
    }
    follow(root.vapour, p, root.surface_c);
    return root;
}
// The fluxes at the root.
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE PointFluxes<Real> fluxes_at(const SurfacePoint<Real, Mask, Wetness>& p,
                                             const SurfaceRoot<Real, Wetness>& root)
{
    return fluxes_with(p, humidity_at(p, root.vapour, root.surface_c), root.wet, root.surface_c,
                       root.exchange);
}

}  // namespace petrichor::weather::detail

#endif
