// Light that goes a way below skin: what a round surface sends back, integrated beforehand (Penner 2011).
// The profile is d'Eon and Luebke's six Gaussians (2007, GPU Gems 3, chapter 14), along the ring as a line of
// light spreads; a curvature of 1 is a ring of kSkinRadius_mm, chosen so that the table has Lux 2.02's values.
#ifndef PETRICHOR_FORMULAS_LIGHT_SKIN_H
#define PETRICHOR_FORMULAS_LIGHT_SKIN_H

#include "base/interop.h"
#include "formulas/light/area.h"
#include "formulas/light/brdf.h"

SHARED_BEGIN

#define SKIN_TABLE_SIDE 64  // columns: cosine to the light, -1 to 1; rows: curvature, 0 to 1
#define SKIN_RING_STEPS 480

SHARED_CONST float kSkinRadius_mm = 1.6f;
SHARED_CONST float kSkinReach_mm = 14.0f;  // five deviations of the widest Gaussian

// Weight of a line of light at a distance, mm, of that square, by red, green and blue.
SHARED_FN vec3 skin_profile(float d2)
{
    vec3 sum = vec3(0.233f, 0.455f, 0.649f) * (exp(d2 * (-0.5f / 0.0064f)) * inversesqrt(0.0064f));
    sum = sum + vec3(0.100f, 0.336f, 0.344f) * (exp(d2 * (-0.5f / 0.0484f)) * inversesqrt(0.0484f));
    sum = sum + vec3(0.118f, 0.198f, 0.0f) * (exp(d2 * (-0.5f / 0.187f)) * inversesqrt(0.187f));
    sum = sum + vec3(0.113f, 0.007f, 0.007f) * (exp(d2 * (-0.5f / 0.567f)) * inversesqrt(0.567f));
    sum = sum + vec3(0.358f, 0.004f, 0.0f) * (exp(d2 * (-0.5f / 1.99f)) * inversesqrt(1.99f));
    sum = sum + vec3(0.078f, 0.0f, 0.0f) * (exp(d2 * (-0.5f / 7.41f)) * inversesqrt(7.41f));
    return sum;
}

// What a white surface of that curvature, 0..1, sends back of a light at the cosine `nl`: takes the place
// of max(nl, 0).
SHARED_FN vec3 skin_ring(float nl, float curvature)
{
    if (curvature < 1.0e-3f) return splat3(max(nl, 0.0f));
    const float radius = kSkinRadius_mm / curvature;
    const float sine = sqrt(max(1.0f - nl * nl, 0.0f));
    // The half of it that can be seen; of wide rings no more than where light comes from.
    const float reach = min(1.57079633f, kSkinReach_mm / radius);
    vec3 sum = splat3(0.0f);
    vec3 all = splat3(0.0f);
    for (int i = 0; i < SKIN_RING_STEPS; ++i) {
        const float x = ((float(i) + 0.5f) * (2.0f / float(SKIN_RING_STEPS)) - 1.0f) * reach;
        const float d = 2.0f * radius * sin(0.5f * x);
        const vec3 weight = skin_profile(d * d);
        sum = sum + weight * max(nl * cos(x) - sine * sin(x), 0.0f);
        all = all + weight;
    }
    return vec3(sum.x / all.x, sum.y / all.y, sum.z / all.z);
}

SHARED_FN vec3 skin_table_texel(int column, int row)
{
    const float nl = 2.0f * float(column) / float(SKIN_TABLE_SIDE - 1) - 1.0f;
    return skin_ring(nl, float(row) / float(SKIN_TABLE_SIDE - 1));
}

SHARED_END

#endif
