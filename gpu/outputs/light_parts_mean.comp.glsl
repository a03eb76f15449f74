#version 460
// The parts of the light of pixels that later samples do not shade: kept after the first sample, halved after
// the second, taken by the others.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/frame_io.h"
#include "gpu/outputs/light_parts_io.h"

layout(local_size_x = LIGHT_PARTS_TILE, local_size_y = LIGHT_PARTS_TILE) in;
layout(constant_id = PARTS_MEAN_SPEC_WHAT) const int WHAT = PARTS_MEAN_KEEP;
layout(binding = PARTS_MEAN_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = PARTS_MEAN_LIT, rgba32f) uniform image2DArray lit;
layout(binding = PARTS_MEAN_MEAN, rgba32f) uniform image2DArray mean;
layout(binding = PARTS_MEAN_ASKED, scalar) readonly buffer Asked { uvec2 asked[]; };

// This sample shades the pixel.
bool is_shaded(ivec2 texel)
{
    const ivec2 tile = texel / LIGHT_PARTS_TILE;
    const int across = (frame.size.x + LIGHT_PARTS_TILE - 1) / LIGHT_PARTS_TILE;
    const ivec2 in_tile = texel - tile * LIGHT_PARTS_TILE;
    const int at = in_tile.y * LIGHT_PARTS_TILE + in_tile.x;
    const uvec2 bits = asked[tile.y * across + tile.x];
    return (((at < 32 ? bits.x : bits.y) >> (at & 31)) & 1u) != 0u;
}

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, frame.size))) return;
    if (WHAT == PARTS_MEAN_TAKE) {
        if (is_shaded(texel)) return;
    }
    for (int i = 0; i < LIGHT_PARTS; ++i) {
        const ivec3 at = ivec3(texel, i);
        const vec4 here = imageLoad(lit, at);
        if (WHAT == PARTS_MEAN_KEEP) imageStore(mean, at, here);
        if (WHAT == PARTS_MEAN_OF_TWO) imageStore(mean, at, 0.5 * (imageLoad(mean, at) + here));
        if (WHAT == PARTS_MEAN_OF_SUM) imageStore(mean, at, 0.5 * here);
        if (WHAT == PARTS_MEAN_TAKE) imageStore(lit, at, here + imageLoad(mean, at));
    }
}
