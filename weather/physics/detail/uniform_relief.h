// A relief whose heights are all equally frequent (stores.h), as templates over double and Lanes:
// F = z / depth, V = h^2 / (2 depth). Depths and levels in mm.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_UNIFORM_RELIEF_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_UNIFORM_RELIEF_H

#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather::detail {

template <class Real>
PETRICHOR_INLINE Real uniform_level_of(const Real& stored, double depth)
{
    return smaller(square_root(larger(stored, Real(0.0)) * (2.0 * depth)), Real(depth));
}
template <class Real>
PETRICHOR_INLINE Real uniform_volume_at(const Real& level, double depth)
{
    const Real h = clamped(level, Real(0.0), Real(depth));
    return h * h * (0.5 / depth);
}
template <class Real>
PETRICHOR_INLINE Real uniform_area_at(const Real& level, double depth)
{
    return level * (1.0 / depth);
}

}  // namespace petrichor::weather::detail

#endif
