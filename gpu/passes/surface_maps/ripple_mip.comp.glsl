#version 460
// One level of the rings from the level above it: means of four normals and of their slopes' squares.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/weather/ripple.h"
#include "gpu/passes/surface_maps/map_mip.glsl"

layout(local_size_x = SURFACE_MAPS_TILE, local_size_y = SURFACE_MAPS_TILE) in;

RingSlopes slopes(uvec4 codes)
{
    const vec4 texel = vec4(codes) / 255.0;
    return RingSlopes(2.0 * texel.xy - 1.0, rings_square_of(texel.zw));
}

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(to)))) return;
    const FourTexels four = four_texels(texel);
    const RingSlopes all = rings_of_four(slopes(four.a), slopes(four.b), slopes(four.c), slopes(four.d));
    imageStore(to, texel, vec4(vec2(mean_codes(four, texel).xy) / 255.0, rings_square_code(all.square)));
}
