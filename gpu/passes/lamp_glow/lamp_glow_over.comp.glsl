#version 460
// Adds the glow of blocks to their pixels: between the blocks around, more of those as far away.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/gbuffer.glsl"
#include "gpu/passes/lamp_glow/lamp_glow_io.h"

layout(local_size_x = LAMP_GLOW_TILE, local_size_y = LAMP_GLOW_TILE) in;
layout(binding = LAMP_GLOW_OVER_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = LAMP_GLOW_OVER_DEPTH) uniform sampler2D depth_map;
layout(binding = LAMP_GLOW_OVER_COARSE) uniform sampler2D coarse;
layout(binding = LAMP_GLOW_OVER_ACCUMULATED, rgba32f) uniform image2D accumulated;

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, frame.size))) return;
    const float depth = texelFetch(depth_map, texel, 0).r;
    const float view_m = min(linear_depth(frame, depth), 1.0e5);
    const vec2 at = (vec2(texel) - float(GLOW_BLOCK / 2)) / float(GLOW_BLOCK);
    const ivec2 first = ivec2(floor(at));
    const vec2 f = at - vec2(first);
    const ivec2 last = textureSize(coarse, 0) - 1;
    vec4 sum = vec4(0.0);
    for (int k = 0; k < 4; ++k) {
        const ivec2 corner = ivec2(k & 1, k >> 1);
        const vec4 glow = texelFetch(coarse, clamp(first + corner, ivec2(0), last), 0);
        const vec2 near = mix(1.0 - f, f, vec2(corner));
        const float apart = abs(glow.a - view_m) / (0.05 * view_m + 0.05);
        const float weight = (near.x * near.y + 1.0e-4) / (1.0 + apart * apart * apart * apart);
        sum += vec4(glow.rgb, 1.0) * (weight + 1.0e-12);
    }
    vec4 color = imageLoad(accumulated, texel);
    color.rgb += sum.rgb / sum.a * frame.samples;
    imageStore(accumulated, texel, color);
}
