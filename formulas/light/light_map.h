// Light maps of two kinds that are no plain irradiance: dual ones, for near and far, and directional ones,
// light from three sides of the surface (McTaggart 2004, Half-Life 2 / Valve Source Shading).
#ifndef PETRICHOR_FORMULAS_LIGHT_LIGHT_MAP_H
#define PETRICHOR_FORMULAS_LIGHT_LIGHT_MAP_H

#include "base/interop.h"

SHARED_BEGIN

// 0 near, where sun and lamps shine in real time .. 1 far, where the map holds their light too.
SHARED_FN float light_map_fade(float distance_m, float full_until_m, float gone_from_m)
{
    return clamp((distance_m - full_until_m) / max(gone_from_m - full_until_m, 1.0e-4f), 0.0f, 1.0f);
}

// near_map: without what sun and lamps send straight; far_map: all of it.
SHARED_FN vec3 dual_light_map(vec3 near_map, vec3 far_map, float fade)
{
    return near_map * (1.0f - fade) + far_map * fade;
}

// One of three sides in the tangent space of the surface, 0..2: unit, square to each other, and each as
// far from its normal.
SHARED_FN vec3 light_map_side(int side)
{
    if (side == 0) return vec3(0.81649658f, 0.0f, 0.57735027f);
    if (side == 1) return vec3(-0.40824829f, 0.70710678f, 0.57735027f);
    return vec3(-0.40824829f, -0.70710678f, 0.57735027f);
}

// color: the light; scale: its shares from the three sides, 1 / sqrt(3) each where it comes evenly;
// normal: of the surface, in its tangent space.
SHARED_FN vec3 directional_light_map(vec3 color, vec3 scale, vec3 normal)
{
    const float sum = max(dot(normal, light_map_side(0)), 0.0f) * scale.x +
                      max(dot(normal, light_map_side(1)), 0.0f) * scale.y +
                      max(dot(normal, light_map_side(2)), 0.0f) * scale.z;
    return color * sum;
}

// Where most of it comes from, in tangent space, unit.
SHARED_FN vec3 light_map_direction(vec3 scale)
{
    const vec3 sum = light_map_side(0) * scale.x + light_map_side(1) * scale.y + light_map_side(2) * scale.z;
    const float size = length(sum);
    return size > 1.0e-6f ? sum / size : vec3(0.0f, 0.0f, 1.0f);
}

SHARED_END

#endif
