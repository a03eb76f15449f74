// A second lobe of a texel: what `petrichor texture prefilter --second-lobe-out` writes beside normal
// and roughness. A small level stands for slopes and glosses that no single lobe looks like.
//
//   RG  normal of the second lobe, 0.5 + 0.5 n, z from x and y (green as in the normal map)
//   B   its roughness, as in the roughness map
//   A   its share of what shines, 0..1; 0.5 on level 0, where both lobes are the same
//
// What shines is (1 - share) of the lobe of the normal and roughness maps and `share` of this one, each
// with its own normal, all else alike (base colour, F0). What is diffuse is lit once, by the normal
// between the two. Read with the same coordinates and filter as the other two maps.
#ifndef PETRICHOR_FORMULAS_LIGHT_SECOND_LOBE_H
#define PETRICHOR_FORMULAS_LIGHT_SECOND_LOBE_H

#include "base/interop.h"

SHARED_BEGIN

struct SecondLobe {
    vec3 normal;       // unit length, in tangent space as the normal map
    float roughness;   // as the map holds it
    float share;       // of what shines
};

SHARED_FN SecondLobe second_lobe_of(vec4 texel)
{
    SecondLobe lobe;
    const float x = 2.0f * texel.x - 1.0f;
    const float y = 2.0f * texel.y - 1.0f;
    lobe.normal = normalize(vec3(x, y, sqrt(max(1.0f - x * x - y * y, 0.0f))));
    lobe.roughness = texel.z;
    lobe.share = texel.w;
    return lobe;
}

// Of what is diffuse; first: the normal of the normal map, unit length.
SHARED_FN vec3 diffuse_normal(vec3 first, SecondLobe second)
{
    const vec3 mean = first + second.share * (second.normal - first);
    return mean * inversesqrt(max(dot(mean, mean), 1.0e-8f));
}

// What shines: of the first lobe and of the second, each shaded by its own normal and roughness.
SHARED_FN vec3 shine_of_both(vec3 first, vec3 second, SecondLobe lobe)
{
    return first + lobe.share * (second - first);
}

SHARED_END

#endif
