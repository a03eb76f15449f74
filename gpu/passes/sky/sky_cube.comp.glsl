#version 460
// The whole sky as a cube map: air, clouds, the land below the horizon. The sun's disc is not in it.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/light/atmosphere.h"
#include "gpu/passes/sky/clouds.glsl"
#include "gpu/passes/sky/cube.glsl"
#include "gpu/passes/sky/sky_io.h"

layout(local_size_x = SKY_TILE, local_size_y = SKY_TILE) in;
layout(binding = SKY_SOURCE) uniform sampler2D air;
layout(binding = SKY_TARGET, rgba16f) uniform writeonly image2DArray target;
layout(push_constant, scalar) uniform Push { SkyParams sky; };

vec3 clear_air(vec3 direction)
{
    const float up = max(direction.y, 0.0);
    const vec2 a = normalize(direction.xz + vec2(1.0e-5));
    const vec2 b = normalize(sky.sun_direction.xz + vec2(1.0e-5));
    const float azimuth = acos(clamp(dot(a, b), -1.0, 1.0)) / 3.14159265;
    return textureLod(air, vec2(azimuth, sqrt(up)), 0.0).rgb;
}

void main()
{
    const ivec3 id = ivec3(gl_GlobalInvocationID);
    const ivec3 size = imageSize(target);
    if (any(greaterThanEqual(id.xy, size.xy))) return;
    const vec2 st = (vec2(id.xy) + 0.5) / vec2(size.xy) * 2.0 - 1.0;
    const vec3 direction = normalize(cube_direction(id.z, st));

    const vec3 sun_at_ground =
        sky.sun_illuminance * air_transmittance(2.0, max(sky.sun_direction.y, 0.0), sky.turbidity) *
        smoothstep(-0.08, 0.02, sky.sun_direction.y);
    const vec3 zenith = clear_air(vec3(0.0, 1.0, 0.0));
    const vec3 seen = normalize(vec3(direction.x, max(direction.y, 0.002), direction.z));
    vec3 radiance = clear_air(seen);
    const vec2 cover = cloud_cover_at(sky, seen);
    const vec3 cloud = cloud_radiance(sky, seen, cover, sun_at_ground, zenith);
    // Far clouds fade into the haze of the horizon.
    const float haze = mix(exp(-0.06 / max(seen.y, 0.004)), 1.0, smoothstep(0.6, 1.0, sky.cloud_cover));
    radiance = mix(radiance, cloud, cover.x * haze);
    radiance += sky.night_radiance * vec3(0.75, 0.85, 1.1);
    const float below = smoothstep(0.0, -0.06, direction.y);
    radiance = mix(radiance, sky.ground_radiance + sky.night_radiance * 0.5, below);
    imageStore(target, id, vec4(min(radiance, vec3(60000.0)), 1.0));
}
