// Where the clouds of a layer are, and how thick: a field that repeats nowhere in sight. Those of a fair sky stand on a flat
// base as heaps, as tall as the field is above its threshold, and are seen from their sides.
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
    // It asks at its end: a CPU's device takes a loop that asks at its beginning once more, for nobody.
    int i = 0;
    bool goes = octaves > 0 && wide < 1.0f;
    do {
        if (goes) {
            const float mean = i > 1 ? 0.62f : 0.5f;
            const float v = endless_noise(p, 300u + uint(i));
            sum += weight * mix(mean, i > 1 ? 1.0f - abs(2.0f * v - 1.0f) : v, clamp(1.5f - 1.5f * wide, 0.0f, 1.0f));
            left -= weight * mean;
            p = next_cloud_octave(p);
            wide *= 2.03f;
            weight *= i == 0 ? 0.49f : i == 1 ? 0.74f : 0.54f;
            ++i;
            goes = i < octaves && wide < 1.0f;
        }
    } while (goes);
    return sum + left;
}

// What the field is above for this share of the layer: the quantiles of the field are near a logistic's.
SHARED_FN float cloud_threshold(float cover)
{
    const float c = clamp(cover, 0.001f, 0.999f);
    return 0.666f + 0.090f * log((1.0f - c) / c);
}

// How tall the tallest heaps are, in heights of the base: 720 m of 1.6 km. Where a layer closes it is flat.
SHARED_FN float cloud_tall(float cover)
{
    const float open = clamp((0.85f - cover) / 0.3f, 0.0f, 1.0f);
    return 0.45f * open * open * (3.0f - 2.0f * open);
}

// What the field must be above its threshold to reach so far up, 0 base .. 1 the tallest: steep flanks below round tops.
SHARED_FN float cloud_rise(float up) { return 0.17f * up * (0.35f + 0.65f * up); }

// Steps through a layer of heaps, and the octaves that stand up as flanks; finer ones are on them.
SHARED_CONST int kCloudSteps = 6;
SHARED_CONST int kHeapOctaves = 3;
SHARED_CONST float kLumpMean = 0.67f;  // of a round octave in space

// What is finer than the heaps, at a height in lengths of the field: lumps all around them. Its mean is 0. As cloud_field() has
// it in the plane, which drawn out to a height would be stripes.
SHARED_FN float cloud_lumps(vec2 bent, float height, float footprint)
{
    vec2 p = next_cloud_octave(next_cloud_octave(next_cloud_octave(bent)));
    float up = 8.365f * height;
    float wide = 8.365f * footprint;
    float sum = 0.0f;
    float weight = 0.107694f;
    int i = kHeapOctaves;
    bool goes = wide < 1.0f;
    do {
        if (goes) {
            const float v = endless_noise_3(vec3(p.x, up, p.y), 340u + uint(i));
            sum += weight * (1.0f - abs(2.0f * v - 1.0f) - kLumpMean) * clamp(1.5f - 1.5f * wide, 0.0f, 1.0f);
            p = next_cloud_octave(p);
            up *= 2.03f;
            wide *= 2.03f;
            weight *= 0.54f;
            ++i;
            goes = i < kCloudOctaves && wide < 1.0f;
        }
    } while (goes);
    return sum;
}

struct CloudMet {
    float above;  // the most that the field is over its threshold and rise on the way; below 0: the way misses all
    float up;     // where the way meets cloud first, or passes it closest: 0 at the base .. 1 at the tallest
};

// A straight way through a layer of heaps from below. bent: where it enters; through: from there to where it leaves the top;
// edge: the threshold.
SHARED_FN CloudMet cloud_met(vec2 bent, vec2 through, float footprint, float edge, int steps)
{
    CloudMet met;
    met.above = -1.0f;
    met.up = 0.0f;
    const float pace = 1.0f / float(kCloudSteps - 1);
    float two_before = -1.0f, before = -1.0f;
    bool inside = false;
    int i = 0;
    do {
        const float up = pace * float(i);
        const float above = cloud_field(bent + through * up, footprint, kHeapOctaves) - edge - cloud_rise(up);
        if (!inside && above > met.above) met.up = up;
        // Between two steps where the field passes its threshold.
        if (!inside && above > 0.0f && i > 0) met.up = up - above / (above - before) * pace;
        met.above = max(met.above, above);
        // Between steps where a way that misses all comes closest, as if along a parabola: else edges have a stair for each step.
        if (i > 1 && before > max(two_before, above)) {
            const float aside = 0.5f * (two_before - above) / (two_before - 2.0f * before + above);
            const float peak = before - 0.25f * (two_before - above) * aside;
            if (!inside && peak > met.above) met.up = up + (aside - 1.0f) * pace;
            met.above = max(met.above, peak);
        }
        inside = inside || above > 0.0f;
        two_before = before;
        before = above;
    } while (++i < steps);
    return met;
}

SHARED_END

#endif
