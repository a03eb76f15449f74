// Thin snow on wide ground. It lies among the blades and clods before it closes over them, so such ground turns pale by and by and over
// a slope, where on a road it is white or bare. No pixel shows a blade: what is seen is the share of white among them. Ours, by eye.
//
// One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_WEATHER_SNOW_IN_TURF_H
#define PETRICHOR_FORMULAS_WEATHER_SNOW_IN_TURF_H

#include "formulas/weather/surface_weather.h"

SHARED_BEGIN

// Share of what falls that stays on a slope: all of it up to 30 degrees, none from 60 degrees on. Patches know of it. up: y of the normal.
SHARED_FN float turf_holds(float up) { return smooth_edge(0.5f, 0.866f, up); }

// Share of white, 0..0.85, which is all that thin snow can be.
//   lies     amount of snow here, what its slope holds of it
//   mask     of the snow, around its mean of 0.7067
//   flatter  as SlopeRelief: 0 on what has none
SHARED_FN float snow_in_turf(float lies, float mask, float flatter)
{
    const float uneven = 1.0f + 1.1f * (mask - 0.7067f) + 0.75f * clamp(flatter, -2.0f, 2.0f);
    return 0.85f * saturate(1.35f * lies * max(uneven, 0.25f));
}

// What lies on a slope over what a flat triangle of the same place holds: that goes by the way it faces and by what it sees of the sky,
// and so does the ground, which is bent where the mesh has an edge. Without it snow ends along the edges of triangles. up: y of the normal.
SHARED_FN float snow_of_bend(float smooth_up, float flat_up)
{
    const float bent = max(smooth_up, 0.1f), plane = max(flat_up, 0.1f);
    return clamp(bent * (1.0f + bent) / (plane * (1.0f + plane)), 0.5f, 2.0f);
}

// The same over its mean: terraces and tufts hold what the steps between them shed, until all is filled. 1 in the mean.
SHARED_FN float snow_of_relief(float flatter, float amount) { return 1.0f + 0.4f * (1.0f - amount) * clamp(flatter, -2.0f, 2.0f); }

// Grass in snow: blades are bent down, and soil and dead leaves show between them. around: SnowCover::melt. Ours, by eye.
SHARED_FN vec3 turf_in_winter(vec3 base, float around)
{
    const float grey = dot(base, vec3(0.30f, 0.59f, 0.11f));
    const float green = smooth_edge(1.0f, 1.3f, base.y / max(max(base.x, base.z), 1.0e-4f));
    return mix(base, grey * vec3(0.86f, 0.72f, 0.46f), 0.75f * green * saturate(8.0f * around));
}

// Both kinds: where the one is bare the other shows.
SHARED_FN SnowCover with_snow_in_turf(SnowCover cover, float turf)
{
    SnowCover both;
    both.snow = cover.snow + (1.0f - cover.snow) * turf;
    both.melt = max(cover.melt, turf);
    return both;
}

SHARED_END

#endif
