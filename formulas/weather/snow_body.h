// Where snow that has a body ends: no line between two vertices, but as irregular as what lies below.
#ifndef PETRICHOR_FORMULAS_WEATHER_SNOW_BODY_H
#define PETRICHOR_FORMULAS_WEATHER_SNOW_BODY_H

#include "base/interop.h"
#include "formulas/noise/noise.h"
#include "formulas/weather/surface_weather.h"

SHARED_BEGIN

// A vertex tells depths up to here, metres: deeper snow has no edge.
SHARED_CONST float SNOW_BODIED_M = 0.06f;

// What a vertex tells of its depth, 1..0.
SHARED_FN float snow_body_code(float deep_m)
{
    return 1.0f - clamp(deep_m / SNOW_BODIED_M, 0.0f, 1.0f);
}

// Depth of thin snow over the relief of what it lies on: it settles between stones, so joints are the first that it fills
// and the last that it leaves. Above SNOW_BODIED_M it knows none. Rises with the depth, 0 at 0 and below. Ours; by eye.
//   over_m  how high the ground stands here over its mean, metres, -0.02..0.02
SHARED_FN float settled_snow_m(float deep_m, float over_m)
{
    const float thin = 1.0f - smooth_edge(0.02f, SNOW_BODIED_M, deep_m);
    return min(deep_m - 0.7f * thin * clamp(over_m, -0.02f, 0.02f), 4.0f * deep_m);
}

// Share of the body at a place x, z of the world, metres, 0..1. Fresh snow ends where it is a centimetre deep, give or
// take; melting snow goes in patches of a hand's to a foot's width, ragged to a finger's, by depths up to five, and its edge is
// thin slush. Rises with the depth, 0 at 0 and 1 from SNOW_BODIED_M on, and falls with the thaw. Ours; widths and depths
// chosen by eye.
//   over_m    as settled_snow_m
//   melt_exp  of the weather of the frame, 0..1
SHARED_FN float snow_body_share(float deep_m, float over_m, vec2 place_m, float melt_exp)
{
    const float n = 0.52f * endless_noise(place_m / 0.34f, 71u) + 0.28f * endless_noise(place_m / 0.093f, 72u) +
                    0.2f * endless_noise(place_m / 0.027f, 73u);
    const float thaw = clamp(3.0f * melt_exp, 0.0f, 1.0f);
    const float needed_m = mix(0.007f, mix(0.014f, 0.05f, thaw), clamp((n - 0.5f) * 1.9f + 0.5f, 0.0f, 1.0f));
    return smooth_edge(needed_m - 0.006f, min(needed_m + mix(0.006f, 0.012f, thaw), SNOW_BODIED_M), settled_snow_m(deep_m, over_m));
}

SHARED_END

#endif
