// Where snow that has a body ends: no line between two vertices, but as irregular as what lies below.
#ifndef PETRICHOR_FORMULAS_WEATHER_SNOW_BODY_H
#define PETRICHOR_FORMULAS_WEATHER_SNOW_BODY_H

#include "base/interop.h"
#include "formulas/noise/noise.h"
#include "formulas/weather/surface_weather.h"

SHARED_BEGIN

// A vertex tells depths up to here, metres: deeper snow has no edge.
SHARED_CONST float SNOW_BODIED_M = 0.06f;

// What a vertex tells of its depth, 1..0.
SHARED_FN float snow_body_code(float deep_m)
{
    return 1.0f - clamp(deep_m / SNOW_BODIED_M, 0.0f, 1.0f);
}

// Depth of thin snow over the relief of what it lies on: it settles between stones, so joints are the first that it fills
// and the last that it leaves. Above SNOW_BODIED_M it knows none. Rises with the depth, 0 at 0 and below. Ours; by eye.
//   over_m  how high the ground stands here over its mean, metres, -0.02..0.02
SHARED_FN float settled_snow_m(float deep_m, float over_m)
{
    const float thin = 1.0f - smooth_edge(0.02f, SNOW_BODIED_M, deep_m);
    return min(deep_m - 0.7f * thin * clamp(over_m, -0.02f, 0.02f), 4.0f * deep_m);
}

// How far a pack thaws, by melt_exp of the weather of the frame, 0..1: it is grey and full of water long before it is gone.
SHARED_FN float snow_thaws(float melt_exp)
{
    return clamp(3.0f * melt_exp, 0.0f, 1.0f);
}

struct SnowBody {
    float share;  // of the body, 0..1
    float wets;   // how far its melt soaks the ground beside it, 0..1
    float ragged; // noise of a foot to a finger, 0..1: where it goes last and first
    vec2 slope;   // of that, along x and z, 1/m
};

// At a place x, z of the world, metres. Fresh snow ends where it is a centimetre deep, give or
// take; melting snow goes in patches of a hand's to a foot's width, ragged to a finger's, by depths up to five, and its edge is
// a rim of thin slush on wet ground. The share rises with the depth, 0 at 0 and 1 from SNOW_BODIED_M on, and falls with the
// thaw. Ours; widths and depths chosen by eye.
//   over_m    as settled_snow_m
//   melt_exp  of the weather of the frame, 0..1
SHARED_FN SnowBody snow_body_at(float deep_m, float over_m, vec2 place_m, float melt_exp)
{
    const vec3 wide = endless_noise_sloped(place_m / 0.34f, 71u), near = endless_noise_sloped(place_m / 0.093f, 72u);
    const float n = 0.52f * wide.x + 0.28f * near.x + 0.2f * endless_noise(place_m / 0.027f, 73u);
    const float thaw = snow_thaws(melt_exp);
    const float needed_m = mix(0.007f, mix(0.014f, 0.05f, thaw), clamp((n - 0.5f) * 1.9f + 0.5f, 0.0f, 1.0f));
    const float settled_m = settled_snow_m(deep_m, over_m);
    SnowBody body;
    body.share = smooth_edge(needed_m - 0.006f, min(needed_m + mix(0.006f, 0.017f, thaw), SNOW_BODIED_M), settled_m);
    body.ragged = n;
    body.slope = vec2(wide.y, wide.z) * (0.52f / 0.34f) + vec2(near.y, near.z) * (0.28f / 0.093f);
    body.wets = thaw * smooth_edge(needed_m - 0.024f, needed_m - 0.004f, settled_m);
    return body;
}

SHARED_FN float snow_body_share(float deep_m, float over_m, vec2 place_m, float melt_exp)
{
    return snow_body_at(deep_m, over_m, place_m, melt_exp).share;
}

// What of a thawing pack is slush, 0..0.8: grey and half transparent. Where it lies in water, which runs below it in gutters; and
// in blotches where it is thin, for what dirt fell with it lies on the last of it. Ours, by eye.
//   soaked  share of standing water below it
//   ragged  of the body there
SHARED_FN float slush_share(float deep_m, float soaked, float ragged, vec2 place_m, float melt_exp)
{
    const float n = 0.65f * endless_noise(place_m / 0.83f, 74u) + 0.35f * ragged;
    const float thin = 1.0f - smooth_edge(0.02f, SNOW_BODIED_M, deep_m);
    const float dirty = smooth_edge(0.4f, 0.75f, n) * (0.12f + 0.4f * thin);
    return snow_thaws(melt_exp) * min(soaked * (0.35f + 0.25f * thin) + dirty, 0.8f);
}

// Slope of the surface of a thawing pack, along x and z: the sun and the air eat hollows into it, a hand's to a foot's wide,
// deepest where it goes first. slope: of the body there. width_m: of the pixel on the ground. Ours, by eye.
SHARED_FN vec2 thaw_slope(vec2 slope, float width_m, float melt_exp)
{
    return slope * (-0.1f * snow_thaws(melt_exp) * sqrt(1.0f - variance_lost(width_m, 0.05f)));
}

SHARED_END

#endif
