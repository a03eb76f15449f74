#version 460
// What is seen where no surface is.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/light/cube_map.h"
#include "formulas/light/fog.h"
#include "formulas/weather/falling.h"
#include "formulas/weather/gusts.h"
#include "gpu/frame/gbuffer.glsl"
#include "gpu/outputs/light_parts_io.h"
#include "gpu/passes/background/background_io.h"
#include "gpu/passes/sky/sky_light_io.h"
#define PIXEL_LIST_BINDING BACKGROUND_PIXELS
#include "gpu/frame/pixel_list.glsl"

layout(local_size_x = BACKGROUND_TILE, local_size_y = BACKGROUND_TILE) in;
layout(constant_id = BACKGROUND_SPEC_SKY) const uint SKY = 1u;
layout(constant_id = BACKGROUND_SPEC_NIGHT) const uint NIGHT = 1u;
layout(constant_id = BACKGROUND_SPEC_FOG) const uint FOG = 1u;
layout(constant_id = BACKGROUND_SPEC_PARTS) const uint PARTS = 0u;
layout(constant_id = BACKGROUND_SPEC_MIRRORED) const uint MIRRORED = 1u;
layout(constant_id = BACKGROUND_SPEC_SKYLINE) const uint SKYLINE = 0u;
layout(push_constant, scalar) uniform Push { BackgroundParams params; };
layout(binding = BACKGROUND_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = BACKGROUND_DEPTH_ROWS) uniform samplerBuffer depth_rows;
layout(binding = BACKGROUND_SKY) uniform samplerCube sky_map;
layout(binding = BACKGROUND_ACCUMULATED, rgba32f) uniform image2D accumulated;
layout(binding = BACKGROUND_RADIANCE, rgba16f) uniform writeonly image2D radiance_out;
layout(binding = BACKGROUND_SKY_LIGHT, scalar) uniform Light { SkyLight sky_light; };
layout(binding = BACKGROUND_PARTS, rgba32f) uniform image2DArray light_parts;

const uint GUSTS = 0u;
#include "gpu/frame/air.glsl"
#include "gpu/passes/lighting/light_parts.glsl"
#include "gpu/passes/background/skyline.glsl"
#include "gpu/passes/sky/night.glsl"

// Where the sky's map is asked in a direction over the horizon: no lower than the middle of its first row, below which
// it fades into the land.
vec3 over_horizon(vec3 direction)
{
    const float row = max(abs(direction.x), abs(direction.z)) / float(textureSize(sky_map, 0).x);
    return vec3(direction.x, max(direction.y, row), direction.z);
}

// The land of the sky, which shows it as an eye near the ground does: from higher up more air lies before it.
vec3 land_behind_air(vec3 radiance, vec3 direction)
{
    if ((frame.flags & FRAME_LAND) == 0u || direction.y >= 0.0) return radiance;
    // Where the ground of the scene goes on it is that ground, told without air; near the horizon the sky's own.
    // What stands on the land hides that seam, and needs land to stand on.
    const float soft = SKYLINE != 0u ? 0.002 : 0.02;
    const float below = smoothstep(0.0, soft, -direction.y);
    const float known = frame.land.w * below;
    vec3 level = vec3(0.0);
    if (FOG != 0u) {
        // The map has less air before what is just below the horizon than before the sky over it: at dusk that was a bright line.
        level = textureLod(sky_map, over_horizon(vec3(direction.x, 0.0, direction.z)), 0.0).rgb;
        radiance = mix(level * frame.sky_scale, radiance, below);
    }
    vec3 land = frame.land.rgb;
    // Wet land mirrors the sky where it is seen along its surface, as the ground before it does; how much is ours, by eye.
    if (SKYLINE != 0u) land += textureLod(sky_map, air_level(direction), kAirMip).rgb * frame.sky_scale * (0.15 * frame.weather.film_smoothness * pow(1.0 + direction.y, 24.0));
    radiance = mix(radiance, land, known);
    if (FOG == 0u) return radiance;
    const float path_m =
        fog_path_to_land(direction.y, frame.camera_m.y - frame.fog_base_m, frame.fog_height_m) -
        (1.0 - known) * fog_path_to_land(direction.y, fog_eye_of_sky_m(), frame.fog_height_m);
    const float distance_m = (frame.camera_m.y - frame.fog_base_m) / max(-direction.y, 1.0e-6);
    const float drawn = drawn_depth(max(distance_m, 0.0), frame.drawn_per_m, frame.drawn_reach_m);
    const float kept = fog_kept(frame.fog_mode, max(path_m, 0.0), frame.fog_per_m, frame.fog_start_m,
                                frame.fog_end_m) * exp(drawn);
    // At the horizon the air is that of the sky above it; below, that of what stands on the land.
    const vec3 veil = mix(level, textureLod(sky_map, air_level(direction), kAirMip).rgb,
                          smoothstep(0.0, 2.0 * soft, -direction.y));
    return mix(veil * frame.sky_scale, radiance, min(kept, 1.0));
}

