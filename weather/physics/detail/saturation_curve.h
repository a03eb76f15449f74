// Saturation vapour pressure about a temperature: one exponential serves all evaluations within 4 K
// of it.
//
//   ln e(T) - ln e(T0) = a b (T-T0) / ((b+T0) (b+T)) =: d
//   d = slope (T-T0) (1 - u + u^2 - u^3 + ..), u = (T-T0) / (b+T0), slope = d ln e/dT at T0
//   e(T) = e(T0) (1 + d + d^2/2 + .. + d^8/40320)
//
// Exact at T0; relative error at 4 K below 1e-10 from 0 C up, 1e-9 from -30 C, 3e-8 from -70 C.
#ifndef PETRICHOR_WEATHER_DETAIL_SATURATION_CURVE_H
#define PETRICHOR_WEATHER_DETAIL_SATURATION_CURVE_H

#include "weather/physics/detail/formulas.h"

namespace petrichor::weather::detail {

inline constexpr double kCurveReach_k = 4.0;

template <class Real>
struct SaturationCurve {
    Real a, b, scale;  // of the law: water or ice
    Real middle_c;     // T0
    Real inverse;      // 1 / (b + T0)
    Real pressure_pa;  // e(T0)
    Real slope;        // d ln e / dT at T0, 1/K
};
template <class Real>
struct SaturationPoint {
    Real pressure_pa, growth;  // e, and e / e(T0) - 1
    Real slope;                // d ln e / dT
};

template <class Real>
PETRICHOR_INLINE void centre_curve(SaturationCurve<Real>& curve, const Real& t_c)
{
    curve.middle_c = t_c;
    curve.inverse = 1.0 / (curve.b + t_c);
    curve.pressure_pa = curve.scale * exponential(curve.a * t_c * curve.inverse);
    curve.slope = curve.a * curve.b * curve.inverse * curve.inverse;
}
template <class Real>
PETRICHOR_INLINE SaturationCurve<Real> water_curve(const Real& t_c)
{
    SaturationCurve<Real> curve;
    curve.a = Real(kWaterA);
    curve.b = Real(kWaterB);
    curve.scale = Real(kWaterScale_pa);
    centre_curve(curve, t_c);
    return curve;
}
template <class Real>
PETRICHOR_INLINE SaturationPoint<Real> point_of(const SaturationCurve<Real>& curve, const Real& t_c)
{
    const Real step = t_c - curve.middle_c;
    const Real u = step * curve.inverse;
    const Real uu = u * u;
    const Real d = curve.slope * step * ((1.0 - u) * (uu + 1.0) * (uu * uu + 1.0));
    const Real dd = d * d;
    const Real p01 = d * 0.5 + 1.0;
    const Real p23 = d * (1.0 / 24.0) + 1.0 / 6.0;
    const Real p45 = d * (1.0 / 720.0) + 1.0 / 120.0;
    const Real p67 = d * (1.0 / 40320.0) + 1.0 / 5040.0;
    SaturationPoint<Real> p;
    p.growth = d * ((p01 + dd * p23) + dd * dd * (p45 + dd * p67));
    p.pressure_pa = curve.pressure_pa + curve.pressure_pa * p.growth;
    p.slope = curve.slope * (1.0 - u * 2.0 + uu * 3.0 - uu * u * 4.0);
    return p;
}

}  // namespace petrichor::weather::detail

#endif
