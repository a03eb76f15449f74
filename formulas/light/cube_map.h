// Directions of a cube map, in Vulkan's order and orientation of its faces.
#ifndef PETRICHOR_FORMULAS_LIGHT_CUBE_MAP_H
#define PETRICHOR_FORMULAS_LIGHT_CUBE_MAP_H

#include "base/interop.h"

SHARED_BEGIN

// Direction through st, each -1..1, of a face; not unit.
SHARED_FN vec3 cube_direction(int face, vec2 st)
{
    if (face == 0) return vec3(1.0f, -st.y, -st.x);
    if (face == 1) return vec3(-1.0f, -st.y, st.x);
    if (face == 2) return vec3(st.x, 1.0f, st.y);
    if (face == 3) return vec3(st.x, -1.0f, -st.y);
    if (face == 4) return vec3(st.x, -st.y, 1.0f);
    return vec3(-st.x, -st.y, -1.0f);
}

// Solid angle of a texel relative to others of a face.
SHARED_FN float cube_texel_weight(vec2 st)
{
    const float q = 1.0f + dot(st, st);
    return 1.0f / (q * sqrt(q));
}

// A cubic spline (B-spline) along one axis of a texture in two looks of a filter that is linear between texels (Sigg and
// Hadwiger 2005). f: 0..1 between the middles of two texels. x, y: where to look, texels from the first of them; z: the share
// of the first look.
SHARED_FN vec3 spline_looks(float f)
{
    const float g = 1.0f - f;
    const float outer = g * g * g * (1.0f / 6.0f);
    const float beyond = f * f * f * (1.0f / 6.0f);
    const float low = outer + (4.0f - 6.0f * f * f + 3.0f * f * f * f) * (1.0f / 6.0f);
    return vec3(-outer / low, 1.0f + beyond / (1.0f - low), low);
}

SHARED_END

#endif
