#version 460
// The whole sky as a cube map: air, clouds, the land below the horizon, fog before all of it. Alpha:
// what clouds and fog leave of the stars behind. Sun, moon and stars are not in it.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/light/atmosphere.h"
#include "formulas/light/brdf.h"
#include "formulas/light/cube_map.h"
#include "formulas/light/fog.h"
#include "formulas/light/rain_curtains.h"
#include "gpu/passes/sky/clouds.glsl"
#include "gpu/passes/sky/sky_io.h"

layout(local_size_x = SKY_TILE, local_size_y = SKY_TILE) in;
layout(binding = SKY_SOURCE) uniform sampler2D air;
layout(binding = SKY_TARGET, rgba16f) uniform writeonly image2DArray target;
layout(binding = SKY_TILES, scalar) readonly buffer Tiles { uint tiles[]; };
layout(constant_id = SKY_SPEC_LISTED) const uint LISTED = 0u;
layout(push_constant, scalar) uniform Push { SkyParams sky; };

vec3 clear_air(vec3 direction)
{
    const float up = max(direction.y, 0.0);
    const vec2 a = normalize(direction.xz + vec2(1.0e-5));
    const vec2 b = normalize(sky.sun_direction.xz + vec2(1.0e-5));
    const float azimuth = acos(clamp(dot(a, b), -1.0, 1.0)) / 3.14159265;
    return textureLod(air, vec2(azimuth, sqrt(up)), 0.0).rgb;
}

// Share of light from a direction that passes the fog: out of its layer, or over the land.
float kept_by_fog(float up)
{
    const float path = up >= 0.0 ? fog_path_to_sky(up, 0.0, sky.fog_height_m)
                                 : fog_path_to_land(up, fog_eye_of_sky_m(), sky.fog_height_m);
    return fog_kept(sky.fog_mode, path, sky.fog_per_m, sky.fog_start_m, sky.fog_end_m);
}

// What the fog itself sends: light from above, scattered until it comes from all sides (a thick layer
// throws a part of it back up), and around a sun that shines into it a glow. relief: of the clouds that light it there.
vec3 fog_radiance(vec3 direction, vec3 light_on_ground, float relief)
{
    const float depth = sky.fog_mode == FOG_LINEAR ? 0.0 : sky.fog_per_m * sky.fog_height_m;
    const vec3 from_all = light_on_ground * (relief * fog_from_above(direction.y, sky.land_albedo) / (kPi * (1.0 + 0.11 * depth)));
    const float up = max(sky.sun_direction.y, 0.05);
    const float shine = (1.0 - smoothstep(0.25, 0.95, sky.cloud_cover)) * exp(-depth / up);
    return from_all + sky.sun_at_ground * (shine * fog_phase(dot(direction, sky.sun_direction)));
}

void main()
{
    ivec3 id = ivec3(gl_GlobalInvocationID);
    if (LISTED != 0u) {
        const uint tile = tiles[gl_WorkGroupID.x];
        id = ivec3(ivec2(tile & 255u, tile >> 8 & 255u) * SKY_TILE + ivec2(gl_LocalInvocationID.xy), int(tile >> 16));
    }
    const ivec3 size = imageSize(target);
    if (any(greaterThanEqual(id.xy, size.xy))) return;
    const vec2 st = (vec2(id.xy) + 0.5) / vec2(size.xy) * 2.0 - 1.0;
    const vec3 direction = normalize(cube_direction(id.z, st));

    const vec3 zenith = clear_air(vec3(0.0, 1.0, 0.0));
    const vec3 seen = normalize(vec3(direction.x, max(direction.y, 0.002), direction.z));
    vec3 radiance = vec3(0.0);
    float seen_through = 1.0;
    float relief = 1.0;
    vec3 curtains = vec3(1.0);
    if (direction.y > -0.06) {
        radiance = clear_air(seen);
        const CloudSeen clouds = cloud_seen(sky, seen);
        const vec3 cloud = cloud_radiance(sky, seen, clouds, zenith);
        // Far clouds fade into the haze of the horizon.
        const float haze = mix(exp(-0.06 / max(seen.y, 0.004)), 1.0, smoothstep(0.6, 1.0, sky.cloud_cover));
        radiance = mix(radiance, cloud, clouds.hides * haze);
        seen_through = 1.0 - clouds.hides * haze;
        // Rain and fog are lit by all clouds around them, most by those they hang under.
        relief += 0.5 * sky.rain * clouds.hides * (sky.relief_gain * layer_relief(clouds.heavy, clouds.hidden, sky.rain) - 1.0);
        if (sky.rain * clouds.hides > 0.0 && direction.y < kCurtainEnds) {
            const vec2 rains = rain_curtains(seen, sky.time_s * sky.wind_m_s, sky.wind_m_s * kCurtainLean_per_m_s, sky.rain);
            curtains = mix(vec3(1.0), rains.x * (1.0 + rains.y * vec3(-0.05, 0.0058, 0.09)), clouds.hides);
        }
    }
    radiance += sky.night_radiance * vec3(0.75, 0.85, 1.1);
    const float below = smoothstep(0.0, -0.06, direction.y);
    radiance = mix(radiance, sky.ground_radiance + sky.night_radiance * 0.5, below);
    seen_through *= 1.0 - below;
    if (sky.fog_per_m > 0.0) {
        seen_through *= kept_by_fog(direction.y);
        const vec3 lit = light_under_clouds(sky) + sky.night_radiance * kPi;
        radiance = mix(fog_radiance(direction, lit, relief), radiance, kept_by_fog(direction.y));
    }
    radiance *= mix(curtains, vec3(1.0), below);
    imageStore(target, id, vec4(min(radiance, vec3(60000.0)), seen_through));
}
