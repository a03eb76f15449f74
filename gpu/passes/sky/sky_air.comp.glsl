#version 460
// Clear air by direction, small: u is the angle from the sun's azimuth, v the height above the horizon
// (more rows near it).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/light/atmosphere.h"
#include "gpu/passes/sky/sky_light_io.h"
#include "gpu/passes/sky/sky_io.h"

layout(local_size_x = SKY_TILE, local_size_y = SKY_TILE) in;
layout(binding = SKY_ALONE_TARGET, rgba16f) uniform writeonly image2D target;
layout(binding = SKY_AGAIN, scalar) readonly buffer Again { vec4 again[]; };
layout(push_constant, scalar) uniform Push { SkyParams sky; };

vec4 again_entry(int index)
{
    return again[index];
}

#include "formulas/light/air_radiance.inc"

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    const ivec2 size = imageSize(target);
    if (any(greaterThanEqual(texel, size))) return;
    const vec2 uv = (vec2(texel) + 0.5) / vec2(size);
    const float azimuth = uv.x * 3.14159265;
    const float up = uv.y * uv.y;
    const float level = sqrt(max(1.0 - up * up, 0.0));
    const float sun_up = sky.sun_direction.y;
    const float sun_level = sqrt(max(1.0 - sun_up * sun_up, 0.0));
    const float sun_angle = clamp(up * sun_up + level * sun_level * cos(azimuth), -1.0, 1.0);
    const vec3 radiance = air_radiance(up, sun_up, sun_angle, sky.sun_illuminance, sky.turbidity);
    imageStore(target, texel, vec4(min(radiance, vec3(60000.0)), 1.0));
}
