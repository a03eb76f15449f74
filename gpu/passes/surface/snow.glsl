// Snow on a surface point: where it lies, and its relief.
#ifndef PETRICHOR_SURFACE_SNOW_GLSL
#define PETRICHOR_SURFACE_SNOW_GLSL

#include "formulas/weather/surface_weather.h"
#include "gpu/passes/surface/textures.glsl"

// Before it is saturated: the amount that falls here, and what the material always has.
float snow_amount_raw(SurfaceInput at, float lies)
{
    // What falls does not cling to walls, whatever the slope damp of the material.
    const float clinging = smooth_edge(0.0, 0.4, at.normal.y);
    return lies * clinging * material.snow_accumulation.y +
           material.snow_accumulation.x;
}

// smoothed_up: y of the pixel normal, smoothed by the snow's amount.
SnowCover snow_on(SurfaceInput at, float amount, float smoothed_up)
{
    float unique = at.weather.b;
    if (has(TEXTURE_SNOW_MASK)) {
        unique *= number_at(snow_mask_texture, TEXTURE_SNOW_MASK, at);
    }
    const float mask = texel_from_above(snow_map, at, frame.look.snow_tiling.z, vec2(0.0)).b;
    const float detail = texel_from_above(snow_map, at, frame.look.snow_tiling.w, vec2(0.0)).b;
    return snow_cover(amount,
                      snow_height_factor(at.position.y, frame.weather.snow_start_height_m,
                                         frame.weather.snow_height_blend_m),
                      smoothed_up, material.snow_slope_damp, unique, mask, detail,
                      frame.weather.melt * material.snow_accumulation.y);
}

struct SnowRelief {
    vec3 normal;       // world
    float smoothness;
};

// A snow cover has its own, softer relief over that of the ground. smoothed: world.
SnowRelief snow_relief(SurfaceInput at, float amount, vec3 smoothed, float fade)
{
    const vec4 snow = texel_from_above(snow_map, at, frame.look.snow_tiling.x, vec2(0.0));
    const vec2 detail_xy = texel_from_above(snow_map, at, frame.look.snow_tiling.y, vec2(0.0)).xy;
    const vec3 coarse =
        unpack_normal(snow.xy, material.snow_normal_strength * frame.look.snow_strength.x);
    const vec3 detail = unpack_normal(
        detail_xy, material.snow_detail_strength * frame.look.snow_strength.y * fade);
    SnowRelief relief;
    relief.normal = normalize(vec3(coarse.x + detail.x, 0.0, coarse.y + detail.y) +
                              mix(smoothed, at.normal, 0.3 + 0.7 * amount) * (coarse.z * detail.z));
    relief.smoothness = snow.a;
    return relief;
}

#endif
