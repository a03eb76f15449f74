// What patches give to each other: splashes, run-off, snow that slides. One thread, fixed order.
#ifndef PETRICHOR_WEATHER_PATCHES_DETAIL_PATCH_WATER_H
#define PETRICHOR_WEATHER_PATCHES_DETAIL_PATCH_WATER_H

#include "weather/patches/detail/patch_steps.h"

namespace petrichor::weather::detail {

// Changes the factors of rain and snow: rain that jumps from the ground to the foot of a wall, and
// snow that a slope does not hold and that lands below.
void share_what_falls(const PatchLive& live, const PatchTables& tables, PatchScratch& scratch);

// Snow that leaves smooth roofs, and heaps that come to rest.
void slide_snow(PatchLive& live, const PatchTables& tables, PatchScratch& scratch);

// What the patches shed in a step runs down: each takes what its stores lack and its ground soaks
// up, and passes on the rest.
void run_off(PatchLive& live, const PatchTables& tables, double dt_s, PatchScratch& scratch);

void step_ponds(PatchLive& live, const PatchTables& tables, const SkyStep& sky, const Ponds& ponds,
                PatchScratch& scratch);

}  // namespace petrichor::weather::detail

#endif
