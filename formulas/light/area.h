// Light of a glowing rectangle: the vector of its irradiance, in closed form.
//
// Lambert's sum over the edges of a polygon gives a vector F: a surface that faces its direction
// gets the irradiance pi L |F|, any other that sees the whole rectangle pi L (n . F). Where the
// horizon cuts it, a sphere of the same |F| stands in, whose clipped form factor is known (Snyder
// 1996).
#ifndef PETRICHOR_FORMULAS_LIGHT_AREA_H
#define PETRICHOR_FORMULAS_LIGHT_AREA_H

#include "base/interop.h"

SHARED_BEGIN

// Angle between two unit vectors over 2 pi times its sine, times their cross product. The quotient
// is Hill's rational fit (2016), good to 1e-4: a device's arc cosine is no better.
SHARED_FN vec3 edge_irradiance(vec3 a, vec3 b)
{
    const float c = clamp(dot(a, b), -1.0f, 1.0f);
    const float y = abs(c);
    const float acute =
        (0.8543985f + (0.4965155f + 0.0145206f * y) * y) / (3.4175940f + (4.1616724f + y) * y);
    const float quotient =
        c > 0.0f ? acute : 0.5f * inversesqrt(max(1.0f - c * c, 1.0e-7f)) - acute;
    return cross(a, b) * quotient;
}

// The vector F at the origin of a rectangle: its centre and half edges, seen from its front, the
// side that cross(half_u, half_v) points to.
SHARED_FN vec3 rectangle_irradiance(vec3 centre, vec3 half_u, vec3 half_v)
{
    const vec3 a = normalize(centre - half_u - half_v);
    const vec3 b = normalize(centre + half_u - half_v);
    const vec3 c = normalize(centre + half_u + half_v);
    const vec3 d = normalize(centre - half_u + half_v);
    return edge_irradiance(b, a) + edge_irradiance(c, b) + edge_irradiance(d, c) +
           edge_irradiance(a, d);
}

// Arc cosine, good to 1e-7 (Abramowitz and Stegun 1964, 4.4.46): devices' own are not.
SHARED_FN float arc_cosine(float x)
{
    const float y = min(abs(x), 1.0f);
    float p = -0.0012624911f;
    p = p * y + 0.0066700901f;
    p = p * y - 0.0170881256f;
    p = p * y + 0.0308918810f;
    p = p * y - 0.0501743046f;
    p = p * y + 0.0889789874f;
    p = p * y - 0.2145988016f;
    p = p * y + 1.5707963050f;
    p = p * sqrt(1.0f - y);
    return x >= 0.0f ? p : 3.14159265f - p;
}

// Form factor of a sphere of sin^2 of the half angle `f`, at the cosine `nl` to the normal, cut by
// the horizon.
SHARED_FN float sphere_form_factor(float f, float nl)
{
    const float s2 = clamp(f, 1.0e-6f, 0.9999f);
    if (nl * nl > s2) return nl > 0.0f ? s2 * nl : 0.0f;
    const float level = sqrt(max(1.0f - nl * nl, 1.0e-6f));
    const float x = sqrt(1.0f / s2 - 1.0f);
    const float y = clamp(-x * nl / level, -1.0f, 1.0f);
    const float t = level * sqrt(max(1.0f - y * y, 0.0f));
    return max((s2 * (nl * arc_cosine(y) - x * t) + arc_cosine(x * inversesqrt(x * x + t * t))) *
                   0.31830989f,
               0.0f);
}

SHARED_END

#endif
