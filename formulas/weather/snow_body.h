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

// Share of the body at a place x, z of the world, metres, 0..1. Fresh snow ends where it is a centimetre deep, give or
// take; melting snow goes in patches of a hand's to a foot's width, by depths up to five. Rises with the depth, 0 at 0
// and 1 from SNOW_BODIED_M on, and falls with the thaw. Ours; widths and depths chosen by eye.
//   melt_exp  of the weather of the frame, 0..1
SHARED_FN float snow_body_share(float deep_m, vec2 place_m, float melt_exp)
{
    const float n = 0.62f * endless_noise(place_m / 0.34f, 71u) + 0.38f * endless_noise(place_m / 0.093f, 72u);
    const float most_m = mix(0.014f, 0.05f, clamp(3.0f * melt_exp, 0.0f, 1.0f));
    const float needed_m = mix(0.007f, most_m, clamp((n - 0.5f) * 1.7f + 0.5f, 0.0f, 1.0f));
    return smooth_edge(needed_m - 0.006f, needed_m + 0.006f, deep_m);
}

SHARED_END

#endif
