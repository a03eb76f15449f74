#version 460
// Puts a layer behind those before it: its own light, and what it lets through of the rest. What is
// seen through a body is bent at its surface and blurred by its roughness: GGX's lobe around the pixel where
// the bent ray leaves it, as wide as that is at what lies there. Such a layer shows the solid picture; those
// behind the first of them in a pixel are kept in a pile of their own, which transparent_behind looks at.
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

layout(constant_id = TRANSPARENT_OVER_SPEC_KEEPS) const uint KEEPS = 0u;
layout(binding = TRANSPARENT_OVER_BENT, rgba32ui) uniform uimage2D bent_map;
layout(binding = TRANSPARENT_OVER_TINT, rgba16f) uniform writeonly image2D tint_map;
layout(binding = TRANSPARENT_OVER_BEHIND, rgba32f) uniform image2D behind_map;
layout(binding = TRANSPARENT_OVER_BEHIND_LEFT, rgba16f) uniform image2D behind_left;

#include "gpu/passes/transparent/bent_layer.glsl"
#include "gpu/passes/transparent/seen_through.glsl"

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, frame.size))) return;
    vec4 sum = FIRST != 0u ? vec4(0.0) : imageLoad(front, texel);
    const vec4 left_before = FIRST != 0u ? vec4(1.0, 1.0, 1.0, 0.0) : imageLoad(left, texel);
    vec3 rest = left_before.rgb;
    float nearest_m = left_before.a;
    float depth = texelFetch(depth_map, texel, 0).r;
    BentLayer bent = no_bent_layer();
    if (KEEPS != 0u && FIRST == 0u) bent = bent_layer(imageLoad(bent_map, texel));
    const bool behind_bent = bent.depth > 0.0;
    if (behind_bent) {
        sum = imageLoad(behind_map, texel);
        rest = imageLoad(behind_left, texel).rgb;
        nearest_m = sum.a;
        // The far side of a body is part of how it bends.
        if (depth > 0.0 && texelFetch(through_map, texel, 0).a < 0.0 &&
            material_of(texelFetch(weather_map, texel, 0), WEATHER_WHOLE) == bent.material) depth = 0.0;
    }
    bool bends_first = false;
    vec4 tint = vec4(0.0);
    const vec3 reaches = rest;  // the eye from this layer
    vec3 veil_before = vec3(0.0);
    vec3 through = vec3(0.0);
    float own_share = 0.0;
    if (depth > 0.0) {
        vec4 code = texelFetch(through_map, texel, 0);
        code.a = abs(code.a);  // negative on the far side of a body
        if (nearest_m <= 0.0) nearest_m = min(linear_depth(frame, depth), 60000.0);
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
        const float body = BODY != 0u ? texelFetch(emission_map, texel, 0).a : 1.0;
        look.w *= body;
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
                const vec3 seen = bends ? seen_along(way_through(pixel, position, view, normal, ior, look.w, roughness, layer_m),
                                                     texel, layer_m)
                                        : texelFetch(solid_map, texel, 0).rgb;
                if (!prism) behind = seen;
                else behind[view_of] = seen[view_of];
            }
            if (drop > 0.02) {
                const ivec2 there = through_drop(pixel, texel, position, view, octahedral_decode(normals.zw), normal, layer_m);
                behind = mix(behind, solid_at(there), drop);
            }
            through = rest * code.rgb * behind;
            sum.rgb += through;
            if (KEEPS != 0u && !behind_bent) {
                bends_first = true;
                bent = BentLayer(depth, normals, material, roughness, body);
                tint = vec4(rest * code.rgb, drop);
            }
            rest = vec3(0.0);
        } else {
            rest *= code.rgb;
        }
        sum.a = 1.0;
    }
    if (SPLIT != 0u && !behind_bent) {
        for (int i = 0; i < LIGHT_PARTS; ++i) {
            const ivec3 at = ivec3(texel, i);
            vec4 part = FIRST != 0u ? vec4(0.0) : imageLoad(front_parts, at);
            part.rgb += reaches * own_share * imageLoad(lit_parts, at).rgb;
            if (i == PART_VOLUME) part.rgb += reaches * veil_before;
            if (i == PART_TRANSMISSION) part.rgb += through;
            imageStore(front_parts, at, part);
        }
    }
    if (behind_bent) {
        imageStore(behind_map, texel, vec4(sum.rgb, nearest_m));
        imageStore(behind_left, texel, vec4(rest, 1.0));
        return;
    }
    imageStore(front, texel, sum);
    imageStore(left, texel, vec4(rest, nearest_m));
    if (KEEPS != 0u && (FIRST != 0u || bends_first)) {
        imageStore(bent_map, texel, bent_layer_words(bent));
        imageStore(tint_map, texel, tint);
        imageStore(behind_map, texel, vec4(0.0));
        imageStore(behind_left, texel, vec4(1.0));
    }
}
