// Saturation vapour pressure about a temperature: one exponential serves all evaluations within 4 K
// of it.
//
//   ln e(T) - ln e(T0) = a b (T-T0) / ((b+T0) (b+T)) =: d = slope (T-T0) w, slope = d ln e/dT at T0
//   w = 1 / (1+u) = (1 - u) (1 + u^2) + u^4 .., u = (T-T0) / (b+T0)
//   e(T) / e(T0) - 1 = d + d^2/2 + .. + d^6/720
//
// Exact at T0; relative error at 4 K below 1e-7 from -30 C up, 4e-7 from -70 C; at 1 K below 1e-9.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_SATURATION_CURVE_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_SATURATION_CURVE_H

#include "weather/physics/detail/formulas.h"

namespace petrichor::weather::detail {

inline constexpr double kCurveReach_k = 4.0;

template <class Real>
struct SaturationCurve {
    Real middle_c;  // T0
    Real inverse;   // 1 / (b + T0)
    Real slope;     // d ln e / dT at T0, 1/K
};
template <class Real>
struct SaturationPoint {
    Real growth;  // e / e(T0) - 1
    Real slope;   // d ln e / dT
};

// Centres the curve of the law scale exp(a T / (b + T)) on a temperature; returns e there, Pa.
template <class Real>
PETRICHOR_INLINE Real centre_curve(SaturationCurve<Real>& curve, const Real& a, const Real& b,
                                   const Real& scale_pa, const Real& t_c)
{
    curve.middle_c = t_c;
    curve.inverse = 1.0 / (b + t_c);
    curve.slope = a * b * curve.inverse * curve.inverse;
    return scale_pa * exponential(a * t_c * curve.inverse);
}
template <class Real>
PETRICHOR_INLINE SaturationPoint<Real> point_of(const SaturationCurve<Real>& curve, const Real& t_c)
{
    const Real step = t_c - curve.middle_c;
    const Real u = step * curve.inverse;
    const Real w = (1.0 - u) * (u * u + 1.0);
    const Real d = curve.slope * step * w;
    const Real dd = d * d;
    const Real p12 = d * 0.5 + 1.0;
    const Real p34 = d * (1.0 / 24.0) + 1.0 / 6.0;
    const Real p56 = d * (1.0 / 720.0) + 1.0 / 120.0;
    return {d * ((p56 * dd + p34) * dd + p12), curve.slope * (w * w)};
}

}  // namespace petrichor::weather::detail

#endif
