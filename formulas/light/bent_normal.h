// Where the light from all around comes from at a point that near things hide in part: the mean of the directions that
// are left, by their cosines (the bent normal of Landis 2002, in closed form over slices as of Jimenez et al. 2016), and
// what a mirror of some width sees of a cone about it (after the cones of Oat and Sander 2007).
#ifndef PETRICHOR_FORMULAS_LIGHT_BENT_NORMAL_H
#define PETRICHOR_FORMULAS_LIGHT_BENT_NORMAL_H

#include "base/interop.h"
#include "formulas/codec/octahedral.h"
#include "formulas/light/area.h"

SHARED_BEGIN

// Of one side of a slice through the direction to the eye: the sum of directions from there to the horizon, each by its
// cosine to the normal and by the solid angle that it stands for. x along the slice, y to the eye.
//
//   horizon_cosine  of the angle from the eye to the horizon
//   cosine, sine    of the angle by which the normal leans from the eye to this side
SHARED_FN vec2 bent_side(float horizon_cosine, float cosine, float sine)
{
    const float c = clamp(horizon_cosine, -1.0f, 1.0f);
    const float s2 = 1.0f - c * c;
    const float s3 = s2 * sqrt(s2) * (1.0f / 3.0f);
    const float c3 = c * c * c;
    return vec2(cosine * s3 + sine * (2.0f / 3.0f - c + c3 * (1.0f / 3.0f)), cosine * (1.0f - c3) * (1.0f / 3.0f) + sine * s3);
}

// The mean direction, unit, from sums over two slices across each other, less those with nothing near: where nothing is, it
// is the normal.
//   strength  0..1, of the occlusion
SHARED_FN vec3 bent_normal(vec3 normal, vec3 missing, float strength)
{
    // The hemisphere's own sum is two thirds of pi, a slice stands for half of pi.
    const vec3 bent = normal + missing * (0.75f * strength);
    const float size2 = dot(bent, bent);
    return size2 > 1.0e-4f ? bent * inversesqrt(size2) : normal;
}

// In 16 bits: 127 steps to either side of nothing on both axes of an octahedron.
SHARED_FN uint bent_code(vec3 bent)
{
    const vec2 p = octahedral_encode(bent);
    return uint(clamp(p.x, -1.0f, 1.0f) * 127.0f + 127.5f) | uint(clamp(p.y, -1.0f, 1.0f) * 127.0f + 127.5f) << 8u;
}

SHARED_FN vec3 bent_of_code(uint code)
{
    return octahedral_decode(vec2(float(code & 255u) - 127.0f, float(code >> 8u & 255u) - 127.0f) * (1.0f / 127.0f));
}

// Share of a lobe that a cone holds: all well within, half at its edge, none well beyond.
//   apart  between the middles, radians
//   cone   half its width
//   soft   over which that changes
SHARED_FN float held_by_cone(float apart, float cone, float soft)
{
    const float t = clamp(0.5f + 0.5f * (cone - apart) / soft, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

// Share of what is mirrored that near things leave: what the cone that is open holds of the lobe over what the hemisphere
// does. What is open beside a wall is no cone: it reaches further along it than a cone of as much light, 1.2 times; that and
// the softness were chosen by sums over GGX's lobe beside walls and under awnings (BentNormal.AMirror..: 0.12 off in the mean,
// where a law of the angle to the eye alone is 0.2).
//
//   open       share of light by its cosine that is left, 0..1
//   bent       unit, the middle of what is open
//   ray        unit, the mirrored direction
//   roughness  perceptual
SHARED_FN float mirror_left(float open, vec3 normal, vec3 bent, vec3 ray, float roughness)
{
    // A cone about the normal has the square of its sine of the light; one of GGX holds most of its lobe.
    const float seen = 1.2f * arc_cosine(sqrt(clamp(1.0f - open, 0.0f, 1.0f)));
    const float soft = 0.2f + arc_cosine(exp2(-3.3219281f * roughness * roughness));
    const float whole = held_by_cone(arc_cosine(clamp(dot(normal, ray), -1.0f, 1.0f)), 1.5707963f, soft);
    const float left = held_by_cone(arc_cosine(clamp(dot(bent, ray), -1.0f, 1.0f)), seen, soft);
    return clamp(left / max(whole, 1.0e-3f), 0.0f, 1.0f);
}

SHARED_END

#endif
