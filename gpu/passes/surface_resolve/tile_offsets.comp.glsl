#version 460
// Where the pixels of each list begin: the counts become the beginnings, which listing moves to the ends.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/surface_resolve/surface_resolve_io.h"

layout(local_size_x = TILE_OFFSETS_GROUP) in;
layout(binding = TILE_OFFSETS_COUNTS, scalar) buffer Counts { uint counts[]; };
layout(binding = TILE_OFFSETS_GROUPS, scalar) writeonly buffer Groups { uint groups[]; };
layout(push_constant, scalar) uniform Push { TileOffsetsParams params; };

void main()
{
    uint begin = 0u;
    for (uint i = 0u; i < params.lists; ++i) {
        const uint pixels = counts[i];
        counts[i] = begin;
        begin += pixels;
        groups[3u * i] = (pixels + params.group - 1u) / params.group;
        groups[3u * i + 1u] = 1u;
        groups[3u * i + 2u] = 1u;
    }
}
