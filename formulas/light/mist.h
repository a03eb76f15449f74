// Mist over warm wet ground: its vapour meets cooler air, and what the mixture of both cannot hold is droplets (steam fog, Saunders
// 1964). A layer a few hands high, in wisps that drift and turn.
//
// One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_LIGHT_MIST_H
#define PETRICHOR_FORMULAS_LIGHT_MIST_H

#include "base/interop.h"
#include "formulas/light/fog.h"
#include "formulas/noise/noise.h"

SHARED_BEGIN

SHARED_CONST float kMistHeight_m = 0.35f;  // over which it thins out to 1/e; ours
SHARED_CONST float kMistPeriod_m = 4096.0f;  // the way of its air may be cut to this; a jump of wisps once in so long a way

// Of water vapour over water, Pa (Magnus, WMO 2008).
SHARED_FN float mist_saturation_pa(float temperature_k)
{
    const float c = temperature_k - 273.15f;
    return 611.2f * exp(17.62f * c / (243.12f + c));
}

// Extinction of the layer at wet ground, 1/m; 0 where the mixture holds all its vapour.
//   surface_k, air_k     of the ground and of the air over it
//   relative_humidity    of that air, 0..1
//   wind_m_s             thins it: half at 1 m/s, a tenth at 3 (ours)
SHARED_FN float mist_extinction_per_m(float surface_k, float air_k, float relative_humidity, float wind_m_s)
{
    if (surface_k <= air_k) return 0.0f;
    const float air_pa = relative_humidity * mist_saturation_pa(air_k);
    const float ground_pa = mist_saturation_pa(surface_k);
    float most = 0.0f;  // kg/m3 of droplets
    for (int k = 1; k <= 8; ++k) {
        // Of the air that was at the ground; more than a half of it lies below what one sees.
        const float share = 0.0625f * float(k);
        const float mixed_k = air_k + share * (surface_k - air_k);
        const float over_pa = air_pa + share * (ground_pa - air_pa) - mist_saturation_pa(mixed_k);
        most = max(most, over_pa / (461.5f * mixed_k));
    }
    // Droplets of 5 micrometres: 3 / (2 radius density).
    return most * (1.5f / (1000.0f * 5.0e-6f)) / (1.0f + wind_m_s * wind_m_s);
}

// How dense it is at a place, 1 in the mean of times and places, 0 to 3.8. air_m: how far the air has gone.
SHARED_FN float mist_wisps(vec2 at_m, vec2 air_m, float time_s)
{
    const vec2 p = at_m - air_m;
    const float wide = endless_noise_3(vec3(p.x * 0.55f, time_s * 0.12f, p.y * 0.55f), 71u);
    const float fine = endless_noise_3(vec3(p.x * 2.1f, time_s * 0.35f, p.y * 2.1f), 72u);
    const float here = 0.65f * wide + 0.35f * fine;
    const float rise = clamp((here - 0.22f) * (1.0f / 0.56f), 0.0f, 1.0f);
    return 3.8f * rise * rise * (0.4f + 0.6f * rise);
}

// Optical depth of the layer between an eye and a point. base_m: height of the ground it lies on.
SHARED_FN float mist_depth(float per_m, vec3 eye_m, vec3 at_m, float base_m)
{
    const vec3 way = at_m - eye_m;
    return per_m * fog_path(sqrt(dot(way, way)), eye_m.y - base_m, at_m.y - base_m, kMistHeight_m);
}

SHARED_END

#endif
