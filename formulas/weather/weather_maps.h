// The tileable maps that weather is drawn with: drops, and the relief, mask and gloss of snow. The
// renderer draws them at once; `texture generate` writes them for others.
//
// One text for C++ and GLSL. uv: 0..1 over the tile. Layout of the drops: Lux 2.02 (docs/lux.md, 6).
#ifndef PETRICHOR_FORMULAS_WEATHER_WEATHER_MAPS_H
#define PETRICHOR_FORMULAS_WEATHER_WEATHER_MAPS_H

#include "base/interop.h"
#include "formulas/noise/noise.h"

SHARED_BEGIN

SHARED_CONST int kDropCells = 9;

struct DropCell {
    vec2 centre;   // of its drop, in cells
    float radius;  // in cells; it ends within its cell
    float when;    // when it falls, 0..1, as 8 bits hold it
};

// cell: any whole numbers; those kDropCells apart are alike.
SHARED_FN DropCell drop_cell(ivec2 cell, uint seed)
{
    const uint id = hash_u3(uint(wrapped(cell.x, kDropCells)), uint(wrapped(cell.y, kDropCells)), 77u + seed);
    DropCell drop;
    drop.radius = 0.34f + 0.14f * hash_f(id);
    const float room = 1.0f - 2.0f * drop.radius;
    const vec2 jitter = vec2(hash_f(id + 1u), hash_f(id + 2u)) - 0.5f;
    drop.centre = vec2(cell) + 0.5f + jitter * max(room, 0.0f);
    drop.when = floor(hash_f(id + 3u) * 255.0f + 0.5f) / 255.0f;
    return drop;
}

// One drop a jittered cell, so that neighbours never cut each other: envelope (1 at the centre, 0
// outside), 0.5 + 0.5 the direction away from it, and when it falls, 0..1.
SHARED_FN vec4 rain_drops(vec2 uv, uint seed)
{
    const vec2 at = uv * float(kDropCells);
    const ivec2 cell = ivec2(floor(at));
    float envelope = 0.0f;
    vec2 direction = splat2(0.0f);
    float offset = 0.0f;
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const DropCell drop = drop_cell(cell + ivec2(dx, dy), seed);
            const vec2 away = at - drop.centre;
            const float e = 1.0f - length(away) / drop.radius;
            if (e > envelope) {
                envelope = e;
                direction = away / max(length(away), 1.0e-4f);
                offset = drop.when;
            }
        }
    }
    return vec4(envelope, 0.5f + 0.5f * direction.x, 0.5f + 0.5f * direction.y, offset);
}

// Height of a snow cover, 0..1.35 or so, and the slope that a height of 1 has on the tile. Fresh snow is
// smooth: wide swells, and of what is a hand wide or less next to nothing (a natural surface's amplitudes
// fall as its waves shorten; halved with them, all slopes are alike and it looks like crumpled paper).
SHARED_CONST float kSnowSteepness = 0.05f;
SHARED_FN float snow_relief(vec2 uv, uint seed)
{
    // Bent, so that the lattice is not seen.
    const vec2 bend = vec2(tileable_noise(uv * 3.0f, 3, 21u + seed), tileable_noise(uv * 3.0f, 3, 22u + seed)) - 0.5f;
    const vec2 at = uv + 0.22f * bend;
    return 0.7f * tileable_noise(at * 3.0f, 3, 11u + seed) + 0.42f * tileable_noise(at * 5.0f, 5, 12u + seed) +
           0.16f * tileable_noise(at * 8.0f, 8, 13u + seed) + 0.05f * tileable_noise(at * 17.0f, 17, 14u + seed) +
           0.015f * tileable_noise(uv * 41.0f, 41, 15u + seed) + 0.006f * tileable_noise(uv * 97.0f, 97, 16u + seed);
}

// Where snow lies first and longest, 0..1 around 0.5.
SHARED_FN float snow_preference(vec2 uv, uint seed)
{
    return tileable_fbm(uv, 9, 6, 57u + seed);
}

// How smooth it is, 0..1 around 0.5.
SHARED_FN float snow_gloss(vec2 uv, uint seed)
{
    return tileable_fbm(uv, 41, 3, 91u + seed);
}

// What gives a snow cover its edges and its relief: x, y of a soft normal, coded 0..1; the mask, spread
// as artists paint it (mean near 0.7, few dark spots); smoothness. texel: its side in uv.
SHARED_FN vec4 snow_texel(vec2 uv, float texel)
{
    const float gx = (snow_relief(uv + vec2(texel, 0.0f), 0u) - snow_relief(uv - vec2(texel, 0.0f), 0u)) /
                     (2.0f * texel);
    const float gy = (snow_relief(uv + vec2(0.0f, texel), 0u) - snow_relief(uv - vec2(0.0f, texel), 0u)) /
                     (2.0f * texel);
    const vec3 normal = normalize(vec3(-gx * kSnowSteepness, -gy * kSnowSteepness, 1.0f));
    const float mask = clamp(0.72f + (snow_preference(uv, 0u) - 0.5f) * 1.1f, 0.0f, 1.0f);
    return vec4(0.5f + 0.5f * normal.x, 0.5f + 0.5f * normal.y, mask, 0.32f + 0.14f * snow_gloss(uv, 0u));
}

SHARED_END

#endif
