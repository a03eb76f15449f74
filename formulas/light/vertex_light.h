// Lamps whose light is worked out at vertices: the photometry of those that light pixels (brdf.h), for both sides
// of a surface, divided by pi: what a white Lambert surface sends out.
#ifndef PETRICHOR_FORMULAS_LIGHT_VERTEX_LIGHT_H
#define PETRICHOR_FORMULAS_LIGHT_VERTEX_LIGHT_H

#include "base/interop.h"
#include "formulas/light/brdf.h"

SHARED_BEGIN

// The side that the normal points from, and the other.
struct LitSides {
    vec3 front;
    vec3 back;
};

// Share of a point's or a spot's candela that a vertex has as lux over pi where it faces the lamp, 1/m2.
//   to_lamp_m  from the vertex
//   axis       of a spot, unit; inner and outer are cosines of its cones; outer below -1.5: a point
SHARED_FN float vertex_falloff(vec3 to_lamp_m, float reach_m, vec3 axis, float inner, float outer)
{
    const float d2 = dot(to_lamp_m, to_lamp_m);
    const float inverse = inversesqrt(max(d2, 1.0e-8f));
    const float falloff = square_attenuation(d2, inverse, 1.0f / (reach_m * reach_m)) * (1.0f / kPi);
    const float cone = spot_attenuation(-dot(axis, to_lamp_m) * inverse, inner, outer);
    return outer > -1.5f ? falloff * cone : falloff;
}

//   facing  lux over pi of what faces the lamp
SHARED_FN LitSides lit_sides(vec3 normal, vec3 to_lamp_m, vec3 facing)
{
    const float cosine = dot(normal, to_lamp_m) * inversesqrt(max(dot(to_lamp_m, to_lamp_m), 1.0e-8f));
    LitSides lit;
    lit.front = facing * max(cosine, 0.0f);
    lit.back = facing * max(-cosine, 0.0f);
    return lit;
}

SHARED_END

#endif
