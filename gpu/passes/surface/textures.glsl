// Reading a material's textures: coordinates of a slot with their screen derivatives.
#ifndef PETRICHOR_SURFACE_TEXTURES_GLSL
#define PETRICHOR_SURFACE_TEXTURES_GLSL

#include "formulas/weather/surface_weather.h"
#include "gpu/passes/surface/surface_bindings.glsl"
#include "gpu/passes/surface/surface_data.glsl"
#include "gpu/passes/surface_maps/map_quads.glsl"

struct Uv {
    vec2 at;
    vec2 dx;
    vec2 dy;
};

bool has(int slot)
{
    return (SLOTS & (1u << slot)) != 0u;
}

// `shift` moves the lookup, in texture coordinates before the slot's own transform.
Uv coordinates(int slot, SurfaceInput at, vec2 shift)
{
    const TextureSlot t = material.slots[slot];
    const bool second = t.texcoord != 0u;
    const vec2 p = (second ? at.uv.zw : at.uv.xy) + shift;
    const vec2 px = second ? at.uv_dx.zw : at.uv_dx.xy;
    const vec2 py = second ? at.uv_dy.zw : at.uv_dy.xy;
    Uv result;
    result.at = vec2(dot(t.row0.xy, p) + t.row0.z, dot(t.row1.xy, p) + t.row1.z);
    result.dx = vec2(dot(t.row0.xy, px), dot(t.row1.xy, px));
    result.dy = vec2(dot(t.row0.xy, py), dot(t.row1.xy, py));
    return result;
}

vec4 texel(sampler2D map, Uv uv)
{
    return textureGrad(map, uv.at, uv.dx, uv.dy);
}

// Of a slot that holds one number: its channel.
float number_at(sampler2D map, int slot, SurfaceInput at)
{
    return dot(texel(map, coordinates(slot, at, vec2(0.0))), material.slots[slot].channel);
}

// A map of the weather, laid over the world from above. tiling: repeats per metre.
vec4 texel_from_above(sampler2D map, SurfaceInput at, float tiling, vec2 shift)
{
    return textureGrad(map, at.position.xz * tiling + shift, at.position_dx.xz * tiling,
                       at.position_dy.xz * tiling);
}

// Where such a map lies along the surface, in metres: seen from above ..
Uv metres_above(SurfaceInput at) { return Uv(at.position.xz, at.position_dx.xz, at.position_dy.xz); }

// .. or from the side that it faces.
Uv metres_beside(SurfaceInput at)
{
    const bool side = abs(at.normal.x) > abs(at.normal.z);
    return Uv(side ? at.position.zy : at.position.xy, side ? at.position_dx.zy : at.position_dx.xy,
              side ? at.position_dy.zy : at.position_dy.xy);
}

// From above on level ground, from the side on walls.
Uv metres_along(SurfaceInput at)
{
    if (abs(at.normal.y) > 0.6) return metres_above(at);
    return metres_beside(at);
}

Uv scaled(Uv uv, float tiling)
{
    return Uv(uv.at * tiling, uv.dx * tiling, uv.dy * tiling);
}

// A normal from two channels of 0..1; longer than 1 only where the strength says so.
vec3 unpack_normal(vec2 xy, float strength)
{
    const vec2 n = (xy * 2.0 - 1.0) * strength;
    return vec3(n, sqrt(1.0 - saturate(dot(n, n))));
}

#endif
