// Branches above the cell: they catch snow and let it go.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_CANOPY_KERNEL_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_CANOPY_KERNEL_H

#include "weather/physics/detail/lanes.h"
#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather::detail {

inline constexpr double kCanopyHolds_kg_m2 = 4.4;  // for each m2 of leaves and branches over a m2
inline constexpr double kUnloadingCold_s = 240.0 * 3600.0;
inline constexpr double kUnloadingMelting_s = 2.4 * 3600.0;

// Snow that branches which hold `held` of at most `capacity` catch of `fallen`, kg/m2.
template <class Real>
PETRICHOR_INLINE Real caught_by_canopy(const Real& held, const Real& fallen, double capacity)
{
    const Real room = larger(capacity - held, Real(0.0));
    return room * (1.0 - exponential(fallen * (-1.0 / capacity)));
}

// Share of their load that branches lose in a step.
inline double unloaded_share(double dt_s, double efolding_s)
{
    return 1.0 - exponential(-dt_s / efolding_s);
}

// What reaches the ground of `fallen` in a step, with what slides off the branches. The last two
// are the shares of their load that they lose in the step.
template <class Real>
PETRICHOR_INLINE Real through_canopy(Real& held, const Real& fallen, const Real& air_c,
                                     double capacity, double lost_cold, double lost_melting)
{
    const Real caught = caught_by_canopy(held, fallen, capacity);
    const Real load = held + caught;
    const Real lost = load * select(air_c > 0.0, Real(lost_melting), Real(lost_cold));
    held = load - lost;
    return fallen - caught + lost;
}

}  // namespace petrichor::weather::detail

#endif
