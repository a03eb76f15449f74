#version 460
// Puts a layer behind those before it: its own light, and what it lets through of the rest. What is
// seen through a body is bent at its surface and blurred by its roughness: GGX's lobe around the pixel where
// the bent ray leaves it, as wide as that is at what lies there. Such a layer is the last: it shows
// the solid picture, not other layers behind it.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/light/fog.h"
#include "formulas/weather/falling.h"
#include "formulas/weather/gusts.h"
#include "formulas/weather/surface_weather.h"
#include "gpu/frame/gbuffer.glsl"
#include "gpu/outputs/light_parts_io.h"
#include "gpu/passes/transparent/transparent_io.h"
#include "gpu/upload/material_io.h"

layout(local_size_x = TRANSPARENT_TILE, local_size_y = TRANSPARENT_TILE) in;
layout(constant_id = TRANSPARENT_OVER_SPEC_FIRST) const uint FIRST = 1u;
layout(binding = TRANSPARENT_OVER_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = TRANSPARENT_OVER_DEPTH) uniform sampler2D depth_map;
layout(binding = TRANSPARENT_OVER_LIT) uniform sampler2D lit_map;
layout(binding = TRANSPARENT_OVER_THROUGH) uniform sampler2D through_map;
layout(binding = TRANSPARENT_OVER_MATERIAL) uniform sampler2D material_map;
layout(binding = TRANSPARENT_OVER_NORMALS) uniform sampler2D normals_map;
layout(constant_id = TRANSPARENT_OVER_SPEC_BODY) const uint BODY = 0u;
layout(binding = TRANSPARENT_OVER_EMISSION) uniform sampler2D emission_map;
layout(binding = TRANSPARENT_OVER_WEATHER) uniform sampler2D weather_map;
layout(binding = TRANSPARENT_OVER_LOOKS) uniform samplerBuffer material_looks;
layout(binding = TRANSPARENT_OVER_SOLID) uniform sampler2D solid_map;
layout(binding = TRANSPARENT_OVER_SOLID_DEPTH) uniform sampler2D solid_depth;
layout(binding = TRANSPARENT_OVER_SKY) uniform samplerCube sky_map;
layout(binding = TRANSPARENT_OVER_FRONT, rgba32f) uniform image2D front;
layout(binding = TRANSPARENT_OVER_LEFT, rgba16f) uniform image2D left;
layout(constant_id = TRANSPARENT_OVER_SPEC_SPLIT) const uint SPLIT = 0u;
layout(binding = TRANSPARENT_OVER_LIT_PARTS, rgba32f) uniform readonly image2DArray lit_parts;
layout(binding = TRANSPARENT_OVER_FRONT_PARTS, rgba32f) uniform image2DArray front_parts;

layout(constant_id = TRANSPARENT_OVER_SPEC_GUSTS) const uint GUSTS = 0u;
#include "gpu/frame/air.glsl"

const int kTaps = 32;
const float kGoldenAngle = 2.39996323;
const float kClear = 0.08;  // smoother surfaces blur nothing

float solid_m(ivec2 texel)
{
    const float d = texelFetch(solid_depth, texel, 0).r;
    return d > 0.0 ? linear_depth(frame, d) : 1.0e5;
}

// The mean over a lobe of GGX, without what stands before the layer. Half of its facets are steeper than alpha, a share u less steep
// than alpha times the root of u / (1 - u). Each sample of a pixel has places of its own.
//   half_way   pixels from the middle within which half of it lies;  farthest: beyond that none is looked for
vec3 solid_around(vec2 pixel, float half_way, float farthest, ivec2 here, float layer_m)
{
    vec3 sum = vec3(0.0);
    float count = 0.0;
    const float within = fract(0.5 + 0.61803399 * float(frame.sample_index));
    for (int i = 0; i < kTaps; ++i) {
        const float u = (float(i) + within) / float(kTaps);
        const float r = min(half_way * sqrt(u / (1.0 - u)), farthest);
        const float turn = kGoldenAngle * (float(i) + within - 0.5);
        const vec2 at = pixel + r * vec2(cos(turn), sin(turn));
        const ivec2 texel = clamp(ivec2(floor(at)), ivec2(0), frame.size - 1);
        const float behind = solid_m(texel) >= layer_m * 0.999 ? 1.0 : 0.0;
        sum += min(texelFetch(solid_map, texel, 0).rgb, vec3(60000.0)) * behind;
        count += behind;
    }
    return count > 0.0 ? sum / count : texelFetch(solid_map, here, 0).rgb;
}

