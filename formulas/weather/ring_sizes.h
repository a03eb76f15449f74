// How large the drops are whose rings are seen, and with them the rings.
//
// One text for C++ and GLSL. Of all drops that meet water the map of rings has room for the largest alone. Of an exponential
// spectrum (Marshall and Palmer 1948) these are exponential again, above the least of them.
#ifndef PETRICHOR_FORMULAS_WEATHER_RING_SIZES_H
#define PETRICHOR_FORMULAS_WEATHER_RING_SIZES_H

#include "base/interop.h"
#include "formulas/noise/noise.h"
#include "formulas/weather/falling.h"
#include "formulas/weather/ripple.h"

SHARED_BEGIN

struct RingSize {
    float strength;  // times the slope of a ring
    float reach;     // share of the time, and with it of the way, after which it is gone
};

// The mean of what those drops are larger than the least of them, over that: 0 all alike.
//   rate_mm_h     of rain
//   rings_m2_s    that begin
SHARED_FN float ring_drop_spread(float rate_mm_h, float rings_m2_s)
{
    if (!(rate_mm_h > 0.0f) || !(rings_m2_s > 0.0f)) return 0.0f;
    float low_mm = 0.5f;  // smaller ones draw no rings
    float high_mm = 6.0f;
    for (int i = 0; i < 16; ++i) {
        const float middle_mm = 0.5f * (low_mm + high_mm);
        const bool more = rain_hits_per_m2_s(rate_mm_h, middle_mm) > rings_m2_s;
        low_mm = more ? middle_mm : low_mm;
        high_mm = more ? high_mm : middle_mm;
    }
    return 1.0f / (rain_slope_per_mm(rate_mm_h) * low_mm);
}

// chance: 0..1, evenly. A ring is as steep as the square of its drop's diameter, and seen as long as it is steep (both ours).
// All together are as steep as rings that are alike: what weak ones lack by ending early the others have (a fit, within 4 % to a spread of 0.3).
SHARED_FN RingSize ring_size(float chance, float spread)
{
    const float over = -log(1.0f - 0.985f * chance);  // of an exponential with mean 1
    const float wide = 1.0f + spread * over;
    const float mean_square = 1.0f + spread * (4.0f + spread * (12.0f + spread * (24.0f + 24.0f * spread)));
    RingSize size;
    const float relative = wide * wide / sqrt(mean_square);
    size.strength = relative * (1.0f + 0.6f * spread);
    size.reach = clamp(0.6f * relative + 0.4f, 0.4f, 1.0f);
    return size;
}

// Whether a ring is where a texel of the map lies, at that age. Most of a map is water between rings.
SHARED_FN bool ring_is_here(vec4 source, float age)
{
    const float front = age - 1.0f + source.x;
    return front > 0.0f && front < 0.33333333f && source.x > 0.0f;
}

// As ripple_slope(), of the drop that has hit there last. source: its time is not blended with its neighbour's.
SHARED_FN vec2 sized_ripple_slope(vec4 source, RippleLayer rings, int layer, float spread)
{
    const float since = source.w + rings.clock;
    const float age = fract(since);
    const float front = age - 1.0f + source.x;
    if (!ring_is_here(source, age)) return splat2(0.0f);
    const int turn = int(rings.begun + floor(since));
    const uint drop = hash_u3(uint(turn), uint(255.0f * source.w + 0.5f), 911u + uint(layer));
    const RingSize size = ring_size(hash_f(drop), spread);
    const float fade = clamp(0.2f + 0.8f * rings.weight - age / size.reach, 0.0f, 1.0f);
    const float height = size.strength * fade * source.x * sin(3.14159265f * clamp(9.0f * front, 0.0f, 3.0f));
    return vec2(2.0f * source.y - 1.0f, 2.0f * source.z - 1.0f) * height;
}

SHARED_END

#endif
