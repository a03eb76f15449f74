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

SHARED_END

#endif
