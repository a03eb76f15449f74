// Ice on standing water as it is seen: clear here and milky there, with clouds of bubbles and with cracks where it has worked.
// Widths and shares are ours, by eye.
//
// One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_WEATHER_ICE_PATTERN_H
#define PETRICHOR_FORMULAS_WEATHER_ICE_PATTERN_H

#include "base/interop.h"
#include "formulas/noise/noise.h"
#include "formulas/weather/surface_weather.h"

SHARED_BEGIN

SHARED_CONST float kIceMean = 0.4f;      // share of white of apply_ice(), which knows no place; this is about the same in the mean
SHARED_CONST float kIcePlate_m = 0.28f;  // between cracks

// How far a place is from the border of its plate, in plates: 0 on a crack. Plates are the cells of points that lie about one
// a square (Worley 1996).
SHARED_FN float ice_from_crack(vec2 p)
{
    const ivec2 cell = ivec2(floor(p));
    float nearest = 9.0f;
    float next = 9.0f;
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const ivec2 other = cell + ivec2(dx, dy);
            const uint id = hash_u3(uint(other.x), uint(other.y), 371u);
            const vec2 way = vec2(other) + vec2(hash_f(id), hash_f(id + 1u)) - p;
            const float far = sqrt(dot(way, way));
            next = min(next, max(far, nearest));
            nearest = min(nearest, far);
        }
    }
    return 0.5f * (next - nearest);
}

// Share of white in ice, 0..1. at_m: world x and z; wider_m: of a pixel there, in which what is finer is lost.
SHARED_FN float ice_white(vec2 at_m, float wider_m)
{
    const vec2 bend_m = 0.05f * vec2(endless_noise(5.0f * at_m, 372u), endless_noise(5.0f * at_m, 373u));
    const float crack_m = kIcePlate_m * ice_from_crack((at_m + bend_m) * (1.0f / kIcePlate_m));
    const float worked = smooth_edge(0.4f, 0.6f, endless_noise(0.9f * at_m, 374u));
    const float width_m = 0.004f + 0.5f * wider_m;
    const float crack = worked * (1.0f - smooth_edge(0.25f * width_m, width_m, crack_m)) * (0.004f / width_m);
    const float milk = smooth_edge(0.3f, 0.7f, endless_noise(2.4f * at_m, 375u));
    const float bubbles = smooth_edge(0.58f, 0.72f, endless_noise(60.0f * at_m, 376u));
    const float fine = 1.0f - smooth_edge(0.004f, 0.02f, wider_m);
    const float white = 0.1f + milk * (0.43f + 0.4f * mix(0.25f, bubbles, fine)) + 0.55f * crack;
    return mix(min(white, 1.0f), kIceMean, smooth_edge(0.1f, 0.6f, wider_m));
}

// Albedo of what apply_ice() has made evenly white, with the white of a place in its stead. ice: as there, 0..1.
SHARED_FN vec3 with_ice_pattern(vec3 albedo, float ice, float white)
{
    const vec3 milky = vec3(0.52f, 0.57f, 0.61f);
    const float even = kIceMean * ice;
    return mix(max(albedo - even * milky, splat3(0.0f)) / (1.0f - even), milky, white * ice);
}

SHARED_END

#endif
