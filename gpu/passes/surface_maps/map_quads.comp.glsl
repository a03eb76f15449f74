#version 460
// Red and green of four neighbours of a tileable map in one texel of a buffer, level beside level: what a CPU
// reads at once where it would ask an image four times. Where they lie: map_quads.glsl.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/surface_maps/map_quads.glsl"
#include "gpu/passes/surface_maps/surface_maps_io.h"

layout(local_size_x = SURFACE_MAPS_TILE, local_size_y = SURFACE_MAPS_TILE) in;
layout(binding = MAP_QUADS_MAP) uniform sampler2D map;
layout(binding = MAP_QUADS_QUADS, scalar) writeonly buffer Quads { uvec2 quads[]; };
layout(push_constant, scalar) uniform Push { MapQuadsParams params; };

// Of those who work: the first level at the left, the others one below the other beside it.
ivec2 corner_of(int level)
{
    return level == 0 ? ivec2(0) : ivec2(params.size, params.size - (params.size >> (level - 1)));
}

uint both(ivec2 texel, int level)
{
    return packUnorm4x8(vec4(texelFetch(map, texel, level).rg, 0.0, 0.0));
}

void main()
{
    const ivec2 place = ivec2(gl_GlobalInvocationID.xy);
    if (place.x >= params.size + max(params.size / 2, 1) || place.y >= params.size) return;
    int level = 0;
    if (place.x >= params.size) {
        level = 1;
        while (level + 1 < params.levels && place.y >= corner_of(level + 1).y) ++level;
    }
    const int side = max(params.size >> level, 1);
    const ivec2 at = place - corner_of(level);
    if (any(greaterThanEqual(at, ivec2(side)))) return;
    const ivec2 next = ivec2(at.x + 1 < side ? at.x + 1 : 0, at.y + 1 < side ? at.y + 1 : 0);
    quads[quads_place(params.levels - 1, level, at)] =
        uvec2(both(at, level) | (both(ivec2(next.x, at.y), level) << 16),
              both(ivec2(at.x, next.y), level) | (both(next, level) << 16));
}
