// What reaches a place of what falls from the sky, and what it leaves there.
//
// One text for C++ and GLSL. A share is that of the rain or snow on open flat ground.
#ifndef PETRICHOR_FORMULAS_WEATHER_FALLS_HERE_H
#define PETRICHOR_FORMULAS_WEATHER_FALLS_HERE_H

#include "base/interop.h"

SHARED_BEGIN

// Flux on a plane with normal n of what falls towards -from, over that on the ground: more on roofs and
// walls that face it, none on those that look away. Near the horizon held in bounds. In two steps, since the first is
// the same for all points.
SHARED_FN vec3 facing_level(vec3 from)
{
    return from * (1.0f / max(from.y, 0.3f));
}
SHARED_FN float facing_on_level(vec3 n, vec3 level)
{
    return clamp(dot(n, level), 0.0f, 1.5f);
}
SHARED_FN float facing_share(vec3 n, vec3 from)
{
    return facing_on_level(n, facing_level(from));
}

// Of snow only what looks away gets none: how much holds on a slope is for the law of the cover to say,
// and eddies carry it to lee sides.
SHARED_FN float snow_facing_share(float facing)
{
    return min(4.0f * facing, 1.0f);
}

// Of the film: a few tenths of a millimetre fill it, so that a place that gets a tenth of the rain is
// wet soon after an open one.
SHARED_FN float film_share(float share)
{
    return 1.0f - exp(-10.0f * share);
}

// Wetness by the water of a film, as the physical model's (weather/models/physical/mapping.h).
SHARED_FN float wetness_of_film(float film_mm)
{
    return 1.0f - exp(-max(film_mm, 0.0f) / 0.25f);
}

// Of the level in cracks and puddles: what falls beside them runs in. 1 in the open.
SHARED_FN float flood_share(float share)
{
    return min((1.0f - exp(-4.0f * share)) * 1.0186574f, 1.0f);
}

// Both of one place.
struct FallShares {
    float film;
    float flood;
};
SHARED_FN FallShares fall_shares(float share)
{
    const float dry = exp(-2.0f * share);
    const float dry_2 = dry * dry;
    FallShares shares;
    shares.film = 1.0f - dry_2 * dry_2 * dry;
    shares.flood = min((1.0f - dry_2) * 1.0186574f, 1.0f);
    return shares;
}

// Of a cover that approaches 1 exponentially as more falls: the one that a share of it leaves.
SHARED_FN float cover_of_share(float cover, float share)
{
    return 1.0f - pow(1.0f - min(cover, 0.999f), share);
}

SHARED_END

#endif
