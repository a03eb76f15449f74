// Where what falls strays to on its last metre: splashes and eddies carry it aside, so that the edge of a shelter wanders.
//
// One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_WEATHER_WANDER_H
#define PETRICHOR_FORMULAS_WEATHER_WANDER_H

#include "base/interop.h"

SHARED_BEGIN

// -1..1: parabolas in place of a sine's halves, at a third of its price. turns: one is a wave.
SHARED_FN vec2 arches(vec2 turns)
{
    const vec2 t = 2.0f * fract(turns) - splat2(1.0f);
    return 4.0f * t * (splat2(1.0f) - abs(t));
}

// -1..1 each, of a place on the ground. Waves of half a metre to two, turned and bent by each other so that they do not
// repeat within a street; their mean is 0.
SHARED_FN vec2 wander(vec2 at_m)
{
    const vec2 wide = arches(vec2(0.53f * at_m.x + 0.31f * at_m.y, 0.59f * at_m.y - 0.27f * at_m.x));
    const vec2 bent = at_m + 0.2f * vec2(wide.y, wide.x);
    const vec2 fine = arches(vec2(1.37f * bent.x - 1.13f * bent.y, 1.51f * bent.x + 1.19f * bent.y));
    return 0.6f * wide + 0.4f * fine;
}

SHARED_END

#endif
