// Pixels of snow that has a body (gpu/snow): they ask the ground below for their weather.
#ifndef PETRICHOR_SURFACE_SNOW_BODY_GLSL
#define PETRICHOR_SURFACE_SNOW_BODY_GLSL

#include "formulas/weather/snow_body.h"
#include "gpu/passes/surface/surface_bindings.glsl"
#include "gpu/passes/surface/surface_data.glsl"

float snow_deep_m(SurfaceInput at) { return (1.0 - at.weather.a) * SNOW_BODIED_M; }

// Snow of its own at a point; none on all that is not snow. over_m: as stands_over_m().
SnowBody snow_body(SurfaceInput at, float over_m)
{
    if ((SNOW & SNOW_BODY) == 0u || at.weather.a >= 0.999) return SnowBody(0.0, 0.0, 0.5, vec2(0.0));
    return snow_body_at(snow_deep_m(at), over_m, at.position.xz, frame.weather.melt_exp);
}

// The point of the ground below: there the maps, the patches and the masks of the world lie.
SurfaceInput below_snow(SurfaceInput at)
{
    SurfaceInput below = at;
    const bool snow = at.weather.a < 0.999;
    below.position.y -= snow ? max(length(at.tangent.xyz) - 1.0, 0.0) : 0.0;
    below.normal = snow ? vec3(0.0, 1.0, 0.0) : at.normal;
    return below;
}

#endif
