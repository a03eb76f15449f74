// The two sweeps through the ground: equivalent temperatures upward, new temperatures downward.
#ifndef PETRICHOR_WEATHER_DETAIL_GROUND_KERNEL_H
#define PETRICHOR_WEATHER_DETAIL_GROUND_KERNEL_H

#include "weather/physics/detail/lanes.h"
#include "weather/physics/ground.h"

namespace petrichor::weather::detail {

// Fills equivalent[i], the equivalent temperature at node i; returns the one seen from the surface.
template <class Real>
PETRICHOR_INLINE Real ground_equivalent(const GroundStack& stack, const Real* temp, double deep,
                                        Real* equivalent)
{
    Real below = deep;
    for (std::size_t i = kGroundLayers; i-- > 0;) {
        below = below * stack.weight_below[i] + temp[i] * stack.weight_own[i];
        equivalent[i] = below;
    }
    return below;
}

// New node temperatures from that of the surface. Every line is a weighted mean: nothing can grow.
// The next interface comes straight from the last one, so that the layers do not wait for each
// other's temperatures.
template <class Real>
PETRICHOR_INLINE void ground_update(const GroundStack& stack, const Real& surface,
                                    const Real* equivalent, Real* temp)
{
    Real interface = surface;
    for (std::size_t i = 0; i < kGroundLayers; ++i) {
        temp[i] = equivalent[i] + (interface - equivalent[i]) * stack.share_top[i];
        if (i + 1 < kGroundLayers) {
            const Real rest =
                equivalent[i] * stack.through_own[i] + equivalent[i + 1] * stack.through_below[i];
            interface = interface * stack.through_top[i] + rest;
        }
    }
}

}  // namespace petrichor::weather::detail

#endif
