#version 460
// The texture that breaks up snow edges and gives a snow cover its relief, tileable:
// x, y of a soft normal in r, g; the mask in b; smoothness in a.
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
    const float d = 1.0 / float(size.x);
    const float gx =
        (snow_relief(uv + vec2(d, 0.0), 0u) - snow_relief(uv - vec2(d, 0.0), 0u)) / (2.0 * d);
    const float gy =
        (snow_relief(uv + vec2(0.0, d), 0u) - snow_relief(uv - vec2(0.0, d), 0u)) / (2.0 * d);
    const vec3 normal = normalize(vec3(-gx * kSnowSteepness, -gy * kSnowSteepness, 1.0));
    // Spread like the masks artists paint: mean near 0.7, few dark spots.
    const float mask = clamp(0.72 + (snow_preference(uv, 0u) - 0.5) * 1.1, 0.0, 1.0);
    const float smoothness = 0.32 + 0.14 * snow_gloss(uv, 0u);
    imageStore(target, texel, vec4(0.5 + 0.5 * normal.xy, mask, smoothness));
}
