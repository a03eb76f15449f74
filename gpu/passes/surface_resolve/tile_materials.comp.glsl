#version 460
// One invocation a tile: its materials, each once. The first run counts the tiles of a material, the
// second lists them. The order inside a list is the order in which tiles were reached; it decides no
// pixel.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/surface_resolve/surface_resolve_io.h"

layout(local_size_x = TILE_MATERIALS_GROUP, local_size_y = TILE_MATERIALS_GROUP) in;
layout(constant_id = TILE_MATERIALS_SPEC_LIST) const uint LIST = 0u;
layout(binding = TILE_MATERIALS_IDS) uniform usampler2D ids;
layout(binding = TILE_MATERIALS_DRAWS) uniform usamplerBuffer draws;
layout(binding = TILE_MATERIALS_COUNTS, scalar) buffer Counts { uint counts[]; };
layout(binding = TILE_MATERIALS_TILES, scalar) writeonly buffer Tiles { uint tiles[]; };
layout(push_constant, scalar) uniform Push { TileMaterialsParams params; };

void main()
{
    const ivec2 count = (params.size + RESOLVE_TILE - 1) / RESOLVE_TILE;
    const ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(tile, count))) return;
    const ivec2 low = tile * RESOLVE_TILE;
    const ivec2 high = min(low + RESOLVE_TILE, params.size);
    uint found[RESOLVE_TILE_MATERIALS];
    uint different = 0u;
    uint last_draw = 0u;
    for (int y = low.y; y < high.y; ++y) {
        for (int x = low.x; x < high.x; ++x) {
            const uint draw = texelFetch(ids, ivec2(x, y), 0).r;
            if (draw == 0u || draw == last_draw) continue;
            last_draw = draw;
            const uint material =
                texelFetch(draws, int(draw - 1u) * RESOLVE_DRAW_TEXELS + 6).z;
            bool known = false;
            for (uint i = 0u; i < different; ++i) known = known || found[i] == material;
            if (!known) found[different++] = material;
        }
    }
    for (uint i = 0u; i < different; ++i) {
        const uint at = atomicAdd(counts[found[i]], 1u);
        if (LIST != 0u) tiles[at] = uint(tile.y) * 65536u + uint(tile.x);
    }
}