vec4 sky_texel(vec3 direction, bool over_land)
{
    return textureLod(sky_map, over_land ? over_horizon(direction) : direction, 0.0);
}

// The sky's map. Where its texels are wider than pixels it goes between them by a cubic spline, in four looks of its own
// filter (Sigg and Hadwiger 2005): that alone draws the edges of clouds as stairs.
vec4 sky_seen(vec3 direction, bool over_land)
{
    const float side = float(textureSize(sky_map, 0).x);
    if (pixel_width_m(frame, 1.0) * side >= 2.0) return sky_texel(direction, over_land);
    const vec3 a = abs(direction);
    const float longest = max(a.x, max(a.y, a.z));
    const vec3 on_cube = direction / longest;
    const vec3 s = a.x >= longest ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    const vec3 t = a.x < longest && a.z >= longest ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
    const vec2 at = vec2(dot(on_cube, s), dot(on_cube, t));
    const vec2 texel = (at * 0.5 + 0.5) * side - 0.5;
    const vec2 low = floor(texel);
    const vec3 across = spline_looks(texel.x - low.x), along = spline_looks(texel.y - low.y);
    vec4 sum = vec4(0.0);
    for (int k = 0; k < 4; ++k) {
        const bvec2 second = bvec2((k & 1) != 0, (k & 2) != 0);
        const vec2 place = low + mix(vec2(across.x, along.x), vec2(across.y, along.y), second);
        const vec2 share = mix(vec2(across.z, along.z), 1.0 - vec2(across.z, along.z), second);
        const vec2 off = (place + 0.5) * (2.0 / side) - 1.0 - at;
        sum += share.x * share.y * sky_texel(on_cube + s * off.x + t * off.y, over_land);
    }
    return sum;
}

vec3 background(vec3 direction)
{
    const bool over_land = (frame.flags & FRAME_LAND) != 0u && FOG != 0u && direction.y >= 0.0;
    const vec4 sky = sky_seen(direction, over_land);
    vec3 radiance = land_behind_air(sky.rgb * frame.sky_scale, direction);
    if (NIGHT != 0u) radiance += night_lights(direction) * sky.a;
    if ((frame.flags & FRAME_SUN_DISC) != 0u) {
        const float c = dot(direction, frame.sun_direction);
        if (c > frame.sun_angular_cos) {
            const float solid_angle = 6.2831853 * (1.0 - frame.sun_angular_cos);
            radiance += frame.sun_illuminance * (sky.a / solid_angle);
        }
    }
    if (SKYLINE != 0u) radiance = before_skyline(radiance, direction, params.skyline_from_m);
    return radiance;
}

void main()
{
    ivec2 texel;
    if (!this_pixel(frame.size, texel)) return;
    if (texelFetch(depth_rows, texel.y * frame.size.x + texel.x).r > 0.0) return;
    vec3 radiance = vec3(0.0);
    if (SKY != 0u) radiance = background(pixel_view_direction(frame, vec2(texel) + 0.5));
    const vec4 result = vec4(min(radiance, vec3(60000.0)), 0.0);
    if (PARTS != 0u) {
        PartsOfLight parts = no_parts();
        parts.of[PART_BACKGROUND] = result.rgb;
        store_parts(parts, texel);
    }
    if (MIRRORED != 0u) imageStore(radiance_out, texel, result);
    imageStore(accumulated, texel, frame.sample_index > 0u ? result + imageLoad(accumulated, texel) : result);
}
