#version 460
// A level with its share of the wider ones below it.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/glare/glare_io.h"
layout(constant_id = GLARE_SPEC_FILTERS) const uint FILTERS = 0u;
#include "gpu/passes/glare/glare.glsl"

layout(local_size_x = GLARE_TILE, local_size_y = GLARE_TILE) in;
layout(binding = GLARE_WIDER) uniform sampler2D wider;
layout(binding = GLARE_LEVEL, rgba32f) uniform image2D level;
layout(push_constant, scalar) uniform Push { GlareParams params; };

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(level)))) return;
    imageStore(level, texel, mix(imageLoad(level, texel), glare_between(wider, texel), params.scale));
}
