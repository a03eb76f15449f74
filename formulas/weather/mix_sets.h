// Two sets of textures on one surface: their shares, and what fine detail does to the first.
//
// One text for C++ and GLSL. Source: Lux 2.02 (docs/lux.md).
#ifndef PETRICHOR_FORMULAS_WEATHER_MIX_SETS_H
#define PETRICHOR_FORMULAS_WEATHER_MIX_SETS_H

#include "base/interop.h"

SHARED_BEGIN

// Shares of the first and second set, which sum to 1. first: wanted share of the first, 0..1;
// heights: of both, 0 low .. 1 high. What stands higher shows through, with a sharp edge.
SHARED_FN vec2 mix_by_height(float first, vec2 heights)
{
    const float other = 1.0f - first;
    // A height of 0 still shows where nothing else does.
    float b = max(first * first * clamp(heights.x + 0.001f, 0.0f, 1.0f), 1.0e-4f);
    float c = max(other * other * clamp(heights.y + 0.001f, 0.0f, 1.0f), 1.0e-4f);
    b *= b;
    b *= b;
    c *= c;
    c *= c;
    return vec2(b, c) / (b + c);
}

// Shares of four layers, which sum to 1: their weights, or with by_height 1 those that stand higher where several
// have weight. Where none has any it is the first (Lux 2.02 divides by the sum plus 0.001).
SHARED_FN vec4 ground_shares(vec4 weights, vec4 heights, float by_height)
{
    const float sum = weights.x + weights.y + weights.z + weights.w;
    const vec4 plain = sum > 0.002f ? weights / max(sum, 0.002f) : vec4(1.0f, 0.0f, 0.0f, 0.0f);
    vec4 b = plain * plain * (clamp(heights, splat4(0.0f), splat4(1.0f)) + splat4(0.001f));
    b *= b;
    b *= b;
    const float high = max(b.x + b.y + b.z + b.w, 1.0e-20f);
    return mix(plain, b / high, by_height);
}

// Linear colour under a linear detail colour: sRGB 0.5 leaves it as it is (Lux has 4.5948, of a gamma of 2.2).
SHARED_FN vec3 detail_color(vec3 color, vec3 detail, float share)
{
    return color * mix(splat3(1.0f), detail * 4.6720f, share);
}

// Tangent normal of a relief on a relief: slopes are added. share: of the detail.
SHARED_FN vec3 detail_normal(vec3 normal, vec3 detail, float share)
{
    return normalize(vec3(normal.x + detail.x * share, normal.y + detail.y * share,
                          normal.z * mix(1.0f, detail.z, share)));
}

SHARED_END

#endif
