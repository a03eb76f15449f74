#version 460
// One level of a tileable map of 8 bits from the level above it: means of four texels, the same codes on every device.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/surface_maps/surface_maps_io.h"

layout(local_size_x = SURFACE_MAPS_TILE, local_size_y = SURFACE_MAPS_TILE) in;
layout(binding = MAP_MIP_FROM, rgba8) uniform readonly image2D from;
layout(binding = MAP_MIP_TO, rgba8) uniform writeonly image2D to;

uvec4 codes(ivec2 texel)
{
    return uvec4(imageLoad(from, texel) * 255.0 + 0.5);
}

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(to)))) return;
    const ivec2 first = 2 * texel;
    const uvec4 sum = codes(first) + codes(first + ivec2(1, 0)) + codes(first + ivec2(0, 1)) + codes(first + ivec2(1));
    // Halves go up on every second texel: always up, nine levels would add a code.
    imageStore(to, texel, vec4((sum + 1u + (uint(texel.x + texel.y) & 1u)) >> 2u) / 255.0);
}
