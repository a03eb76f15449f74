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

Uv across(Uv uv)
{
    return Uv(place_across(uv.at), place_across(uv.dx), place_across(uv.dy));
}

// Noise of the crystals, 0..1 around 0.5: one of half a metre, one of a hand. Of wide ground the wider by two readings
// and the finer turned against both, as large in the mean as elsewhere: else hoar showed the lattice of the map.
float frost_crystals(SurfaceInput at)
{
    const Uv place = metres_along(at);
    float crystals;
    if ((BESIDES & BESIDES_WIDE_GROUND) == 0u) {
        crystals = 0.6 * texel(snow_map, scaled(place, 2.3)).b + 0.4 * texel(snow_map, scaled(place, 9.1)).b;
    } else {
        const Uv wide = scaled(place, 3.07);
        const float mean = textureLod(snow_map, wide.at, 16.0).b;
        crystals = 0.6 * mask_of_two(texel(snow_map, wide).b, texel(snow_map, across(wide)).b, mean) +
                   0.4 * texel(snow_map, across(across(scaled(place, 29.0)))).b;  // 9.1 after both turns
    }
    return saturate(0.5 + 2.6 * (crystals - 0.5));
}

float frost_on(SurfaceInput at, vec3 mapped, float amount)
{
    return frost_cover(amount, frost_crystals(at), frost_edge(at, mapped));
}

#endif
