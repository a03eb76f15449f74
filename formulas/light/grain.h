// What a grained surface mirrors: brushed metal draws its surroundings out along the directions that its normals
// lean to. One normal a sample is taken of the wide side of the lobe; the mean over samples is the streak.
//
// Those that the eye sees, not all that there are: at a low angle along the grain that is another middle.
#ifndef PETRICHOR_FORMULAS_LIGHT_GRAIN_H
#define PETRICHOR_FORMULAS_LIGHT_GRAIN_H

#include "base/interop.h"

SHARED_BEGIN

// Slope along an axis of one of the normals that an eye sees of a ridged surface, for two shares u of 0..1: a cap of the
// sphere in the stretched space of Heitz 2018 (Dupuy and Benyoub 2023), of which the eye has no part across the ridges.
//   eye   unit: the eye along the axis and along the normal
SHARED_FN float seen_slope(vec2 u, float alpha, vec2 eye)
{
    const vec2 stretched = vec2(alpha * eye.x, max(eye.y, 1.0e-3f));
    const vec2 s = stretched * inversesqrt(dot(stretched, stretched));
    const float up = (1.0f - u.x) * (1.0f + s.y) - s.y;
    const float level = sqrt(max(1.0f - up * up, 0.0f)) * cos(6.2831853f * u.y);
    // The last of them lean without bound.
    return clamp(alpha * (level + s.x) / max(up + s.y, 1.0e-4f), -12.0f, 12.0f);
}

// The normal that mirrors, without chance, where the middle of the lobe goes: the longer that is the more upright, whatever
// the eye's angle. Beside sums over the lobe 0.1 radians off in the middle, where the bent normal of
// KHR_materials_anisotropy, which is none of what the text demands, is 0.6 and mirrors towards the eye
// (Grain.TheMiddleOfTheLobeIsMirrored).
SHARED_FN vec3 grain_middle(vec3 n, vec3 t, vec3 v, float anisotropy)
{
    const vec3 across = cross(n, t);
    const vec3 upright = v - across * dot(across, v);
    const float size2 = dot(upright, upright);
    const vec3 facing = size2 > 1.0e-6f ? upright * inversesqrt(size2) : n;
    return normalize(mix(n, facing, 0.6f * anisotropy * sqrt(anisotropy)));
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
