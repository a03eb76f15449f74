// Relief that is seen below a surface: how far a ray goes until it meets it.
//
// One text for C++ and GLSL. Source: Lux 2.02 (docs/lux.md), whose second shift of plain parallax
// repeats the first; here it uses the second height. A depth of 0 is the geometry, 1 the bottom
// of the relief.
#ifndef PETRICHOR_FORMULAS_WEATHER_PARALLAX_H
#define PETRICHOR_FORMULAS_WEATHER_PARALLAX_H

#include "base/interop.h"

SHARED_BEGIN

// Way along the surface, metres, that a ray has gone when it is as deep as the relief. to_eye: unit;
// n: normal of the geometry. Shorter at grazing angles, none on edge.
SHARED_FN vec3 parallax_reach(vec3 n, vec3 to_eye, float depth_m)
{
    const float up = max(dot(n, to_eye), 0.0f);
    const float grazing = 1.0f - up;
    return (n * up - to_eye) * (depth_m * (1.0f - grazing * grazing) / max(up, 0.05f));
}

// Shares of two steps across the screen, in pixels, that make up a way along the surface: dx and dy
// are where the next pixels to the right and below lie.
SHARED_FN vec2 pixels_along(vec3 way, vec3 dx, vec3 dy)
{
    const float xx = dot(dx, dx);
    const float xy = dot(dx, dy);
    const float yy = dot(dy, dy);
    const float x = dot(dx, way);
    const float y = dot(dy, way);
    const float det = xx * yy - xy * xy;
    // On edge the two run into each other: no way is known.
    if (!(det > 1.0e-6f * xx * yy)) return splat2(0.0f);
    return vec2(yy * x - xy * y, xx * y - xy * x) / det;
}

// Between a depth where the ray is above the relief by `above` and one where it is below by `below`,
// each >= 0: where a straight relief is met.
SHARED_FN float secant_depth(float depth_above, float above, float depth_below, float below)
{
    return depth_above + (depth_below - depth_above) * (above / max(above + below, 1.0e-6f));
}

SHARED_END

#endif
