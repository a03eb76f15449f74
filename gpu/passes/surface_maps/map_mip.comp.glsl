#version 460
// One level of a tileable map of 8 bits from the level above it.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/surface_maps/map_mip.glsl"

layout(local_size_x = SURFACE_MAPS_TILE, local_size_y = SURFACE_MAPS_TILE) in;

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(to)))) return;
    imageStore(to, texel, vec4(mean_codes(four_texels(texel), texel)) / 255.0);
}
