#version 460
// Draws the drops once: envelope (1 at the centre), direction away from it, and when each one falls.
// Tileable; one drop a jittered cell, so that neighbours never cut each other.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/noise/noise.glsl"
#include "gpu/passes/surface_maps/surface_maps_io.h"

layout(local_size_x = SURFACE_MAPS_TILE, local_size_y = SURFACE_MAPS_TILE) in;
layout(binding = SURFACE_MAPS_ALONE_TARGET, rgba8) uniform writeonly image2D target;

const int kCells = 9;

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    const ivec2 size = imageSize(target);
    if (any(greaterThanEqual(texel, size))) return;
    const vec2 at = (vec2(texel) + 0.5) / vec2(size) * float(kCells);
    const ivec2 cell = ivec2(floor(at));

    float envelope = 0.0;
    vec2 direction = vec2(0.0);
    float offset = 0.0;
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const ivec2 neighbour = cell + ivec2(dx, dy);
            const ivec2 wrapped = ivec2((neighbour.x + kCells) % kCells, (neighbour.y + kCells) % kCells);
            const uint id = hash_u3(uint(wrapped.x), uint(wrapped.y), 77u);
            const float radius = 0.34 + 0.14 * hash_f(id);
            const float free = 1.0 - 2.0 * radius;
            const vec2 jitter = vec2(hash_f(id + 1u), hash_f(id + 2u)) - 0.5;
            const vec2 centre = vec2(neighbour) + 0.5 + jitter * max(free, 0.0);
            const vec2 away = at - centre;
            const float e = 1.0 - length(away) / radius;
            if (e > envelope) {
                envelope = e;
                direction = away / max(length(away), 1.0e-4);
                offset = hash_f(id + 3u);
            }
        }
    }
    imageStore(target, texel, vec4(envelope, 0.5 + 0.5 * direction, offset));
}
