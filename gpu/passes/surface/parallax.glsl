// Parallax: the surface is read where the ray of the pixel meets the relief of its height map, below
// the geometry. The depth of the picture stays that of the geometry.
#ifndef PETRICHOR_SURFACE_PARALLAX_GLSL
#define PETRICHOR_SURFACE_PARALLAX_GLSL

#include "formulas/weather/parallax.h"
#include "gpu/passes/surface/textures.glsl"

// Height to which water and snow fill the relief, 0..1: they are seen where they lie.
float filled_relief(SurfaceInput at)
{
    if (material.sheltered != 0u) return 0.0;
    float fill = 0.0;
    if (WATER != 0u) {
        const vec2 flood = vec2(frame.weather.flood_cracks, frame.weather.flood_puddles) *
                               material.water_accumulation.yw + material.water_accumulation.xz;
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

// How deep the relief lies where the ray has gone a share `t` of its reach: 0 geometry .. 1 bottom.
float relief_depth(Uv uv, vec2 reach, float t, float fill)
{
    const vec4 heights = textureGrad(height_texture, uv.at + reach * t, uv.dx, uv.dy);
    return 1.0 - max(dot(heights, material.slots[TEXTURE_HEIGHT].channel), fill);
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
    const Uv uv = coordinates(TEXTURE_HEIGHT, at, vec2(0.0));
    const vec2 reach = uv.dx * pixels.x + uv.dy * pixels.y;
    const float fill = filled_relief(at);
    float t;
    if (PARALLAX == PARALLAX_SIMPLE) {
        const float first = relief_depth(uv, reach, 0.0, fill);
        t = 0.5 * (first + relief_depth(uv, reach, first, fill));
    } else {
        const float step_t = 1.0 / material.parallax_steps;
        float low = 0.0;  // the ray is above the relief there ..
        float above = relief_depth(uv, reach, 0.0, fill);
        float high = 0.0;  // .. and below it here
        float below = 0.0;
        for (float s = step_t; s < 1.0 + 0.5 * step_t; s += step_t) {
            const float gap = relief_depth(uv, reach, s, fill) - s;
            high = s;
            if (gap <= 0.0) {
                below = -gap;
                break;
            }
            low = s;
            above = gap;
        }
        t = above > 0.0 ? secant_depth(low, above, high, below) : 0.0;
        for (int i = 0; i < 3; ++i) {
            const float gap = relief_depth(uv, reach, t, fill) - t;
            if (gap > 0.0) {
                low = t;
                above = gap;
            } else {
                high = t;
                below = -gap;
            }
            t = above > 0.0 ? secant_depth(low, above, high, below) : 0.0;
        }
    }
    const vec2 moved = pixels * saturate(t);
    at.uv += at.uv_dx * moved.x + at.uv_dy * moved.y;
    at.position += at.position_dx * moved.x + at.position_dy * moved.y;
}

#endif
