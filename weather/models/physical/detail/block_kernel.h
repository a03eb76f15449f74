// The kernel on blocks of eight cells. Included by the files that are compiled for one kind of
// register.
#ifndef PETRICHOR_WEATHER_MODELS_PHYSICAL_DETAIL_BLOCK_KERNEL_H
#define PETRICHOR_WEATHER_MODELS_PHYSICAL_DETAIL_BLOCK_KERNEL_H

#include <cstring>

#include "weather/models/physical/detail/cell_steps.h"

namespace petrichor::weather::detail {

template <int kBytes>
PETRICHOR_INLINE void advance_block(CellBlock& block, const PlaceBlock& place_block,
                                    const StepForcing* steps, std::size_t count,
                                    const CellConstants& k, const StepConstants& s)
{
    using Real = Lanes<kBytes>;
    static_assert(sizeof(CellVars<Real>) == sizeof(CellBlock));
    static_assert(sizeof(CellPlace<Real>) == sizeof(PlaceBlock));
    CellVars<Real> c;
    CellPlace<Real> place;
    std::memcpy(static_cast<void*>(&c), &block, sizeof block);
    std::memcpy(static_cast<void*>(&place), &place_block, sizeof place_block);
    advance_steps(c, steps, count, place, k, s);
    std::memcpy(static_cast<void*>(&block), &c, sizeof block);
}

}  // namespace petrichor::weather::detail

#endif
