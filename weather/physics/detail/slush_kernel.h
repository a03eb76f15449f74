// Snow and water on the ground together.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_SLUSH_KERNEL_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_SLUSH_KERNEL_H

#include "weather/physics/cell_state.h"
#include "weather/physics/detail/lanes.h"

namespace petrichor::weather::detail {

// Snow on water is slush until its water, with that of the film below it, is more than half of
// its ice. The film up to which it is, kg/m2; 0 or less without snow.
template <class Real>
PETRICHOR_INLINE Real slush_limit(const CellVars<Real>& c)
{
    return (c.snow_ice[0] + c.snow_ice[1] + c.snow_ice[2]) * 0.5 -
           (c.snow_liquid[0] + c.snow_liquid[1] + c.snow_liquid[2]);
}

}  // namespace petrichor::weather::detail

#endif
