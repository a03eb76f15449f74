// Snow that moves over patches: slides, heaps that come to rest, drifts. One thread, fixed order.
#ifndef PETRICHOR_WEATHER_PATCHES_DETAIL_PATCH_SNOW_H
#define PETRICHOR_WEATHER_PATCHES_DETAIL_PATCH_SNOW_H

#include "weather/patches/detail/patch_steps.h"

namespace petrichor::weather::detail {

// How long the snow of a patch holds once its base is wet, over its mean: of an exponential law, the
// same from the ridge to the eaves and often in the strips beside, so that roofs shed it in pieces.
// By patch.
std::vector<double> slide_patience(const PatchTables& tables, const PatchSet& set);

// Snow that leaves roofs, taking along what lies below it, and heaps that come to rest.
void slide_snow(PatchLive& live, const PatchTables& tables, double dt_s, PatchScratch& scratch);

// Wind takes dry snow from where it blows and lays it down where it is slower.
void drift_snow(PatchLive& live, const PatchTables& tables, const SkyStep& sky,
                PatchScratch& scratch);

}  // namespace petrichor::weather::detail

#endif
