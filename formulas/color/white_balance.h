// White balance: the light of a colour temperature becomes the white of the display (D65).
//
// The white of a temperature lies on the Planckian locus (Kim et al. 2002, cubic pieces, 1667 to
// 25000 K) and is adapted in the cone space of CAT16 (Li et al. 2017) by von Kries' factors.
#ifndef PETRICHOR_FORMULAS_COLOR_WHITE_BALANCE_H
#define PETRICHOR_FORMULAS_COLOR_WHITE_BALANCE_H

#include "base/interop.h"

SHARED_BEGIN

// CIE 1931 x and y of a black body.
SHARED_FN vec2 planckian_xy(float temperature_k)
{
    const float t = clamp(temperature_k, 1667.0f, 25000.0f);
    const float u = 1000.0f / t;
    const float x = t <= 4000.0f
                        ? ((-0.2661239f * u - 0.2343589f) * u + 0.8776956f) * u + 0.179910f
                        : ((-3.0258469f * u + 2.1070379f) * u + 0.2226347f) * u + 0.240390f;
    float y = ((3.0817580f * x - 5.87338670f) * x + 3.75112997f) * x - 0.37001483f;
    if (t <= 2222.0f) {
        y = ((-1.1063814f * x - 1.34811020f) * x + 2.18555832f) * x - 0.20219683f;
    } else if (t <= 4000.0f) {
        y = ((-0.9549476f * x - 1.37418593f) * x + 2.09137015f) * x - 0.16748867f;
    }
    return vec2(x, y);
}

// Long, middle and short cones of CAT16 for linear Rec.709, and back.
SHARED_FN vec3 cones_from_rgb(vec3 c)
{
    return vec3(dot(c, vec3(0.3027448f, 0.6023438f, 0.0704469f)),
                dot(c, vec3(0.1537836f, 0.7773328f, 0.0853666f)),
                dot(c, vec3(0.0279765f, 0.1478733f, 0.9091366f)));
}

SHARED_FN vec3 rgb_from_cones(vec3 c)
{
    return vec3(dot(c, vec3(5.4470276f, -4.2158342f, -0.0262173f)),
                dot(c, vec3(-1.0784684f, 2.1445491f, -0.1178019f)),
                dot(c, vec3(0.0077966f, -0.2190842f, 1.1199122f)));
}

SHARED_FN vec3 cones_of_white(float temperature_k)
{
    const vec2 xy = planckian_xy(temperature_k);
    const vec3 xyz = vec3(xy.x / xy.y, 1.0f, (1.0f - xy.x - xy.y) / xy.y);
    return vec3(dot(xyz, vec3(0.401288f, 0.650173f, -0.051461f)),
                dot(xyz, vec3(-0.250268f, 1.204414f, 0.045854f)),
                dot(xyz, vec3(-0.002079f, 0.048952f, 0.953127f)));
}

// Factors of the cones that make the white of `temperature_k` the display's.
SHARED_FN vec3 white_balance_gains(float temperature_k)
{
    return cones_from_rgb(splat3(1.0f)) / cones_of_white(temperature_k);
}

// Factors that make the colour of a light (linear Rec.709, of luminance 1) white, by a share of its
// cast: 0 none, 1 all of it. The share is the degree of adaptation D of CIECAM16.
SHARED_FN vec3 white_balance_gains_of_light(vec3 light, float share)
{
    const vec3 cones = max(cones_from_rgb(light), splat3(1e-3f));
    return cones_from_rgb(splat3(1.0f)) / cones * share + splat3(1.0f - share);
}

SHARED_FN vec3 white_balanced(vec3 rgb, vec3 gains)
{
    return rgb_from_cones(cones_from_rgb(rgb) * gains);
}

SHARED_END

#endif
