// What a grained surface mirrors: brushed metal draws its surroundings out along the directions that its normals
// lean to. One normal a sample is taken of the wide side of the lobe; the mean over samples is the streak.
//
// The slopes of GGX along one axis have the density alpha^2 / (2 (x^2 + alpha^2)^(3/2)): the distribution of
// Trowbridge and Reitz 1975 in slopes (Heitz 2014, section 5), summed over the other axis; its inverse is closed.
#ifndef PETRICHOR_FORMULAS_LIGHT_GRAIN_H
#define PETRICHOR_FORMULAS_LIGHT_GRAIN_H

#include "base/interop.h"

SHARED_BEGIN

// Slope along an axis of that alpha below which a share u of 0..1 of all slopes lies. The last hundredth on either
// side, where slopes grow without bound, is left out.
SHARED_FN float ggx_slope(float u, float alpha)
{
    const float s = clamp(2.0f * u - 1.0f, -0.98f, 0.98f);
    return alpha * s / sqrt(1.0f - s * s);
}

// Alpha that the grain adds along its tangent to the lobe across it (KHR_materials_anisotropy: along it is
// mix(alpha, 1, anisotropy^2)).
SHARED_FN float grain_alpha(float alpha, float anisotropy)
{
    const float along = mix(alpha, 1.0f, anisotropy * anisotropy);
    return sqrt(max(along * along - alpha * alpha, 0.0f));
}

// How much of it is left at a distance.   dither: spread, distance and fade, metres
SHARED_FN float grain_share(vec3 dither, float view_m)
{
    return clamp((dither.y - view_m) / max(dither.z, 1.0e-3f), 0.0f, 1.0f);
}

// A normal that leans along t so far that what is mirrored stays above the surface.
SHARED_FN vec3 grain_normal(vec3 n, vec3 t, vec3 v, float slope)
{
    const vec3 h = normalize(n + t * slope);
    const vec3 away = h * (2.0f * dot(h, v)) - v;
    const float below = dot(away, n);
    if (below >= 0.0f) return h;
    // What would go below is turned up: as if it were mirrored once more.
    const vec3 up = v + away - n * (2.0f * below);
    return normalize(up + n * 1.0e-4f);
}

SHARED_END

#endif
