// How much of what falls from the sky reaches a point.
#ifndef PETRICHOR_SURFACE_SHELTER_GLSL
#define PETRICHOR_SURFACE_SHELTER_GLSL

#include "formulas/weather/falls_here.h"
#include "gpu/passes/surface/surface_bindings.glsl"
#include "gpu/passes/surface/surface_data.glsl"

struct Exposure {
    float rain;  // share of that on open flat ground
    float snow;
};

// By the depth maps of the sky, along the few directions that rain and snow come from.
Exposure exposure_to_sky(SurfaceInput at)
{
    Exposure open;
    open.rain = 1.0;
    open.snow = 1.0;
    if ((frame.flags & FRAME_SHELTER) == 0u) return open;
    open.rain = 0.0;
    open.snow = 0.0;
    for (uint k = 0u; k < frame.fall_count; ++k) {
        const vec4 fall = frame.falls[k];
        const int i = int(fall.x);
        const vec4 from = frame.sky_direction[i];
        const vec3 lifted = at.position + at.normal * (from.w * 1.2) + from.xyz * (from.w * 0.8);
        const vec4 map = frame.sky_from_world[i] * vec4(lifted, 1.0);
        const bool inside = all(lessThanEqual(abs(map.xyz - 0.5), vec3(0.5)));
        const float seen =
            inside ? textureGrad(shelter_map, vec4(map.xy, fall.x, map.z), vec2(0.0), vec2(0.0)) : 1.0;
        const float facing = facing_share(at.normal, from.xyz);
        open.rain += fall.y * seen * facing;
        open.snow += fall.z * seen * snow_facing_share(facing);
    }
    return open;
}

#endif
