// What standing water takes of the light on its way to the ground and back, and what fine mud in it sends back: clear over the
// stones of a shallow puddle, brown-grey over those of a pond.
//
// Beer and Lambert's law in three channels, along the refracted ways; the sum of both is that of a layer over a matt ground (Lee,
// Carder, Mobley, Steward and Patch 1998, in its plainest form): R = R_deep (1 - T) + R_ground T. Pure water at 610, 550 and 465 nm by Pope and
// Fry 1997. Rain water in a street has some tens of grams of fines a cubic metre, which take blue first; how much, and
// the colour of a bottomless puddle, are ours.
//
// One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_WEATHER_DEEP_WATER_H
#define PETRICHOR_FORMULAS_WEATHER_DEEP_WATER_H

#include "base/interop.h"

SHARED_BEGIN

// Water of a cover of 1 is at least so deep; the colour of what is shallower is that of a material's water_color alone.
SHARED_CONST float kClosedWater_m = 0.006f;
// Deeper than this nothing more is seen, nor kept.
SHARED_CONST float kDeepestWater_m = 1.0f;
// Ways down and back over the depth, in the mean of eyes that look down by 40 degrees.
SHARED_CONST float kMeanWaterWay = 2.35f;

// Taken on a metre: by pure water, by the fines of a street.
SHARED_FN vec3 pure_water_takes_per_m() { return vec3(0.264f, 0.057f, 0.010f); }
SHARED_FN vec3 mud_takes_per_m() { return vec3(6.6f, 8.2f, 10.8f); }
// mud: fines in the water over those of rain water in a street.
SHARED_FN vec3 water_takes_per_m(float mud) { return pure_water_takes_per_m() + mud * mud_takes_per_m(); }
// Albedo of a puddle whose ground is not seen: what it sends back are the fines, which are all that takes light from a mud of a tenth on.
SHARED_FN vec3 bottomless_water(float mud)
{
    const vec3 fines = mud_takes_per_m();
    const vec3 of_street = vec3(0.115f, 0.100f, 0.079f) * water_takes_per_m(1.0f) / fines;
    return of_street * (mud * fines) / water_takes_per_m(mud);
}

// Ways down and back over the depth: daylight goes down at a mean of 1.2, what goes up to the eye is bent (n = 1.33).
SHARED_FN float water_way(float eye_cosine)
{
    const float bent_2 = (1.0f - eye_cosine * eye_cosine) * (1.0f / (1.33f * 1.33f));
    return 1.2f + inversesqrt(1.0f - clamp(bent_2, 0.0f, 0.5654f));
}

// Share of the light that passes so long a way.
SHARED_FN vec3 water_passes(float way_m, float mud)
{
    const vec3 takes = water_takes_per_m(mud);
    return vec3(exp(-takes.x * way_m), exp(-takes.y * way_m), exp(-takes.z * way_m));
}

// The same of all water at a place. water: its cover, which is 1 where it closes. Up to there the water of a street counts as clear, what
// is muddier by the mud that it has more.
SHARED_FN vec3 standing_water_passes(float water, float deeper_m, float way, float mud)
{
    const vec3 more = mud_takes_per_m() * (max(mud - 1.0f, 0.0f) * kClosedWater_m * water * way);
    const vec3 passes = water_passes(deeper_m * way, mud);
    return passes * vec3(exp(-more.x), exp(-more.y), exp(-more.z));
}

// How much of a murky water's colour hides what is below, where it has `opacity` when it closes (kClosedWater_m).
SHARED_FN float murk_hides(float opacity, float deeper_m, float way)
{
    const float depths = deeper_m * way * (1.0f / (kClosedWater_m * kMeanWaterWay));
    return 1.0f - exp(depths * log(max(1.0f - opacity, 1.0e-4f)));
}

// Depths of 0..1 m in eight bits, a third of a millimetre apart at 2 mm, 2.5 at 10 cm.
SHARED_FN float water_depth_code(float deeper_m) { return sqrt(clamp(deeper_m, 0.0f, kDeepestWater_m)); }
SHARED_FN float water_depth_of(float code) { return code * code; }

SHARED_END

#endif
