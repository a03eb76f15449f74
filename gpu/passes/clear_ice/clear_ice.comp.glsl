#version 460
// What is seen through icicles. Pixels of ice are written, and none of them is read: the order decides nothing.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/light/clear_ice.h"
#include "formulas/light/fog.h"
#include "formulas/weather/falling.h"
#include "formulas/weather/gusts.h"
#include "gpu/frame/gbuffer.glsl"
#include "gpu/outputs/light_parts_io.h"
#include "gpu/passes/clear_ice/clear_ice_io.h"
#define PIXEL_LIST_BINDING CLEAR_ICE_PIXELS
#include "gpu/frame/pixel_list.glsl"

layout(local_size_x = REFLECTIONS_TILE, local_size_y = REFLECTIONS_TILE) in;
layout(binding = CLEAR_ICE_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = CLEAR_ICE_DEPTH_ROWS) uniform samplerBuffer depth_rows;
layout(binding = CLEAR_ICE_NORMALS) uniform samplerBuffer normal_rows;
layout(binding = CLEAR_ICE_MATERIAL) uniform samplerBuffer material_rows;
layout(binding = CLEAR_ICE_RADIANCE, rgba16f) uniform image2D radiance_map;
layout(binding = CLEAR_ICE_ACCUMULATED, rgba32f) uniform image2D accumulated;
layout(binding = CLEAR_ICE_SPECULAR) uniform samplerCube specular_map;
layout(binding = CLEAR_ICE_PROBES) uniform samplerBuffer probe_rows;
layout(binding = CLEAR_ICE_PROBE_LIGHT) uniform samplerBuffer probe_light;
layout(binding = CLEAR_ICE_PARTS, rgba32f) uniform image2DArray light_parts;
layout(binding = CLEAR_ICE_AROUND_DEPTH) uniform samplerBuffer around_depth;
layout(binding = CLEAR_ICE_AROUND_LIGHT) uniform samplerBuffer around_light;
layout(push_constant, scalar) uniform Push { ClearIcePush push; };
layout(constant_id = CLEAR_ICE_SPEC_PROBES) const uint PROBES = 0u;
layout(constant_id = CLEAR_ICE_SPEC_SPLIT) const uint SPLIT = 0u;
layout(constant_id = CLEAR_ICE_SPEC_GUSTS) const uint GUSTS = 0u;
layout(constant_id = CLEAR_ICE_SPEC_WINDOW) const uint WINDOW = 0u;
#define window push.window
const uint GLOWS = 0u;  // what glows is seen through ice as it is
#define MIRRORED_LIGHT(at) imageLoad(radiance_map, at)
#define MIRRORED_GLOW(at) vec4(0.0)
#define AROUND_GLOW(at) vec4(0.0)

#include "gpu/frame/air.glsl"
#include "gpu/passes/reflections/probes.glsl"
#include "gpu/passes/reflections/mirrored_picture.glsl"

const int kTurns = 3;    // of looking where the ray meets what was found
const int kAside = 8;    // places beside one that shows ice
const float kFar_m = 2000.0;

bool is_ice(ivec2 texel)
{
    const vec4 code = texelFetch(material_rows, row_texel(texel, frame.size));
    return uint(code.w * 255.0 + 0.5) == push.model;
}

// Pixel of a place on a ray; z: 0 behind the eye.
vec3 pixel_of(vec3 place)
{
    const vec4 clip = frame.world_to_clip * vec4(place, 1.0);
    if (clip.w <= 0.0) return vec3(-1.0e4, -1.0e4, 0.0);
    return vec3(in_picture((clip.xy / clip.w * 0.5 + 0.5) * vec2(frame.size)), 1.0);
}

// Behind the ice, and no ice itself.
bool shows_behind(ivec2 pixel, float ice_m)
{
    if (scene_depth_m(vec2(pixel) + 0.5) < ice_m) return false;
    const ivec2 at = here(pixel);
    return beyond_window(at) || !is_ice(at);
}

// The pixel of the picture where a ray behind the ice goes on; z: 0 .. 1, how far the picture knows.
vec3 met_by(vec3 position, vec3 way, float ice_m)
{
    const vec2 size = vec2(picture_size());
    const bool eye = (frame.flags & FRAME_ORTHOGRAPHIC) == 0u;
    vec2 at = vec2(0.0);
    float far_m = eye ? kFar_m : 1.0;
    for (int turn = 0; turn < kTurns; ++turn) {
        const vec3 there = pixel_of(position + way * far_m);
        if (there.z == 0.0) return vec3(0.0);
        at = there.xy;
        const float seen_m = scene_depth_m(at);
        far_m = clamp((seen_m - ice_m) / max(dot(way, frame.forward), 0.1), 0.02, kFar_m);
    }
    const vec2 beyond = max(-at, at - size) / size;
    const float known = clamp(1.0 - beyond.x / kBeyond, 0.0, 1.0) * (beyond.y > 0.0 ? 0.0 : 1.0);
    if (known <= 0.0) return vec3(0.0);
    // Other ice, or what stands before it: what is beside that is about as good.
    const vec2 here_px = pixel_of(position).xy;
    const float side = at.x >= here_px.x ? 1.0 : -1.0;
    for (int k = 0; k <= kAside; ++k) {
        const vec2 place = turned_back(at + vec2(side * float(k * k), 0.0));
        const ivec2 texel = clamp(ivec2(floor(place)), ivec2(0), picture_size() - 1);
        if (shows_behind(texel, ice_m)) return vec3(vec2(texel), known);
    }
    return vec3(0.0);
}

void main()
{
    ivec2 texel;
    if (!this_pixel(frame.size, texel)) return;
    const int row = row_texel(texel, frame.size);
    const float depth = texelFetch(depth_rows, row).r;
    const vec2 pixel = vec2(texel) + 0.5;
    const vec3 position = pixel_position(frame, pixel, depth);
    const vec3 view = pixel_view_direction(frame, pixel);
    vec3 n = octahedral_decode(texelFetch(normal_rows, row).xy);
    // Corners of few sides look away at the rim.
    const float away = max(dot(n, view), 0.0);
    n = normalize(n - view * (away + (away > 0.0 ? 0.02 : 0.0)));
    const SeenThroughIce seen = seen_through_ice(view, n);

    const vec3 sky = textureLod(specular_map, seen.way, 0.0).rgb;
    vec3 light = sky;
    if (PROBES != 0u) {
        const Probed probed = probes_around(int(PROBES), position, seen.way, 0.0);
        light = mix(light, probed.light.rgb * frame.ambient_scale + sky * probed.light.a, probed.share);
    }
    const vec3 met = met_by(position, seen.way, linear_depth(frame, depth));
    if (met.z > 0.0) light = mix(light, picture_at(ivec2(met.xy), 0.0), met.z);
    // The air before the ice; what was met has that behind it, too.
    light = min(light, vec3(60000.0)) * (seen.through * air_kept(position));

    imageStore(radiance_map, texel, imageLoad(radiance_map, texel) + vec4(light, 0.0));
    imageStore(accumulated, texel, imageLoad(accumulated, texel) + vec4(light, 0.0));
    if (SPLIT != 0u) {
        const ivec3 at = ivec3(texel, PART_TRANSMISSION);
        imageStore(light_parts, at, imageLoad(light_parts, at) + vec4(light, 0.0));
    }
}
