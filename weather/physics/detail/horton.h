// Horton's law over a time: what wet ground takes up, and how its capacity changes. The kernel and
// horton_depth_mm run this one text.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_HORTON_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_HORTON_H

#include "weather/physics/detail/portable_math.h"
#include "weather/physics/drainage.h"

namespace petrichor::weather::detail {

// What depends on the law and the length of the time only.
struct HortonStep {
    double hours = 0.0;
    double keep = 1.0, recover = 1.0;  // exp(-k hours) of wet and of dry ground
    double depth_h = 0.0;              // (1 - keep) / k, hours
};
inline HortonStep make_horton_step(const HortonParams& horton, double hours)
{
    HortonStep step;
    step.hours = hours;
    step.keep = exponential(-horton.decay_1_h * hours);
    step.recover = exponential(-horton.recovery_1_h * hours);
    step.depth_h = (1.0 - step.keep) / horton.decay_1_h;
    return step;
}

// Depth that wet ground takes up, mm.
template <class Real>
PETRICHOR_INLINE Real infiltration_depth(const Real& capacity_mm_h, const HortonStep& step,
                                         const HortonParams& horton)
{
    return (capacity_mm_h - horton.last_mm_h) * step.depth_h + horton.last_mm_h * step.hours;
}
// Capacity afterwards: of ground that was wet, and of ground that was dry.
template <class Real>
PETRICHOR_INLINE Real decayed_capacity(const Real& capacity_mm_h, const HortonStep& step,
                                       const HortonParams& horton)
{
    return (capacity_mm_h - horton.last_mm_h) * step.keep + horton.last_mm_h;
}
template <class Real>
PETRICHOR_INLINE Real recovered_capacity(const Real& capacity_mm_h, const HortonStep& step,
                                         const HortonParams& horton)
{
    return (capacity_mm_h - horton.first_mm_h) * step.recover + horton.first_mm_h;
}

}  // namespace petrichor::weather::detail

#endif
