#version 460
// What bends or blurs shows other layers behind it, too: their pile at the pixels where the bent rays end, over the solid
// picture that transparent_over has put there. A second one that bends shows the solid picture alone.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/weather/surface_weather.h"
#include "gpu/frame/gbuffer.glsl"
#include "gpu/outputs/light_parts_io.h"
#include "gpu/passes/transparent/transparent_io.h"
#include "gpu/upload/material_io.h"

layout(local_size_x = TRANSPARENT_TILE, local_size_y = TRANSPARENT_TILE) in;
layout(constant_id = TRANSPARENT_BEHIND_SPEC_SPLIT) const uint SPLIT = 0u;
layout(binding = TRANSPARENT_BEHIND_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = TRANSPARENT_BEHIND_LOOKS) uniform samplerBuffer material_looks;
layout(binding = TRANSPARENT_BEHIND_SOLID) uniform sampler2D solid_map;
layout(binding = TRANSPARENT_BEHIND_SOLID_DEPTH) uniform sampler2D solid_depth;
layout(binding = TRANSPARENT_BEHIND_FRONT) uniform sampler2D front;
layout(binding = TRANSPARENT_BEHIND_LEFT) uniform sampler2D left;
layout(binding = TRANSPARENT_BEHIND_BENT) uniform usampler2D bent_map;
layout(binding = TRANSPARENT_BEHIND_TINT) uniform sampler2D tint_map;
layout(binding = TRANSPARENT_BEHIND_BEHIND) uniform sampler2D behind_map;
layout(binding = TRANSPARENT_BEHIND_BEHIND_LEFT) uniform sampler2D behind_left;
layout(binding = TRANSPARENT_BEHIND_CHANGE, rgba32f) uniform writeonly image2D change;
layout(binding = TRANSPARENT_BEHIND_FRONT_PARTS, rgba32f) uniform image2DArray front_parts;

#include "gpu/passes/transparent/bent_layer.glsl"
#include "gpu/passes/transparent/seen_through.glsl"

// Layers at a pixel that lie behind the one that is looked through.
struct Pile {
    vec3 light;
    vec3 left;       // what they let through
    float nearest_m;  // 0: there are none
};

Pile pile_behind(ivec2 texel, uint material, float layer_m)
{
    const float about = 0.998;  // metres are kept as halves
    Pile pile = Pile(vec3(0.0), vec3(1.0), 0.0);
    const vec4 all_left = texelFetch(left, texel, 0);
    if (all_left.a <= 0.0) return pile;
    const BentLayer bent = bent_layer(texelFetch(bent_map, texel, 0));
    if (bent.depth > 0.0 && bent.material == material) {  // what is looked through is there, too
        const vec4 light = texelFetch(behind_map, texel, 0);
        if (light.a >= layer_m * about) pile = Pile(light.rgb, texelFetch(behind_left, texel, 0).rgb, light.a);
    } else if (all_left.a >= layer_m * about) {
        pile = Pile(texelFetch(front, texel, 0).rgb, all_left.rgb, all_left.a);
    }
    return pile;
}

// What the layers make of `solid`, the solid picture along the way.
vec3 changed(vec3 solid, vec3 light, vec3 kept)
{
    return light + (kept - 1.0) * solid;
}

// How far the layers of a lobe are in the mean; 0: it meets none.
float layers_m(Way way, uint material, float layer_m)
{
    const float half_way = half_way_px(way, way.behind_m, layer_m);
    float sum = 0.0;
    float count = 0.0;
    const int taps = half_way > 0.0 ? kTaps : 1;
    for (int k = 0; k < taps; k += 2) {
        const float m = pile_behind(lobe_texel(k, way.pixel, half_way, farthest_px()), material, layer_m).nearest_m;
        sum += m;
        count += m > 0.0 ? 1.0 : 0.0;
    }
    return count > 0.0 ? sum / count : 0.0;
}

vec3 change_along(Way way, ivec2 here, uint material, float layer_m)
{
    const float at_m = layers_m(way, material, layer_m);
    if (at_m <= 0.0) return vec3(0.0);
    // They are nearer than the solid picture, and less blurred.
    const float half_way = half_way_px(way, max(at_m, layer_m), layer_m);
    vec3 light = vec3(0.0);
    vec3 kept = vec3(0.0);
    float count = 0.0;
    const int taps = half_way > 0.0 ? kTaps : 1;
    for (int k = 0; k < taps; ++k) {
        const ivec2 texel = lobe_texel(k, way.pixel, half_way, farthest_px());
        if (solid_m(texel) < layer_m * 0.999) continue;
        const Pile pile = pile_behind(texel, material, layer_m);
        light += min(pile.light, vec3(60000.0));
        kept += pile.left;
        count += 1.0;
    }
    return count > 0.0 ? changed(seen_along(way, here, layer_m), light / count, kept / count) : vec3(0.0);
}

vec3 change_at(ivec2 texel, uint material, float layer_m)
{
    const Pile pile = pile_behind(texel, material, layer_m);
    return pile.nearest_m > 0.0 ? changed(solid_at(texel), pile.light, pile.left) : vec3(0.0);
}

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, frame.size))) return;
    vec3 result = vec3(0.0);
    const BentLayer bent = bent_layer(texelFetch(bent_map, texel, 0));
    if (bent.depth > 0.0) {
        const vec4 tint = texelFetch(tint_map, texel, 0);
        const vec4 look = texelFetch(material_looks, int(bent.material) * MATERIAL_LOOK_TEXELS + 1);
        const float dispersion = texelFetch(material_looks, int(bent.material) * MATERIAL_LOOK_TEXELS + 3).z;
        const float thickness_m = look.w * bent.body;
        const vec2 pixel = vec2(texel) + 0.5;
        const vec3 position = pixel_position(frame, pixel, bent.depth);
        const vec3 view = pixel_view_direction(frame, pixel);
        const vec3 normal = octahedral_decode(bent.normals.xy);
        const float layer_m = linear_depth(frame, bent.depth);
        if (look.y > 0.0 && (thickness_m > 0.0 || bent.roughness > kClear)) {
            const bool prism = thickness_m > 0.0 && dispersion > 0.0;
            const float spread = 0.025 * (look.z - 1.0) * dispersion;
            for (int view_of = 0; view_of < (prism ? 3 : 1); ++view_of) {
                const float ior = prism ? max(look.z + spread * float(view_of - 1), 1.0) : look.z;
                const vec3 more = change_along(way_through(pixel, position, view, normal, ior, thickness_m, bent.roughness, layer_m),
                                               texel, bent.material, layer_m);
                if (!prism) result = more;
                else result[view_of] = more[view_of];
            }
        } else {
            result = change_at(texel, bent.material, layer_m);
        }
        if (tint.a > 0.02) {
            const ivec2 there = through_drop(pixel, texel, position, view, octahedral_decode(bent.normals.zw), normal, layer_m);
            result = mix(result, change_at(there, bent.material, layer_m), tint.a);
        }
        result *= tint.rgb;
    }
    imageStore(change, texel, vec4(result, 0.0));
    if (SPLIT != 0u) {
        const ivec3 at = ivec3(texel, PART_TRANSMISSION);
        imageStore(front_parts, at, imageLoad(front_parts, at) + vec4(result, 0.0));
    }
}
