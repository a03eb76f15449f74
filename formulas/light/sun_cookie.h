// A picture before the sun, told over the plane that faces it: shadows of leaves, of a window's bars, of
// clouds. C++ and GLSL. Its place turns with the sun and is fixed to the world's origin.
#ifndef PETRICHOR_FORMULAS_LIGHT_SUN_COOKIE_H
#define PETRICHOR_FORMULAS_LIGHT_SUN_COOKIE_H

#include "base/interop.h"

SHARED_BEGIN

// Across the picture, unit: level, to the right of who looks along the light. `sun` points towards it.
SHARED_FN vec3 sun_cookie_right(vec3 sun)
{
    const vec2 level = vec2(sun.z, -sun.x);
    const float size = length(level);
    if (size < 1.0e-4f) return vec3(1.0f, 0.0f, 0.0f);
    return vec3(level.x / size, 0.0f, level.y / size);
}

// Which of the pictures, each half as large as the one before, has texels as wide as a pixel's share of the
// scene; 0: the first. `last`: that of one texel.
SHARED_FN float sun_cookie_level(float pixel_m, float texel_m, float last)
{
    return clamp(log2(max(pixel_m / texel_m, 1.0f)), 0.0f, last);
}

SHARED_END

#endif
