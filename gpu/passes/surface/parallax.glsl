// Parallax: the surface is read where the ray of the pixel meets the relief of its height map, below
// the geometry. The depth of the picture stays that of the geometry.
#ifndef PETRICHOR_SURFACE_PARALLAX_GLSL
#define PETRICHOR_SURFACE_PARALLAX_GLSL

#include "formulas/weather/parallax.h"
#include "gpu/passes/surface/sets.glsl"

// Height to which water and snow fill the relief, 0..1: they are seen where they lie.
float filled_relief(SurfaceInput at)
{
    if (material.sheltered != 0u) return 0.0;
    float fill = 0.0;
    if (WATER != 0u) {
        // The shares are not known before the relief is met: those of the vertices.
        vec4 holds = material.water_accumulation;
        if (MIXED) {
            holds = mix(material.second_water_accumulation, holds,
                        saturate(material.mix_factor * at.weather.r));
        }
        const vec2 flood = vec2(frame.weather.flood_cracks, frame.weather.flood_puddles) * holds.yw +
                           holds.xz;
        fill = saturate(max(flood.x, flood.y - (1.0 - at.weather.g))) *
               smooth_edge(0.55, 0.9, at.normal.y);
    }
    if (SNOW != 0u) {
        const float amount = frame.weather.snow_amount * material.snow_accumulation.y +
                             material.snow_accumulation.x;
        fill = mix(fill, 1.0, saturate(amount * at.weather.b) * smooth_edge(0.0, 0.4, at.normal.y));
    }
    return fill;
}

// A map along the ray: reach is how far its coordinates move until the bottom of the relief.
struct Along {
    Uv uv;
    vec2 reach;
};

Along along(int slot, SurfaceInput at, vec2 pixels)
{
    Along a;
    a.uv = coordinates(slot, at, vec2(0.0));
    a.reach = a.uv.dx * pixels.x + a.uv.dy * pixels.y;
    return a;
}

float number_along(sampler2D map, int slot, Along a, float t)
{
    const vec2 at = a.uv.at + a.reach * t;
    if ((PARALLAX & PARALLAX_LEVEL) != 0u)
        return channel_of(textureLod(map, at, material.parallax_level), slot);
    return channel_of(textureGrad(map, at, a.uv.dx, a.uv.dy), slot);
}

// How deep the relief lies where the ray has gone a share `t` of its reach: 0 geometry .. 1 bottom. Of
// two sets each is read at its own coordinates, and they are mixed anew at every step.
float relief_depth(SurfaceInput at, Along first, Along second, Along mask, float t, float fill)
{
    float height = number_along(height_texture, TEXTURE_HEIGHT, first, t);
    if (MIXED) {
        vec2 heights = vec2(height, material.default_height);
        if (has(TEXTURE_SECOND_HEIGHT)) {
            heights.y = number_along(second_height_texture, TEXTURE_SECOND_HEIGHT, second, t);
        }
        float share = 1.0;
        if (has(TEXTURE_MIX_MASK)) {
            share = number_along(mix_mask_texture, TEXTURE_MIX_MASK, mask, t);
        }
        height = dot(shares_of(at, share, heights), heights);
    }
    return 1.0 - max(height, fill);
}

// Moves the point along the surface to what is seen of the relief.
void sink(inout SurfaceInput at)
{
    const bool level_view = (frame.flags & FRAME_ORTHOGRAPHIC) != 0u;
    const vec3 to_camera = frame.camera_m - at.position;
    const vec3 to_eye = level_view ? -frame.forward : normalize(to_camera);
    const float left_m = frame.look.detail_distance_m - length(to_camera);
    const float fade = pow(saturate(left_m / max(frame.look.detail_fade_m, 1.0e-3)), 2.0);
    const vec2 pixels = pixels_along(parallax_reach(at.normal, to_eye, material.height_scale_m * fade),
                                     at.position_dx, at.position_dy);
    const Along first_set = along(TEXTURE_HEIGHT, at, pixels);
    Along second_set = first_set;
    Along mask = first_set;
    if (MIXED) {
        second_set = along(TEXTURE_SECOND_HEIGHT, at, pixels);
        mask = along(TEXTURE_MIX_MASK, at, pixels);
    }
    const float fill = filled_relief(at);
    float t;
#define RELIEF_DEPTH(share) relief_depth(at, first_set, second_set, mask, share, fill)
#define RELIEF_SIMPLE ((PARALLAX & PARALLAX_SIMPLE) != 0u)
#define RELIEF_STEPS material.parallax_steps
#include "formulas/weather/relief_search.inc"
    const vec2 moved = pixels * saturate(t);
    at.uv += at.uv_dx * moved.x + at.uv_dy * moved.y;
    at.position += at.position_dx * moved.x + at.position_dy * moved.y;
}

#endif
