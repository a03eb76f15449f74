#version 460
// A level of half the size.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/glare/glare_io.h"
layout(constant_id = GLARE_SPEC_FILTERS) const uint FILTERS = 0u;
#include "gpu/passes/glare/glare.glsl"

layout(local_size_x = GLARE_TILE, local_size_y = GLARE_TILE) in;
layout(binding = GLARE_SOURCE) uniform sampler2D source;
layout(binding = GLARE_TARGET, rgba32f) uniform writeonly image2D target;
layout(push_constant, scalar) uniform Push { GlareParams params; };

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(target)))) return;
    imageStore(target, texel, glare_below(source, texel) * params.scale);
}
