// What a depth map of the sun or a lamp would hold around a point if the surface there went on as a plane. Each texel of a
// filter is compared with that plane at its own middle, so that a flat surface never shadows itself and needs no
// lift off itself, however wide the filter is and however low the light (Isidoro 2006: receiver plane depth bias).
#ifndef PETRICHOR_FORMULAS_LIGHT_SHADOW_PLANE_H
#define PETRICHOR_FORMULAS_LIGHT_SHADOW_PLANE_H

#include "base/interop.h"

SHARED_BEGIN

// Beyond this tangent of the angle between a surface and the light's way a plane is not followed: a normal that is
// off by little would move it by a lot.
SHARED_CONST float kShadowPlaneTangent = 12.0f;

// Less than half a degree from the light's way a surface is lifted no further: it would get past what shadows it, and its
// normal map would show it in full sunlight.
SHARED_CONST float kShadowMostTangent = 114.0f;

// Texels along the light's way that a surface is lifted before it is compared: what stands on it, a wall in a corner, is not
// to darken its foot, and what is steeper than the plane that is followed is not to shadow itself. facing: cosine
// between the surface and the light. radius: texels, of the filter with the four around its farthest place.
SHARED_FN float shadow_lift_texels(float facing, float least, float radius)
{
    const float c = max(abs(facing), 1.0e-3f);
    const float tangent = sqrt(max(1.0f - c * c, 0.0f)) / c;
    return least + radius * max(min(tangent, kShadowMostTangent) - kShadowPlaneTangent, 0.0f);
}

// Change of a parallel map's depth per unit of u and of v along a plane with the unit normal n. u, v, depth: the map's
// gradients, of its coordinates per metre, at right angles to each other. 0 along a plane that the light grazes from behind.
SHARED_FN vec2 shadow_plane_slope(vec3 n, vec3 u, vec3 v, vec3 depth)
{
    const float uu = max(dot(u, u), 1.0e-20f);
    const float vv = max(dot(v, v), 1.0e-20f);
    const float dd = dot(depth, depth);
    const float inv_d = inversesqrt(max(dd, 1.0e-20f));
    // Both in metres along the light's way for a metre across it.
    const vec2 across = vec2(dot(n, u) * inversesqrt(uu), dot(n, v) * inversesqrt(vv));
    const float facing = dot(n, depth) * inv_d;
    const float steep = length(across);
    if (!(steep > 0.0f)) return splat2(0.0f);
    const float tangent = min(steep / max(abs(facing), 1.0e-6f), kShadowPlaneTangent);
    const vec2 metres = across * (-tangent * (facing < 0.0f ? -1.0f : 1.0f) / steep);
    const float per_metre = dd * inv_d;
    return vec2(metres.x * per_metre * inversesqrt(uu), metres.y * per_metre * inversesqrt(vv));
}

// The same of a lamp's map, which holds one over the way along the middle of its face: change of that per unit of the tangent
// across the face. d: from the lamp; on_face: the parts of n across the face.
SHARED_FN vec2 lamp_plane_slope(vec3 n, vec3 d, vec2 on_face)
{
    const float off = dot(n, d);
    const float least = length(d) * inversesqrt(1.0f + kShadowPlaneTangent * kShadowPlaneTangent);
    return on_face / (off < 0.0f ? min(off, -least) : max(off, least));
}

// Weights of the four texels around a place between their middles: (left, right) above, then below.
SHARED_FN vec4 four_texel_weights(vec2 part)
{
    return vec4((1.0f - part.x) * (1.0f - part.y), part.x * (1.0f - part.y), (1.0f - part.x) * part.y,
                part.x * part.y);
}

// Share of four texels that is lit: depths of the map and those of the plane there (larger is nearer to the light).
SHARED_FN float four_texels_lit(vec4 stored, vec4 plane, vec4 weights)
{
    return (plane.x >= stored.x ? weights.x : 0.0f) + (plane.y >= stored.y ? weights.y : 0.0f) +
           (plane.z >= stored.z ? weights.z : 0.0f) + (plane.w >= stored.w ? weights.w : 0.0f);
}

SHARED_END

#endif
