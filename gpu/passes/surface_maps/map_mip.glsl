// Four texels of a tileable map of 8 bits, and their mean: the same codes on every device.
#ifndef PETRICHOR_MAP_MIP_GLSL
#define PETRICHOR_MAP_MIP_GLSL

#include "gpu/passes/surface_maps/surface_maps_io.h"

layout(binding = MAP_MIP_FROM, rgba8) uniform readonly image2D from;
layout(binding = MAP_MIP_TO, rgba8) uniform writeonly image2D to;

struct FourTexels {
    uvec4 a, b, c, d;
};

uvec4 codes(ivec2 texel)
{
    return uvec4(imageLoad(from, texel) * 255.0 + 0.5);
}

FourTexels four_texels(ivec2 texel)
{
    const ivec2 first = 2 * texel;
    return FourTexels(codes(first), codes(first + ivec2(1, 0)), codes(first + ivec2(0, 1)), codes(first + ivec2(1)));
}

// Halves go up on every second texel: always up, nine levels would add a code.
uvec4 mean_codes(FourTexels four, ivec2 texel)
{
    return (four.a + four.b + four.c + four.d + 1u + (uint(texel.x + texel.y) & 1u)) >> 2u;
}

#endif
