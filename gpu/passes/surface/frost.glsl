// Hoar frost on a surface point.
#ifndef PETRICHOR_SURFACE_FROST_GLSL
#define PETRICHOR_SURFACE_FROST_GLSL

#include "formulas/weather/surface_weather.h"
#include "gpu/passes/surface/sets.glsl"

// How far the point stands out: the curvature of the geometry, what the normal map adds, the top of the
// relief, and how rough the material is. mapped: tangent normal of the normal map.
float frost_edge(SurfaceInput at, vec3 mapped)
{
    const float size_m = length(at.position_dx) + length(at.position_dy);
    const float bend = length(at.normal_dx) + length(at.normal_dy);
    const float curvature = min(0.02 * bend / max(size_m, 1.0e-5), 0.6);
    float edge = curvature + 1.6 * (1.0 - mapped.z);
    if (has_relief()) edge += 0.5 * (relief_height(at) - 0.5);
    return saturate(edge + 0.25 * (material.roughness_factor - 0.5));
}

float frost_on(SurfaceInput at, vec3 mapped, float amount)
{
    const float crystals = 0.6 * texel_along(snow_map, at, 2.3).b + 0.4 * texel_along(snow_map, at, 9.1).b;
    return frost_cover(amount, saturate(0.5 + 2.6 * (crystals - 0.5)), frost_edge(at, mapped));
}

#endif
