// How much of a turning disc of a depth map is lit, each texel compared with the plane of the surface there.
#ifndef PETRICHOR_SHADOW_DISC_GLSL
#define PETRICHOR_SHADOW_DISC_GLSL

#include "formulas/light/shadow_plane.h"

#define SHADOW_DISC_TEXELS 1.0
#define SHADOW_LIFT_TEXELS 1.15

// The four texels around a place `aside` texels from where the surface is. slope: of the plane, by (u, v).
float four_lit(sampler2DArray map, vec2 uv, vec2 aside, float layer, float depth, vec2 slope)
{
    const vec2 size = vec2(textureSize(map, 0).xy);
    const vec2 here = uv * size - 0.5;
    const vec2 low = floor(here + aside);
    const vec4 stored = textureGather(map, vec3((low + 1.0) / size, layer), 0).wzxy;
    const vec2 step = slope / size;
    const float first = depth + dot(step, low - here);
    return four_texels_lit(stored, first + vec4(0.0, step.x, step.y, step.x + step.y), four_texel_weights(here + aside - low));
}

// Metres along the light.
float shadow_lift_m(vec3 normal, vec3 to_light, float texel_m)
{
    return texel_m * shadow_lift_texels(dot(normal, to_light), SHADOW_LIFT_TEXELS, SHADOW_DISC_TEXELS + 1.5);
}

float disc_lit(sampler2DArray map, vec2 uv, float layer, float depth, vec2 slope, vec2 axis)
{
    const vec2 across = 0.5 * vec2(-axis.y, axis.x);
    return 0.25 * (four_lit(map, uv, axis, layer, depth, slope) + four_lit(map, uv, -axis, layer, depth, slope) +
                   four_lit(map, uv, across, layer, depth, slope) + four_lit(map, uv, -across, layer, depth, slope));
}

#endif
