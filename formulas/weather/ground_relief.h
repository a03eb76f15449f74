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

// 0 the bottom of a hollow .. 1 the top of a bump. xz: world, metres.
SHARED_FN float ground_relief(vec2 xz)
{
    const float wide = tileable_noise(xz * 0.43f, kGroundPeriod, 131u);
    const float near = tileable_noise(xz * 1.31f + 7.3f, kGroundPeriod, 137u);
    const float fine = tileable_noise(xz * 6.7f + 3.1f, kGroundPeriod, 139u);
    return 0.55f * wide + 0.32f * near + 0.13f * fine;
}

SHARED_END

#endif