// Where the solid picture is seen through a body: pixel of the point where the bent ray leaves it.
vec2 bent_pixel(vec2 pixel, vec3 position, vec3 view, vec3 normal, float ior, float thickness_m)
{
    const vec3 bent = refract(view, normal, 1.0 / max(ior, 1.0));
    const vec4 clip = frame.world_to_clip * vec4(position + bent * thickness_m, 1.0);
    if (clip.w <= 0.0) return pixel;
    return (clip.xy / clip.w * 0.5 + 0.5) * vec2(frame.size);
}

// The solid picture through a layer, at one index of refraction.
vec3 seen_through(vec2 pixel, ivec2 texel, vec3 position, vec3 view, vec3 normal, float ior,
                  float thickness_m, float roughness, float layer_m)
{
    vec2 at = pixel;
    if (thickness_m > 0.0) at = bent_pixel(pixel, position, view, normal, ior, thickness_m);
    const ivec2 there = clamp(ivec2(floor(at)), ivec2(0), frame.size - 1);
    // What stands before the layer is not seen through it.
    const float there_m = solid_m(there);
    if (there_m < layer_m * 0.999) at = pixel;
    const float behind_m =
        max(solid_m(clamp(ivec2(floor(at)), ivec2(0), frame.size - 1)), layer_m);
    // A lobe through a thin pane spreads about as one that is mirrored, less the less it bends. In a body a
    // facet turns the ray by 1 - 1 / ior of its own tilt.
    const float bends = thickness_m > 0.0 ? 1.0 - 1.0 / max(ior, 1.0) : 0.70710678 * clamp(2.0 * ior - 2.0, 0.0, 1.0);
    const float wide_m = roughness * roughness * bends * max(behind_m - layer_m, thickness_m);
    const float pixel_m = pixel_width_m(frame, behind_m);
    const float most = float(frame.size.y);
    const float half_way = clamp(wide_m / max(pixel_m, 1.0e-6), 0.0, 0.085 * most);
    return solid_around(at, half_way, 0.34 * most, texel, layer_m);
}

