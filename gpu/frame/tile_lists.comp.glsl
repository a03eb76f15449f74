#version 460
// Lists the tiles that show a surface, and those that show none somewhere. An invocation a tile; the order of a list
// decides no pixel.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/frame_io.h"
#include "gpu/frame/pixel_list_io.h"

layout(local_size_x = TILE_LISTS_GROUP) in;
layout(binding = TILE_LISTS_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = TILE_LISTS_DEPTH_ROWS) uniform samplerBuffer depth_rows;
layout(binding = TILE_LISTS_SURFACES, scalar) writeonly buffer Surfaces { uint surface_head; uint surface_tiles[]; };
layout(binding = TILE_LISTS_SURFACE_GROUPS, scalar) buffer SurfaceGroups { uint surface_count; };
layout(binding = TILE_LISTS_OPEN, scalar) writeonly buffer Open { uint open_head; uint open_tiles[]; };
layout(binding = TILE_LISTS_OPEN_GROUPS, scalar) buffer OpenGroups { uint open_count; };

void main()
{
    const ivec2 tiles = (frame.size + PIXEL_LIST_TILE - 1) / PIXEL_LIST_TILE;
    const int index = int(gl_GlobalInvocationID.x);
    if (index >= tiles.x * tiles.y) return;
    const ivec2 tile = ivec2(index % tiles.x, index / tiles.x);
    float nearest = 0.0;
    float farthest = 1.0;
    for (int i = 0; i < PIXEL_LIST_GROUP; ++i) {
        const ivec2 at = min(tile * PIXEL_LIST_TILE + ivec2(i % PIXEL_LIST_TILE, i / PIXEL_LIST_TILE), frame.size - 1);
        const float depth = texelFetch(depth_rows, at.y * frame.size.x + at.x).r;
        nearest = max(nearest, depth);
        farthest = min(farthest, depth);
    }
    const uint packed = uint(tile.y) * 65536u + uint(tile.x);
    if (nearest > 0.0) surface_tiles[atomicAdd(surface_count, 1u)] = packed;
    if (farthest <= 0.0) open_tiles[atomicAdd(open_count, 1u)] = packed;
}
