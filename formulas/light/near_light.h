// Light of a polygon that is close to a point of a surface (scene/patches/near_light.h).
#ifndef PETRICHOR_FORMULAS_LIGHT_NEAR_LIGHT_H
#define PETRICHOR_FORMULAS_LIGHT_NEAR_LIGHT_H

#include "base/interop.h"
#include "formulas/light/area.h"

SHARED_BEGIN

// A corner's direction; a corner at the point itself has none.
SHARED_FN vec3 near_direction(vec3 corner)
{
    return corner * inversesqrt(max(dot(corner, corner), 1.0e-12f));
}

// Share of a hemisphere about n, by cosine, that a polygon of four corners fills, 0..1: Lambert's sum over
// its edges. Corners relative to the point, in turn from its front; 0 from behind. What of it is below the
// horizon takes away: whoever calls has cut it.
SHARED_FN float near_form_factor(vec3 a, vec3 b, vec3 c, vec3 d, vec3 n)
{
    const vec3 p = near_direction(a);
    const vec3 q = near_direction(b);
    const vec3 r = near_direction(c);
    const vec3 s = near_direction(d);
    const vec3 sum = edge_irradiance(q, p) + edge_irradiance(r, q) + edge_irradiance(s, r) +
                     edge_irradiance(p, s);
    return clamp(dot(sum, n), 0.0f, 1.0f);
}

SHARED_END

#endif
