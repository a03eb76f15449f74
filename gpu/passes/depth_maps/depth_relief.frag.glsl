#version 460
// As depth_masked, for holes in a relief: they lie where the ray of the light meets it, as the eye sees them where
// its own ray does. Of two sets of textures the first has the relief.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/weather/parallax.h"
#include "gpu/passes/depth_maps/depth_holes.glsl"
#include "gpu/passes/depth_maps/depth_maps_io.h"
#include "gpu/upload/parallax_ends_io.h"

layout(constant_id = DEPTH_SPEC_PARALLAX) const uint PARALLAX = PARALLAX_SIMPLE;

layout(set = 0, binding = 2) uniform sampler2D height_map;

layout(location = 0) in vec4 in_uv;
layout(location = 1) in vec3 in_world;
layout(location = 2) flat in vec4 in_eye;

struct Ray {
    vec2 at;
    vec2 dx;
    vec2 dy;
    vec2 reach;
};

float depth_along(Ray ray, float t)
{
    return 1.0 - dot(textureGrad(height_map, ray.at + ray.reach * t, ray.dx, ray.dy),
                     material.slots[TEXTURE_HEIGHT].channel);
}

void main()
{
    const vec4 dx = dFdx(in_uv), dy = dFdy(in_uv);
    const vec3 world_dx = dFdx(in_world), world_dy = dFdy(in_world);
    const vec3 to_light = normalize(in_eye.w != 0.0 ? in_eye.xyz - in_world : in_eye.xyz);
    vec3 n = cross(world_dx, world_dy);
    const float size = length(n);
    vec4 uv = in_uv;
    if (size > 0.0) {
        n *= dot(n, to_light) < 0.0 ? -1.0 / size : 1.0 / size;
        const vec2 texels =
            pixels_along(parallax_reach(n, to_light, material.height_scale_m), world_dx, world_dy);
        const vec4 way = dx * texels.x + dy * texels.y;
        Ray ray;
        ray.at = slot_uv(TEXTURE_HEIGHT, in_uv);
        ray.dx = slot_uv(TEXTURE_HEIGHT, in_uv + dx) - ray.at;
        ray.dy = slot_uv(TEXTURE_HEIGHT, in_uv + dy) - ray.at;
        ray.reach = slot_uv(TEXTURE_HEIGHT, in_uv + way) - ray.at;
        float t;
#define RELIEF_DEPTH(share) depth_along(ray, share)
#define RELIEF_SIMPLE ((PARALLAX & PARALLAX_SIMPLE) != 0u)
#define RELIEF_STEPS material.parallax_steps
#include "formulas/weather/relief_search.inc"
        uv += way * clamp(t, 0.0, 1.0);
        if (beyond_relief(PARALLAX, slot_uv(TEXTURE_HEIGHT, uv))) discard;
    }
    const vec2 at = slot_uv(TEXTURE_BASE_COLOR, uv);
    const float alpha = textureGrad(base_color_map, at, slot_uv(TEXTURE_BASE_COLOR, uv + dx) - at,
                                    slot_uv(TEXTURE_BASE_COLOR, uv + dy) - at)
                            .a;
    if (hole_of(alpha, ivec2(gl_FragCoord.xy))) discard;
}
