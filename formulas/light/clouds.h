// Where the clouds of a layer are, and how thick: a field that repeats nowhere in sight.
#ifndef PETRICHOR_FORMULAS_LIGHT_CLOUDS_H
#define PETRICHOR_FORMULAS_LIGHT_CLOUDS_H

#include "base/interop.h"
#include "formulas/noise/noise.h"

SHARED_BEGIN

SHARED_CONST int kCloudOctaves = 7;

SHARED_FN vec2 next_cloud_octave(vec2 p)
{
    return vec2(0.8f * p.x - 0.6f * p.y, 0.6f * p.x + 0.8f * p.y) * 2.03f + splat2(17.0f);
}

// How far the field is bent aside at a place.
SHARED_FN vec2 cloud_bend(vec2 at)
{
    return 0.45f * vec2(endless_noise(at * 0.9f + splat2(7.0f), 320u) - 0.5f,
                        endless_noise(at * 1.1f + splat2(31.0f), 322u) - 0.5f);
}

// About 0.67 +- 0.15 at a bent place. Two octaves place the clouds, the finer ones are round with creases
// between, as what wells up is. Those finer than `footprint`, the length of p that a texel sees, are their mean;
// those from `octaves` on too.
SHARED_FN float cloud_field(vec2 bent, float footprint, int octaves)
{
    vec2 p = bent;
    float sum = 0.0f;
    float weight = 0.55f;
    float wide = footprint;
    float left = 0.55f * 0.5f + 0.2695f * 0.5f + 0.19943f * 2.0738f * 0.62f;  // what the means of all come to
    for (int i = 0; i < octaves && wide < 1.0f; ++i) {
        const float mean = i > 1 ? 0.62f : 0.5f;
        const float v = endless_noise(p, 300u + uint(i));
        sum += weight * mix(mean, i > 1 ? 1.0f - abs(2.0f * v - 1.0f) : v, clamp(1.5f - 1.5f * wide, 0.0f, 1.0f));
        left -= weight * mean;
        p = next_cloud_octave(p);
        wide *= 2.03f;
        weight *= i == 0 ? 0.49f : i == 1 ? 0.74f : 0.54f;
    }
    return sum + left;
}

// What the field is above for this share of the layer: the quantiles of the field are near a logistic's.
SHARED_FN float cloud_threshold(float cover)
{
    const float c = clamp(cover, 0.001f, 0.999f);
    return 0.666f + 0.090f * log((1.0f - c) / c);
}

SHARED_END

#endif
