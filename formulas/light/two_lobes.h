// A surface of two lobes of GGX over one diffuse part: what a texel of a small level has that stands for slopes
// and glosses that no single lobe looks like (formulas/light/second_lobe.h decodes its texture).
#ifndef PETRICHOR_FORMULAS_LIGHT_TWO_LOBES_H
#define PETRICHOR_FORMULAS_LIGHT_TWO_LOBES_H

#include "base/interop.h"
#include "formulas/light/brdf.h"

SHARED_BEGIN

// Reflected radiance per unit irradiance on a facing plane, the cosines included.
//   first, second  each with a normal and a width of its own, both of the same reflectance; what is diffuse
//                  is that of the first
//   share          of the second in what shines, 0..1
//   normal         unit: of what is diffuse
SHARED_FN vec3 shade_two_lobes(Lobe first, Lobe second, float share, vec3 normal, vec3 l)
{
    const vec3 diffuse = first.diffuse * clamp(dot(normal, l), 0.0f, 1.0f);
    first.diffuse = splat3(0.0f);
    second.diffuse = splat3(0.0f);
    const vec3 one = shade_lobe(first, l);
    return diffuse + one + share * (shade_lobe(second, l) - one);
}

// One lobe that stands for both where only one can be mirrored: slopes of GGX spread by their alpha.
SHARED_FN float joined_roughness(float first, float second, float share)
{
    const float a = first * first;
    const float b = second * second;
    return sqrt(sqrt(a * a + share * (b * b - a * a)));
}

SHARED_END

#endif
