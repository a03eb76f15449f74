// How much of what falls from the sky reaches a point.
#ifndef PETRICHOR_SURFACE_SHELTER_GLSL
#define PETRICHOR_SURFACE_SHELTER_GLSL

#include "formulas/noise/noise.h"
#include "gpu/passes/surface/surface_bindings.glsl"
#include "gpu/passes/surface/surface_data.glsl"

// 1 open sky .. 0 under a roof.
float exposure_to_sky(SurfaceInput at)
{
    if ((frame.flags & FRAME_SHELTER) == 0u) return 1.0;
    const float spread = frame.shelter_spread_m;
    // Off the surface by the spread, so that no tap of a wall ends up inside it.
    const vec3 lifted = at.position + vec3(at.normal.x, 0.3 * at.normal.y, at.normal.z) * spread;
    const vec4 map = frame.shelter_from_world * vec4(lifted, 1.0);
    const float inside = step(abs(map.x - 0.5), 0.5) * step(abs(map.y - 0.5), 0.5);
    // Splashes and drift soften the edge.
    const float turn = dither(at.pixel, frame.sample_index) * 6.2831853;
    const vec2 axis = vec2(cos(turn), sin(turn));
    float open = 0.0;
    for (int i = 0; i < 4; ++i) {
        const float radius = (float(i) + 0.5) * 0.25 * spread;
        const float angle = 2.3999632 * float(i);
        const vec2 d = vec2(cos(angle), sin(angle)) * radius;
        const vec2 offset = vec2(axis.x * d.x - axis.y * d.y, axis.y * d.x + axis.x * d.y);
        const vec3 p = lifted + vec3(offset.x, 0.0, offset.y);
        const vec4 tap = frame.shelter_from_world * vec4(p, 1.0);
        open += textureLod(shelter_map, tap.xyz, 0.0);
    }
    return mix(1.0, open * 0.25, inside);
}

#endif
