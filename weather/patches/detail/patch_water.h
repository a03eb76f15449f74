// What patches give to each other: splashes, run-off, water let in, ponds. One thread, fixed order.
#ifndef PETRICHOR_WEATHER_PATCHES_DETAIL_PATCH_WATER_H
#define PETRICHOR_WEATHER_PATCHES_DETAIL_PATCH_WATER_H

#include "weather/patches/detail/patch_steps.h"

namespace petrichor::weather::detail {

// Changes the factors of rain and snow: rain that jumps from the ground to the foot of a wall, and
// snow that a slope does not hold and that lands below.
void share_what_falls(const PatchLive& live, const PatchTables& tables, PatchScratch& scratch);

// Water on its way to another patch, a pond, or out of the scene.
void pour_on(PatchLive& live, const PatchTables& tables, std::uint32_t target, double kg,
             PatchScratch& scratch);

// Water from taps, on its way over patches and on to ponds. Before run_off.
void let_water_in(PatchLive& live, const PatchTables& tables, const SkyStep& sky,
                  const std::vector<PatchTap>& taps, const Ponds& ponds, PatchScratch& scratch);

// What the patches shed in a step runs down: each takes what its stores lack and its ground soaks
// up, and passes on the rest.
void run_off(PatchLive& live, const PatchTables& tables, double dt_s, PatchScratch& scratch);

void step_ponds(PatchLive& live, const PatchTables& tables, const SkyStep& sky, const Ponds& ponds,
                PatchScratch& scratch);

}  // namespace petrichor::weather::detail

#endif
