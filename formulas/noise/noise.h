// Hashes, dither patterns and noise that tiles: every value follows from integers, so that any frame
// can be made alone. One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_NOISE_NOISE_H
#define PETRICHOR_FORMULAS_NOISE_NOISE_H

#include "base/interop.h"

SHARED_BEGIN

// Mixes 32 bits so that neighbouring inputs have unrelated outputs.
SHARED_FN uint hash_u(uint x)
{
    x ^= x >> 16u;
    x *= 0x7feb352du;
    x ^= x >> 15u;
    x *= 0x846ca68bu;
    x ^= x >> 16u;
    return x;
}

SHARED_FN uint hash_u3(uint x, uint y, uint z)
{
    return hash_u(x + hash_u(y + hash_u(z)));
}

// 0..1, without 1.
SHARED_FN float hash_f(uint x)
{
    return float(hash_u(x) >> 8u) * (1.0f / 16777216.0f);
}

// Well spread over a pixel's neighbours (interleaved gradient) and over samples (golden ratio).
SHARED_FN float dither(ivec2 pixel, uint sample_index)
{
    const float spatial =
        fract(52.9829189f * fract(0.06711056f * float(pixel.x) + 0.00583715f * float(pixel.y)));
    return fract(spatial + 0.61803399f * float(sample_index));
}

// A direction of 0..1 turns for what is drawn by chance: a thousandth beside the unit circle, where sine and cosine
// would be ten times as dear.
SHARED_FN vec2 on_circle(float turns)
{
    const vec2 t = 2.0f * fract(vec2(turns + 0.25f, turns)) - splat2(1.0f);
    const vec2 arcs = -4.0f * t * (splat2(1.0f) - abs(t));
    return arcs * (splat2(0.775f) + 0.225f * abs(arcs));
}

// 0 .. period - 1. Never the remainder of a negative number: GLSL leaves it open, and devices differ.
SHARED_FN int wrapped(int i, int period)
{
    return i >= 0 ? i % period : period - 1 - (-1 - i) % period;
}

// Value noise on a lattice that repeats every `period` cells.
SHARED_FN float lattice_value(ivec2 cell, int period, uint seed)
{
    return hash_f(hash_u3(uint(wrapped(cell.x, period)), uint(wrapped(cell.y, period)), seed));
}

// Value noise that repeats nowhere; cheaper, it divides nothing.
SHARED_FN float endless_noise(vec2 p, uint seed)
{
    const vec2 base = floor(p);
    const vec2 f = p - base;
    const vec2 u = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
    const ivec2 cell = ivec2(base);
    const uint x = uint(cell.x), y = uint(cell.y);
    const float a = hash_f(hash_u3(x, y, seed));
    const float b = hash_f(hash_u3(x + 1u, y, seed));
    const float c = hash_f(hash_u3(x, y + 1u, seed));
    const float d = hash_f(hash_u3(x + 1u, y + 1u, seed));
    return mix(mix(a, b, u.x), mix(c, d, u.x), u.y);
}

// The same, and its slopes along x and y.
SHARED_FN vec3 endless_noise_sloped(vec2 p, uint seed)
{
    const vec2 base = floor(p);
    const vec2 f = p - base;
    const vec2 u = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
    const vec2 rise = 30.0f * f * f * (f - 1.0f) * (f - 1.0f);
    const ivec2 cell = ivec2(base);
    const uint x = uint(cell.x), y = uint(cell.y);
    const float a = hash_f(hash_u3(x, y, seed));
    const float b = hash_f(hash_u3(x + 1u, y, seed));
    const float c = hash_f(hash_u3(x, y + 1u, seed));
    const float d = hash_f(hash_u3(x + 1u, y + 1u, seed));
    const float low = mix(a, b, u.x), high = mix(c, d, u.x);
    return vec3(mix(low, high, u.y), rise.x * mix(b - a, d - c, u.y), rise.y * (high - low));
}

// The same in space.
SHARED_FN float endless_noise_3(vec3 p, uint seed)
{
    const vec3 base = floor(p);
    const vec3 f = p - base;
    const vec3 u = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
    const uint x = uint(int(base.x)), y = uint(int(base.y));
    const uint low = hash_u(uint(int(base.z)) + seed * 0x9e3779b9u), high = hash_u(uint(int(base.z)) + 1u + seed * 0x9e3779b9u);
    const uint a = hash_u(y + low), b = hash_u(y + 1u + low), c = hash_u(y + high), d = hash_u(y + 1u + high);
    const float near = mix(mix(hash_f(x + a), hash_f(x + 1u + a), u.x), mix(hash_f(x + b), hash_f(x + 1u + b), u.x), u.y);
    const float far = mix(mix(hash_f(x + c), hash_f(x + 1u + c), u.x), mix(hash_f(x + d), hash_f(x + 1u + d), u.x), u.y);
    return mix(near, far, u.z);
}

SHARED_FN float tileable_noise(vec2 p, int period, uint seed)
{
    const vec2 base = floor(p);
    const vec2 f = p - base;
    const vec2 u = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
    const ivec2 cell = ivec2(base);
    const float a = lattice_value(cell, period, seed);
    const float b = lattice_value(cell + ivec2(1, 0), period, seed);
    const float c = lattice_value(cell + ivec2(0, 1), period, seed);
    const float d = lattice_value(cell + ivec2(1, 1), period, seed);
    return mix(mix(a, b, u.x), mix(c, d, u.x), u.y);
}

// uv 0..1 over the tile; `period` cells in the first octave.
SHARED_FN float tileable_fbm(vec2 uv, int period, int octaves, uint seed)
{
    float sum = 0.0f;
    float weight = 0.5f;
    float total = 0.0f;
    int cells = period;
    for (int i = 0; i < octaves; ++i) {
        sum += weight * tileable_noise(uv * float(cells), cells, seed + uint(i));
        total += weight;
        weight *= 0.5f;
        cells *= 2;
    }
    return sum / total;
}

// Share of the variance of noise that a pixel's mean has lost. width: of the pixel; half_at: at which half of it
// is lost. The form is that of a low pass of first order, which value noise of some octaves meets to a few hundredths.
SHARED_FN float variance_lost(float width, float half_at)
{
    const float q = width / half_at;
    return q * q / (1.0f + q * q);
}

SHARED_END

#endif
