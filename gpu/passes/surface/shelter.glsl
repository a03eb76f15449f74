// How much of what falls from the sky reaches a point.
#ifndef PETRICHOR_SURFACE_SHELTER_GLSL
#define PETRICHOR_SURFACE_SHELTER_GLSL

#include "formulas/weather/falls_here.h"
#include "formulas/noise/noise.h"
#include "gpu/passes/surface/textures.glsl"

struct Exposure {
    float rain;  // share of that on open flat ground
    float snow;
    float sky;  // as the snow, the less the more it looks away
};

// Splashes and eddies carry what falls a bit to the side: the edge of a shelter wanders and is soft.
// Along the surface, so that it does not shelter itself.
vec3 stray(SurfaceInput at)
{
    const float turn = 6.2831853 * dither(at.pixel, frame.sample_index + 3u);
    const vec2 wander = texel_from_above(snow_map, at, 0.7, vec2(0.0)).xy - 0.5;
    const vec2 way = (5.0 * wander + 0.7 * vec2(cos(turn), sin(turn))) * frame.shelter_spread_m;
    const vec3 level = vec3(way.x, 0.0, way.y);
    return level - at.normal * dot(at.normal, level);
}

// By the depth maps of the sky, along the few directions that rain and snow come from.
Exposure exposure_to_sky(SurfaceInput at, bool asked)
{
    Exposure open;
    open.rain = 1.0;
    open.snow = 1.0;
    open.sky = 1.0;
    if ((frame.flags & FRAME_SHELTER) == 0u) return open;
    open.rain = 0.0;
    open.snow = 0.0;
    open.sky = 0.0;
    const vec3 strayed = at.position + stray(at);
    for (uint k = 0u; k < (asked ? frame.fall_count : 0u); ++k) {
        const vec4 fall = frame.falls[k];
        const int i = int(fall.x);
        const vec4 from = frame.sky_direction[i];
        const vec3 lifted = strayed + at.normal * (from.w * 1.2) + from.xyz * (from.w * 0.8);
        const vec4 map = frame.sky_from_world[i] * vec4(lifted, 1.0);
        const bool inside = all(lessThanEqual(abs(map.xyz - 0.5), vec3(0.5)));
        const float seen =
            inside ? textureGrad(shelter_map, vec4(map.xy, fall.x, map.z), vec2(0.0), vec2(0.0)) : 1.0;
        const float facing = facing_share(at.normal, from.xyz);
        open.rain += fall.y * seen * facing;
        open.snow += fall.z * seen * snow_facing_share(facing);
        open.sky += fall.z * seen * facing;
    }
    return open;
}

#endif
