#version 460
// One invocation a tile. A calm pixel where this sample sees the surface that was seen before takes the
// mean of the samples that were shaded; every other is listed. The order of the list decides no pixel.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/gbuffer.glsl"
#include "gpu/passes/adaptive/adaptive_io.h"
#include "gpu/upload/steep_io.h"

layout(local_size_x = ADAPTIVE_TILE, local_size_y = ADAPTIVE_TILE) in;
layout(binding = ADAPTIVE_ASK_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = ADAPTIVE_ASK_IDS) uniform usampler2D ids;
layout(binding = ADAPTIVE_ASK_DEPTH) uniform sampler2D depth_map;
layout(binding = ADAPTIVE_ASK_SEEN) uniform usampler2D seen;
layout(binding = ADAPTIVE_ASK_MEAN) uniform sampler2D mean;
layout(binding = ADAPTIVE_ASK_LIT, rgba32f) uniform image2D lit;
layout(binding = ADAPTIVE_ASK_ASKED, scalar) writeonly buffer Asked { uvec2 asked[]; };
layout(binding = ADAPTIVE_ASK_LIST, scalar) buffer List { uint count; uint pixels[]; };

const float kBeyond = 0.01;  // of the distance, over what the two samples span

bool is_known(ivec2 texel)
{
    const uvec2 before = texelFetch(seen, texel, 0).xy;
    const uint draw = texelFetch(ids, texel, 0).r & ID_DRAW;
    if (draw != before.x) return false;
    if (draw == 0u) return true;
    const vec2 range_m = unpackHalf2x16(before.y);
    const float beyond_m = range_m.y - range_m.x + kBeyond * range_m.x;
    const float depth_m = linear_depth(frame, texelFetch(depth_map, texel, 0).r);
    return depth_m >= range_m.x - beyond_m && depth_m <= range_m.y + beyond_m;
}

void main()
{
    const ivec2 tiles = (frame.size + ADAPTIVE_TILE - 1) / ADAPTIVE_TILE;
    const ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(tile, tiles))) return;
    const ivec2 low = tile * ADAPTIVE_TILE;
    const ivec2 high = min(low + ADAPTIVE_TILE, frame.size);
    uvec2 bits = uvec2(0u);
    for (int y = low.y; y < high.y; ++y) {
        for (int x = low.x; x < high.x; ++x) {
            const ivec2 texel = ivec2(x, y);
            if (is_known(texel)) {
                imageStore(lit, texel, imageLoad(lit, texel) + texelFetch(mean, texel, 0));
            } else {
                const uint at = uint((y - low.y) * ADAPTIVE_TILE + x - low.x);
                const uint bit = 1u << (at & 31u);
                if (at < 32u) bits.x |= bit;
                else bits.y |= bit;
            }
        }
    }
    asked[tile.y * tiles.x + tile.x] = bits;
    uint next = atomicAdd(count, uint(bitCount(bits.x) + bitCount(bits.y)));
    for (int half_ = 0; half_ < 2; ++half_) {
        uint left = half_ == 0 ? bits.x : bits.y;
        while (left != 0u) {
            const int bit = findLSB(left);
            left &= left - 1u;
            const int at = bit + 32 * half_;
            pixels[next++] = uint(low.y + at / ADAPTIVE_TILE) * 65536u + uint(low.x + at % ADAPTIVE_TILE);
        }
    }
}
