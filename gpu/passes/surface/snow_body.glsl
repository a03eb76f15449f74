// Pixels of snow that has a body (gpu/snow): they ask the ground below for their weather.
#ifndef PETRICHOR_SURFACE_SNOW_BODY_GLSL
#define PETRICHOR_SURFACE_SNOW_BODY_GLSL

#include "formulas/weather/ground_relief.h"
#include "formulas/weather/snow_body.h"
#include "gpu/passes/surface/surface_bindings.glsl"
#include "gpu/passes/surface/surface_data.glsl"

float snow_deep_m(SurfaceInput at) { return (1.0 - at.weather.a) * SNOW_BODIED_M; }

// Of wide ground far from all things or from the eye, where no caps are drawn any more (SnowCapOptions::reach_m): the snow of the
// weather on what is level.
float far_snow_m(SurfaceInput at, float open)
{
    const float of_things = clamp((length(at.position.xz) - 25.0) / 10.0, 0.0, 1.0);
    const float far = max(of_things, smooth_edge(33.0, 47.0, distance(at.position, frame.camera_m)));
    const float level = smooth_edge(0.85, 0.95, at.normal.y);
    return min(frame.weather.snow_depth_m * drifted_share(at.position.xz), SNOW_BODIED_M) * (open * far * level);
}

// Snow of its own at a point; none on all that is not snow. over_m: as stands_over_m(). open: share of the sky's fall.
SnowBody snow_body(SurfaceInput at, float over_m, float open)
{
    const bool wide = (BESIDES & BESIDES_WIDE_GROUND) != 0u;
    const bool caps = at.weather.a < 0.999;
    if ((SNOW & SNOW_BODY) == 0u || (!caps && !wide)) return SnowBody(0.0, 0.0, 0.5, vec2(0.0));
    float deep_m = snow_deep_m(at);
    if (wide) deep_m = max(deep_m, far_snow_m(at, open));
    return snow_body_at(deep_m, over_m, at.position.xz, frame.weather.melt_exp);
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