// The solid picture through a drop on a pane, which is a lens as strong as it is round: a ray is bent at the
// water and again where it leaves the flat side.
vec3 seen_through_drop(vec2 pixel, ivec2 texel, vec3 position, vec3 view, vec3 water, vec3 flat_side, float layer_m)
{
    const float kWater = 1.33;
    const vec3 inside = refract(view, water, 1.0 / kWater);
    const vec3 left_by = refract(inside, flat_side, kWater);
    const vec3 way = dot(left_by, left_by) > 0.5 ? left_by : inside;
    const vec2 size = vec2(frame.size);
    ivec2 there = texel;
    float far_m = 1000.0;
    // First as if all were far, then as far as what was met.
    for (int turn = 0; turn < 2; ++turn) {
        const vec4 clip = frame.world_to_clip * vec4(position + way * far_m, 1.0);
        vec2 at = clip.w > 0.0 ? (clip.xy / clip.w * 0.5 + 0.5) * size : pixel;
        // Beyond the picture it goes on as its mirror image does.
        at = size - abs(mod(at, 2.0 * size) - size);
        there = clamp(ivec2(floor(at)), ivec2(0), frame.size - 1);
        far_m = clamp(solid_m(there) - layer_m, 0.2, 1000.0);
    }
    return solid_m(there) < layer_m * 0.999 ? texelFetch(solid_map, texel, 0).rgb
                                            : min(texelFetch(solid_map, there, 0).rgb, vec3(60000.0));
}

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, frame.size))) return;
    vec4 sum = FIRST != 0u ? vec4(0.0) : imageLoad(front, texel);
    vec3 rest = FIRST != 0u ? vec3(1.0) : imageLoad(left, texel).rgb;
    const float depth = texelFetch(depth_map, texel, 0).r;
    const vec3 reaches = rest;  // the eye from this layer
    vec3 veil_before = vec3(0.0);
    vec3 through = vec3(0.0);
    float own_share = 0.0;
    if (depth > 0.0) {
        const vec4 code = texelFetch(through_map, texel, 0);
        vec3 light = texelFetch(lit_map, texel, 0).rgb * code.a;
        own_share = code.a;
        const vec2 pixel = vec2(texel) + 0.5;
        const vec3 position = pixel_position(frame, pixel, depth);
        const vec3 view = pixel_view_direction(frame, pixel);
        if (frame.fog_per_m > 0.0) {
            // As the lighting does it; what shines through has its fog already.
            const float kept = air_kept(position);
            const vec3 veil = textureLod(sky_map, air_level(view), kAirMip).rgb;
            veil_before = veil * (1.0 - kept) * (1.0 - min(code.rgb, vec3(1.0)));
            light = light * kept + veil_before;
            own_share *= kept;
        }
        sum.rgb += rest * light;
        const vec4 held = texelFetch(weather_map, texel, 0);
        const uint material = material_of(held, WEATHER_WHOLE);
        vec4 look = texelFetch(material_looks, int(material) * MATERIAL_LOOK_TEXELS + 1);
        if (BODY != 0u) look.w *= texelFetch(emission_map, texel, 0).a;
        const vec4 more = texelFetch(material_looks, int(material) * MATERIAL_LOOK_TEXELS + 3);
        // Without what curvature adds: a pixel of a round body is no rough one.
        const float roughness = min(
            texelFetch(material_map, texel, 0).x,
            more.x);
        const bool bends = look.y > 0.0 && (look.w > 0.0 || roughness > kClear);
        const vec4 weather = stores_of(held);
        const float drop = smooth_edge(0.08, 0.55, weather.y) * (1.0 - weather.z);
        if (bends || drop > 0.02) {
            const vec4 normals = texelFetch(normals_map, texel, 0);
            const vec3 normal = octahedral_decode(normals.xy);
            const float layer_m = linear_depth(frame, depth);
            // Colours are bent apart (KHR_materials_dispersion): three views of one channel each.
            const bool prism = look.w > 0.0 && more.z > 0.0;
            const float spread = 0.025 * (look.z - 1.0) * more.z;
            vec3 behind = vec3(0.0);
            for (int view_of = 0; view_of < (prism ? 3 : 1); ++view_of) {
                const float ior = prism ? max(look.z + spread * float(view_of - 1), 1.0) : look.z;
                const vec3 seen = bends ? seen_through(pixel, texel, position, view, normal, ior, look.w,
                                                       roughness, layer_m)
                                        : texelFetch(solid_map, texel, 0).rgb;
                if (!prism) behind = seen;
                else behind[view_of] = seen[view_of];
            }
            if (drop > 0.02) {
                const vec3 bent = seen_through_drop(pixel, texel, position, view, octahedral_decode(normals.zw),
                                                    normal, layer_m);
                behind = mix(behind, bent, drop);
            }
            through = rest * code.rgb * behind;
            sum.rgb += through;
            rest = vec3(0.0);
        } else {
            rest *= code.rgb;
        }
        sum.a = 1.0;
    }
    if (SPLIT != 0u) {
        for (int i = 0; i < LIGHT_PARTS; ++i) {
            const ivec3 at = ivec3(texel, i);
            vec4 part = FIRST != 0u ? vec4(0.0) : imageLoad(front_parts, at);
            part.rgb += reaches * own_share * imageLoad(lit_parts, at).rgb;
            if (i == PART_VOLUME) part.rgb += reaches * veil_before;
            if (i == PART_TRANSMISSION) part.rgb += through;
            imageStore(front_parts, at, part);
        }
    }
    imageStore(front, texel, sum);
    imageStore(left, texel, vec4(rest, 1.0));
}
