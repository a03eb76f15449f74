// Real spherical harmonics of order 0 to 2, for irradiance (Ramamoorthi and Hanrahan 2001), y up.
#ifndef PETRICHOR_FORMULAS_LIGHT_SPHERICAL_HARMONICS_H
#define PETRICHOR_FORMULAS_LIGHT_SPHERICAL_HARMONICS_H

#include "base/interop.h"

SHARED_BEGIN

SHARED_CONST int kHarmonics = 9;

// The i-th function in the direction d, unit.
SHARED_FN float harmonic(int i, vec3 d)
{
    if (i == 0) return 0.282095f;
    if (i == 1) return 0.488603f * d.y;
    if (i == 2) return 0.488603f * d.z;
    if (i == 3) return 0.488603f * d.x;
    if (i == 4) return 1.092548f * d.x * d.y;
    if (i == 5) return 1.092548f * d.y * d.z;
    if (i == 6) return 0.315392f * (3.0f * d.z * d.z - 1.0f);
    if (i == 7) return 1.092548f * d.x * d.z;
    return 0.546274f * (d.x * d.x - d.y * d.y);
}

// What the convolution with a clamped cosine leaves of each function, divided by pi: the sum of
// coefficient * harmonic is then what a white Lambert surface sends out.
SHARED_FN float cosine_band(int i)
{
    return i == 0 ? 1.0f : i < 4 ? 2.0f / 3.0f : 0.25f;
}

// Six directions that carry what the harmonics miss: +x, -x, +y, -y, +z, -z. Low light at the horizon leaks into level
// ground, by a third at dusk.
SHARED_CONST int kSkyAxes = 6;

SHARED_FN vec3 sky_axis(int i)
{
    const float side = i % 2 == 0 ? 1.0f : -1.0f;
    return i < 2 ? vec3(side, 0.0f, 0.0f) : i < 4 ? vec3(0.0f, side, 0.0f) : vec3(0.0f, 0.0f, side);
}

// What axes say in the direction n, unit: of each pair the one on its side, by the square of what n has of it.
SHARED_FN vec3 over_sky_axes(vec3 n, vec3 px, vec3 mx, vec3 py, vec3 my, vec3 pz, vec3 mz)
{
    const vec3 squared = n * n;
    return (n.x > 0.0f ? px : mx) * squared.x + (n.y > 0.0f ? py : my) * squared.y +
           (n.z > 0.0f ? pz : mz) * squared.z;
}

SHARED_END

#endif
