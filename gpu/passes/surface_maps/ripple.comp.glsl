#version 460
// The rings of this moment: four layers of drops of many sizes, summed as slopes (formulas/weather/ripple.h, ring_sizes.h). Red and green: x and y of the normal; blue and alpha, of
// smaller levels: the mean of x^2 + y^2 (ripple_mip.comp.glsl).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "formulas/weather/ring_sizes.h"
#include "gpu/passes/surface_maps/surface_maps_io.h"

layout(local_size_x = SURFACE_MAPS_TILE, local_size_y = SURFACE_MAPS_TILE) in;
layout(binding = RIPPLE_SOURCE) uniform sampler2D source;
layout(binding = RIPPLE_TARGET, rgba8) uniform writeonly image2D target;

layout(push_constant, scalar) uniform Push { RippleParams params; };

// What a layer has at a place of the map. The time offset is constant over a drop and must not be blended with its neighbour's.
vec4 source_at(vec2 at)
{
    const ivec2 nearest = ivec2(fract(at) * vec2(textureSize(source, 0)));
    return vec4(textureLod(source, at, 0.0).xyz, texelFetch(source, nearest, 0).a);
}

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    const ivec2 size = imageSize(target);
    if (any(greaterThanEqual(texel, size))) return;
    const vec2 uv = (vec2(texel) + 0.5) / vec2(size);
    vec4 sources[kRippleLayers];
    uint here = 0u;
    for (int i = 0; i < kRippleLayers; ++i) {
        const RippleLayer layer = ripple_layer(i, params.rain, params.time_s, params.speed);
        sources[i] = source_at(uv + layer.offset);
        if (layer.weight > 0.0 && ring_is_here(sources[i], fract(sources[i].w + layer.clock))) here |= 1u << uint(i);
    }
    // Layer by layer that has a ring here, which most have not. All texels of a group take as many turns as the one that has most: lavapipe
    // loses sums of those that leave a loop before others (docs/platform.md, 2).
    vec2 slope = vec2(0.0);
    int left = subgroupMax(bitCount(here));
    do {
        const int i = here != 0u ? findLSB(here) : 0;
        const RippleLayer layer = ripple_layer(i, params.rain, params.time_s, params.speed);
        const vec4 chosen = i == 0 ? sources[0] : i == 1 ? sources[1] : i == 2 ? sources[2] : sources[3];
        const vec2 one = layer.weight * sized_ripple_slope(chosen, layer, i, params.spread);
        slope += here != 0u ? one : vec2(0.0);
        here &= ~(1u << uint(i));
    } while (--left > 0);
    const vec3 normal = normalize(vec3(slope, 1.0));
    imageStore(target, texel, vec4(0.5 * normal.xy + 0.5, 0.0, 0.0));
}
