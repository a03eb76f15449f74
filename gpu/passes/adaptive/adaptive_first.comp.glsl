#version 460
// What the first sample saw.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/gbuffer.glsl"
#include "gpu/passes/adaptive/adaptive_io.h"
#include "gpu/upload/steep_io.h"

layout(local_size_x = ADAPTIVE_TILE, local_size_y = ADAPTIVE_TILE) in;
layout(binding = ADAPTIVE_FIRST_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = ADAPTIVE_FIRST_IDS) uniform usampler2D ids;
layout(binding = ADAPTIVE_FIRST_DEPTH) uniform sampler2D depth_map;
layout(binding = ADAPTIVE_FIRST_LIT) uniform sampler2D lit;
layout(binding = ADAPTIVE_FIRST_SEEN, rg32ui) uniform writeonly uimage2D seen;
layout(binding = ADAPTIVE_FIRST_LIGHT, rgba16f) uniform writeonly image2D light;

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, frame.size))) return;
    const uint draw = texelFetch(ids, texel, 0).r & ID_DRAW;
    const float depth_m = draw != 0u ? linear_depth(frame, texelFetch(depth_map, texel, 0).r) : 0.0;
    imageStore(seen, texel, uvec4(draw, floatBitsToUint(depth_m), 0u, 0u));
    imageStore(light, texel, texelFetch(lit, texel, 0));
}
