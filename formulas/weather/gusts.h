// Gusts carry snow and rain in clouds that drift with the wind: how dense the veil is along a way through the air,
// over that of air in which all is spread evenly.
//
// The density is 1 and a sum of waves, so that its mean along a way is found without samples of it, and a long way
// sees air that is even. The waves are frozen into the air that carries them (Taylor 1938); their lengths and
// strengths are those of turbulence, amplitudes as the cube root of the length (Kolmogorov 1941).
//
// One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_WEATHER_GUSTS_H
#define PETRICHOR_FORMULAS_WEATHER_GUSTS_H

#include "base/interop.h"

SHARED_BEGIN

// All repeats after so many metres: the way of the wind may be cut to it.
SHARED_CONST float kGustPeriod_m = 192.0f;
SHARED_CONST float kLeastVeil = 0.05f;

// About the mean of one wave along a way: waves is k of sin(2 pi (k . p) / period), whole numbers along the ground.
// The wave at the middle, less the more of it the way goes through (sin(x) / x is 1 - x^2 / 6). A cloud of drops is no
// wave without an end, so less, too, the more of its lengths the way has along its crest: else there would be stripes.
SHARED_FN float gust_wave(vec3 waves, vec3 from_m, vec3 along_m)
{
    const float turn = 6.28318531f / kGustPeriod_m;
    const float half_way = 0.5f * turn * dot(waves, along_m);
    const float lengths = dot(along_m, along_m) * dot(waves, waves) / (kGustPeriod_m * kGustPeriod_m);
    return sin(turn * dot(waves, from_m) + half_way) / (1.0f + half_way * half_way / 6.0f + 0.04f * lengths);
}

// Density of the veil between two points over its mean, about 1; strength 0: 1. way_m: of the wind since the start,
// x and z. 0.7 of the mean up and down (root mean square) at a point where the strength is 1.
SHARED_FN float gust_veil(vec3 from_m, vec3 to_m, vec2 way_m, float strength)
{
    if (strength <= 0.0f) return 1.0f;
    const vec3 from = from_m - vec3(way_m.x, 0.0f, way_m.y);
    const vec3 along = to_m - from_m;
    float sum = 0.546f * gust_wave(vec3(6.0f, 1.8f, 2.0f), from, along);
    sum += 0.475f * gust_wave(vec3(2.0f, -3.6f, -9.0f), from, along);
    sum += 0.401f * gust_wave(vec3(-15.0f, 4.6f, -6.0f), from, along);
    sum += 0.364f * gust_wave(vec3(5.0f, 7.5f, 21.0f), from, along);
    sum += 0.306f * gust_wave(vec3(-20.0f, 13.0f, 30.0f), from, along);
    sum += 0.259f * gust_wave(vec3(33.0f, 21.0f, 50.0f), from, along);
    return max(1.0f + strength * sum, kLeastVeil);
}

// How strong the gusts are in which snow and rain go: by the wind where they are seen, and by their share of what
// weakens light in the air. A share far above 1 is air that was told to be clear though it rains: no veil to thicken.
SHARED_FN float gust_strength(float wind_m_s, float share)
{
    return clamp(wind_m_s / 8.0f, 0.0f, 1.0f) * clamp(share, 0.0f, 1.0f) * clamp(2.0f - 0.25f * share, 0.0f, 1.0f);
}

SHARED_END

#endif
