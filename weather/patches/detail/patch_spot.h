// The numbers of a patch among those of its block.
#ifndef PETRICHOR_WEATHER_PATCHES_DETAIL_PATCH_SPOT_H
#define PETRICHOR_WEATHER_PATCHES_DETAIL_PATCH_SPOT_H

#include "weather/patches/detail/patch_steps.h"

namespace petrichor::weather::detail {

inline constexpr std::size_t kIce = PETRICHOR_CELL_NUMBER(snow_ice);
inline constexpr std::size_t kLiquid = PETRICHOR_CELL_NUMBER(snow_liquid);
inline constexpr std::size_t kThick = PETRICHOR_CELL_NUMBER(snow_thickness);
inline constexpr std::size_t kTemp = PETRICHOR_CELL_NUMBER(snow_temp_c);

struct Spot {
    CellBlock& block;
    std::size_t lane;
    double& at(std::size_t which) const { return number(block, which, lane); }
};
inline Spot spot_of(PatchLive& live, const PatchTables& t, std::size_t patch)
{
    const std::size_t slot = t.slot_of_patch[patch];
    return {live.blocks[slot / kPatchLanes], slot % kPatchLanes};
}

}  // namespace petrichor::weather::detail

#endif
