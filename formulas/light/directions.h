// Directions from even numbers of 0..1: on the sphere, in the ball, and the flawed way of an older
// program, kept to be told apart from the right one.
#ifndef PETRICHOR_FORMULAS_LIGHT_DIRECTIONS_H
#define PETRICHOR_FORMULAS_LIGHT_DIRECTIONS_H

#include "base/interop.h"

SHARED_BEGIN

// Uniform on the sphere: the height is uniform (Archimedes), the turn too.
SHARED_FN vec3 uniform_sphere(float u1, float u2)
{
    const float z = 1.0f - 2.0f * u1;
    const float level = sqrt(max(1.0f - z * z, 0.0f));
    const float turn = 6.2831853f * u2;
    return vec3(level * cos(turn), level * sin(turn), z);
}

// Uniform inside the unit ball: the volume within r grows with r^3.
SHARED_FN vec3 uniform_ball(float u1, float u2, float u3)
{
    return uniform_sphere(u1, u2) * pow(u3, 1.0f / 3.0f);
}

// Three even angles, as the seed of this project did: looks right, has no visible poles, and is not
// uniform. The polar angle about x is a sum of two even angles, so that its density is
// 8 / pi^2 min(t, pi - t) / sin t of what it should be: 0.81 at the poles of x, 1.27 at its equator.
// Not for any estimate.
SHARED_FN vec3 seed_sphere(float u1, float u2, float u3)
{
    const float around = 6.2831853f * u1;
    const float polar = 1.57079633f * (u2 + u3);
    return vec3(cos(polar), sin(polar) * cos(around), sin(polar) * sin(around));
}

// What a direction of seed_sphere() counts too much: its density over that of uniform_sphere().
SHARED_FN float seed_sphere_density(vec3 d)
{
    const float polar = acos(clamp(d.x, -1.0f, 1.0f));
    const float side = max(sin(polar), 1.0e-4f);
    return 0.81056947f * min(polar, 3.14159265f - polar) / side;
}

SHARED_END

#endif
