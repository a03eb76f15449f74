#version 460
// One invocation a tile: how many of its pixels show which material. The first run counts the pixels of a
// material, the second lists them. The order inside a list is the order in which tiles were reached; it
// decides no pixel.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/surface_resolve/surface_resolve_io.h"

layout(local_size_x = TILE_MATERIALS_GROUP, local_size_y = TILE_MATERIALS_GROUP) in;
layout(constant_id = TILE_MATERIALS_SPEC_LIST) const uint LIST = 0u;
layout(constant_id = TILE_MATERIALS_SPEC_ASKED) const uint ASKED = 0u;
layout(binding = TILE_MATERIALS_IDS) uniform usamplerBuffer ids;  // row by row
layout(binding = TILE_MATERIALS_DRAWS) uniform usamplerBuffer draws;
layout(binding = TILE_MATERIALS_COUNTS, scalar) buffer Counts { uint counts[]; };
layout(binding = TILE_MATERIALS_PIXELS, scalar) writeonly buffer Pixels { uint pixels[]; };
layout(binding = TILE_MATERIALS_ASKED, scalar) readonly buffer Asked { uvec2 asked[]; };
layout(push_constant, scalar) uniform Push { TileMaterialsParams params; };

void main()
{
    const ivec2 count = (params.size + RESOLVE_TILE - 1) / RESOLVE_TILE;
    const ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(tile, count))) return;
    const ivec2 low = tile * RESOLVE_TILE;
    const ivec2 high = min(low + RESOLVE_TILE, params.size);
    const uvec2 bits = ASKED != 0u ? asked[tile.y * count.x + tile.x] : uvec2(~0u);
    uint found[RESOLVE_TILE_MATERIALS];
    uint number[RESOLVE_TILE_MATERIALS];
    uint slots[RESOLVE_TILE * RESOLVE_TILE];  // of each pixel: its list's place in the two above
    uint different = 0u;
    uint last_id = 0u;
    uint last_slot = 0u;
    if ((bits.x | bits.y) == 0u) return;
    // Loops that ask at their end: a CPU takes one that asks at its beginning once more.
    int y = low.y;
    do {
        int x = low.x;
        do {
            const uint at = uint((y - low.y) * RESOLVE_TILE + x - low.x);
            const uint word = at < 32u ? bits.x : bits.y;
            const bool wanted = ((word >> (at & 31u)) & 1u) != 0u;
            const uint id = wanted ? texelFetch(ids, y * params.size.x + x).r : 0u;
            if (LIST != 0u) slots[at] = ~0u;
            if (id != 0u) {
                if (id != last_id) {
                    last_id = id;
                    const uint facts = texelFetch(draws, int((id & ID_DRAW) - 1u) * RESOLVE_DRAW_TEXELS + 6).z;
                    const bool steep = params.steep != 0u && ((id & ID_STEEP) | (facts & params.steep)) != 0u;
                    const uint list = 2u * (facts & DRAW_MATERIAL) + (steep ? 1u : 0u);
                    last_slot = 0u;
                    while (last_slot < different && found[last_slot] != list) ++last_slot;
                    if (last_slot == different) {
                        found[different] = list;
                        number[different++] = 0u;
                    }
                }
                ++number[last_slot];
                if (LIST != 0u) slots[at] = last_slot;
            }
        } while (++x < high.x);
    } while (++y < high.y);
    for (uint i = 0u; i < different; ++i) number[i] = atomicAdd(counts[found[i]], number[i]);
    if (LIST == 0u) return;
    y = low.y;
    do {
        int x = low.x;
        do {
            const uint slot = slots[(y - low.y) * RESOLVE_TILE + x - low.x];
            if (slot != ~0u) pixels[number[slot]++] = uint(y) * 65536u + uint(x);
        } while (++x < high.x);
    } while (++y < high.y);
}
