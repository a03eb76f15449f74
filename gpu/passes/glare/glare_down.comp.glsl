#version 460
// A level of half the size: (1 3 3 1) / 8 across and down, so that every texel gives a quarter.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/glare/glare.glsl"
#include "gpu/passes/glare/glare_io.h"

layout(local_size_x = GLARE_TILE, local_size_y = GLARE_TILE) in;
layout(binding = GLARE_SOURCE) uniform sampler2D source;
layout(binding = GLARE_TARGET, rgba32f) uniform writeonly image2D target;
layout(push_constant, scalar) uniform Push { GlareParams params; };

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(target)))) return;
    vec4 sum = vec4(0.0);
    for (int y = -1; y <= 2; ++y) {
        vec4 row = vec4(0.0);
        for (int x = -1; x <= 2; ++x) {
            row += glare_at(source, 2 * texel + ivec2(x, y)) * ((x & 2) == 0 ? 3.0 : 1.0);
        }
        sum += row * ((y & 2) == 0 ? 3.0 : 1.0);
    }
    imageStore(target, texel, sum * (params.scale / 64.0));
}
