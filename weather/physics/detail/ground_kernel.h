// The two sweeps through the ground: equivalent temperatures upward, new temperatures downward.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_GROUND_KERNEL_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_GROUND_KERNEL_H

#include "weather/physics/detail/lanes.h"
#include "weather/physics/ground.h"

namespace petrichor::weather::detail {

// Fills equivalent[i], the equivalent temperature at node i; returns the one seen from the surface.
template <class Real>
PETRICHOR_INLINE Real ground_equivalent(const GroundStack& stack, const Real* temp,
                                        const Real& deep, Real* equivalent)
{
    Real below = deep;
    for (std::size_t i = kGroundLayers; i-- > 0;) {
        below = below * stack.weight_below[i] + temp[i] * stack.weight_own[i];
        equivalent[i] = below;
    }
    return below;
}

// New node temperatures from that of the surface. Every line is a weighted mean: nothing can grow.
template <class Real>
PETRICHOR_INLINE void ground_update(const GroundStack& stack, const Real& surface,
                                    const Real* equivalent, Real* temp)
{
    Real above = surface;
    for (std::size_t i = 0; i < kGroundLayers; ++i) {
        above = equivalent[i] * stack.weight_equivalent[i] + above * stack.weight_above[i];
        temp[i] = above;
    }
}

}  // namespace petrichor::weather::detail

#endif
