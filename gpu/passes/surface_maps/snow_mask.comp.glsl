#version 460
// The texture that breaks up snow edges and gives a snow cover its relief, tileable.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/weather/weather_maps.h"
#include "gpu/passes/surface_maps/surface_maps_io.h"

layout(local_size_x = SURFACE_MAPS_TILE, local_size_y = SURFACE_MAPS_TILE) in;
layout(binding = SURFACE_MAPS_ALONE_TARGET, rgba8) uniform writeonly image2D target;

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    const ivec2 size = imageSize(target);
    if (any(greaterThanEqual(texel, size))) return;
    const vec2 uv = (vec2(texel) + 0.5) / vec2(size);
    imageStore(target, texel, snow_texel(uv, 1.0 / float(size.x)));
}
