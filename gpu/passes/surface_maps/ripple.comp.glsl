#version 460
// The rings of this moment: four layers of drops of many sizes, summed as slopes (formulas/weather/ripple.h, ring_sizes.h). Red and green: x and y of the normal; blue and alpha, of
// smaller levels: the mean of x^2 + y^2 (ripple_mip.comp.glsl).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/weather/ring_sizes.h"
#include "gpu/passes/surface_maps/surface_maps_io.h"

layout(local_size_x = SURFACE_MAPS_TILE, local_size_y = SURFACE_MAPS_TILE) in;
layout(binding = RIPPLE_SOURCE) uniform sampler2D source;
layout(binding = RIPPLE_TARGET, rgba8) uniform writeonly image2D target;

layout(push_constant, scalar) uniform Push { RippleParams params; };

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    const ivec2 size = imageSize(target);
    if (any(greaterThanEqual(texel, size))) return;
    const vec2 uv = (vec2(texel) + 0.5) / vec2(size);
    vec2 slope = vec2(0.0);
    for (int i = 0; i < kRippleLayers; ++i) {
        const RippleLayer layer = ripple_layer(i, params.rain, params.time_s, params.speed);
        if (layer.weight <= 0.0) continue;
        // The time offset is constant over a drop and must not be blended with its neighbour's.
        const vec2 at = uv + layer.offset;
        const ivec2 source_size = textureSize(source, 0);
        const vec4 smooth_part = textureLod(source, at, 0.0);
        const ivec2 nearest = ivec2(fract(at) * vec2(source_size));
        const float drop_time = texelFetch(source, nearest, 0).a;
        slope += layer.weight *
                 sized_ripple_slope(vec4(smooth_part.xyz, drop_time), layer, i, params.spread);
    }
    const vec3 normal = normalize(vec3(slope, 1.0));
    imageStore(target, texel, vec4(0.5 * normal.xy + 0.5, 0.0, 0.0));
}
