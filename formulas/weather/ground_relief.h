// Relief that ground has where its material brings no height map: hollows a step wide in which the
// last of the rain stands. In world space, so that neighbouring meshes go on in each other.
//
// One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_WEATHER_GROUND_RELIEF_H
#define PETRICHOR_FORMULAS_WEATHER_GROUND_RELIEF_H

#include "base/interop.h"
#include "formulas/noise/noise.h"

SHARED_BEGIN

// Of the relief above the height that a material says: a third of the ground can hold water.
SHARED_CONST float kGroundRelief = 2.0f;
// Of it and of a height map without a scale: metres of height 1 over height 0, as deep as puddles are.
SHARED_CONST float kGroundReliefUnit_m = 0.015f;
// It repeats after so many cells, 2 km: more than whole numbers of floats of the world need.
SHARED_CONST int kGroundPeriod = 1024;

// 0 the bottom of a hollow .. 1 the top of a bump. xz: world, metres. The lattices of its octaves are turned against each
// other and bent: of one lattice puddles were boxes with teeth along the axes of the world. The finest is a hand's breadth: without it
// shores are drawn as if with a pen. narrower: so many times a material has its hollows narrower than a step (xz is longer by it), which holds
// for what is wider than a hand alone: finer parts would be steeper too, and shores in rags.
SHARED_FN float ground_relief_of(vec2 xz, float narrower)
{
    const float gentler = 1.0f / max(narrower, 1.0f);
    const vec2 turned = vec2(0.83f * xz.x - 0.56f * xz.y, 0.56f * xz.x + 0.83f * xz.y);
    const vec2 other = vec2(0.36f * xz.x + 0.93f * xz.y, 0.36f * xz.y - 0.93f * xz.x);
    const float finest = endless_noise(other * 9.3f + 5.3f, 151u) - 0.5f;
    const float fine = endless_noise(turned * 2.9f + vec2(3.1f, 3.1f + 0.5f * gentler * finest), 139u) - 0.5f;
    const float near = endless_noise(other * 0.97f + vec2(7.3f + 0.4f * gentler * fine, 7.3f), 137u) - 0.5f;
    const float wide = endless_noise(turned * 0.37f + vec2(0.5f * near, 0.0f), 131u) - 0.5f;
    const float broad = endless_noise(xz * 0.29f + vec2(0.0f, 0.6f * near), 149u) - 0.5f;
    return clamp(0.498f + 0.40f * broad + 0.40f * wide + 0.30f * near + gentler * (0.13f * fine + gentler * 0.08f * finest), 0.0f, 1.0f);
}
SHARED_FN float ground_relief(vec2 xz) { return ground_relief_of(xz, 1.0f); }

// Its mean over a pixel of a width, as far as one place can tell: the rest of its deviation, 0.15 in all, is what
// ground_relief_blurred says. Half of the variance is lost at 3 m.
SHARED_FN float ground_relief_seen(vec2 xz, float width_m, float narrower)
{
    return 0.498f + (ground_relief_of(xz, narrower) - 0.498f) * sqrt(1.0f - variance_lost(width_m, 3.0f));
}
SHARED_FN float ground_relief_blurred(float width_m)
{
    return 0.15f * sqrt(variance_lost(width_m, 3.0f));
}

// How wind and the lie of the land share out the snow of wide ground: 1 in the mean, 0.4 to 1.6, in places 95, 31
// and 12 m wide (ours). Around the origin, where what is no land stands, all is as the weather says: from 25 m
// on it varies, from 120 m on all it can. xz: world, metres.
SHARED_FN float drifted_share(vec2 xz)
{
    const float wide = tileable_noise(xz / 95.0f + 11.3f, kGroundPeriod, 151u);
    const float near = tileable_noise(xz / 31.0f + 5.7f, kGroundPeriod, 157u);
    const float fine = tileable_noise(xz / 12.0f + 2.9f, kGroundPeriod, 163u);
    const float far = clamp((length(xz) - 25.0f) / 95.0f, 0.0f, 1.0f);
    return 1.0f + 1.2f * far * (0.5f * wide + 0.32f * near + 0.18f * fine - 0.5f);
}

// Of what snow covers: where it is deep, even what little lies in a lee of the wind hides the ground. depth_m: of the weather.
SHARED_FN float drifted_cover(vec2 xz, float depth_m)
{
    const float share = drifted_share(xz);
    return share + clamp((depth_m * share - 0.01f) / 0.03f, 0.0f, 1.0f) * (max(share, 1.0f) - share);
}

SHARED_END

#endif
