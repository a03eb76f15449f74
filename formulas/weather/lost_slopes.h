// What normals lose where several are seen as one, and where they fade from afar: the variance of their slopes, which makes the
// surface rough instead. So a terrain's ground keeps its highlight's width when its bumps are no longer seen one by one.
//
// Slopes of a roughness alpha have the variance alpha^2 / 2 an axis (Beckmann; docs/textures.md, 1): what both axes lose adds to alpha^2,
// as in LEAN mapping (Olano and Baker 2010).
//
// One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_WEATHER_LOST_SLOPES_H
#define PETRICHOR_FORMULAS_WEATHER_LOST_SLOPES_H

#include "base/interop.h"

SHARED_BEGIN

// Steeper than 76 degrees a bump counts as that: of a slope without end no mean is.
SHARED_CONST float kSteepestSlope_2 = 16.0f;

// Slope of a normal, squared; z is away from the surface.
SHARED_FN float slope_2(vec3 normal)
{
    const float z_2 = max(normal.z * normal.z, 1.0e-6f);
    return min((normal.x * normal.x + normal.y * normal.y) / z_2, kSteepestSlope_2);
}

// Of both axes together. mean_slope_2: the mean of slope_2 of what is there; seen: the normal that is drawn for all of it.
SHARED_FN float lost_slopes(float mean_slope_2, vec3 seen) { return max(mean_slope_2 - slope_2(seen), 0.0f); }

// Perceptual roughness of a surface whose slopes have lost so much.
SHARED_FN float with_lost_slopes(float roughness, float lost)
{
    const float alpha = roughness * roughness;
    return sqrt(sqrt(clamp(alpha * alpha + lost, 0.0f, 1.0f)));
}

SHARED_END

#endif
