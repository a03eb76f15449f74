// Standing water on a surface point: where it stands, and how rain and flow bend it.
#ifndef PETRICHOR_SURFACE_WATER_GLSL
#define PETRICHOR_SURFACE_WATER_GLSL

#include "formulas/weather/ripple.h"
#include "formulas/weather/surface_weather.h"
#include "gpu/passes/surface/textures.glsl"

// (cracks, puddles): the level of the weather by the material's influence, and its constant.
vec2 flood_level(float open)
{
    return vec2(frame.weather.flood_cracks, frame.weather.flood_puddles) * open *
               material.water_accumulation.yw +
           material.water_accumulation.xz;
}

WaterCover water_on(SurfaceInput at, vec2 flood)
{
    float height = material.default_height;
    if (has(TEXTURE_HEIGHT)) {
        height = texel(height_texture, coordinates(TEXTURE_HEIGHT, at, vec2(0.0))).r;
    }
    float puddle_mask = at.weather.g;
    if (has(TEXTURE_PUDDLE_MASK)) {
        puddle_mask *= texel(puddle_mask_texture, coordinates(TEXTURE_PUDDLE_MASK, at, vec2(0.0))).r;
    }
    return water_cover(flood, height, puddle_mask, at.normal.y, material.water_slope_damp);
}

// Rings of drops. Normals of the water are laid out in world x and z.
vec3 ripple_normal(SurfaceInput at, WaterCover water, float open)
{
    const vec2 xy = texel_from_above(ripple_map, at, frame.look.ripple_tiling, vec2(0.0)).xy;
    return mix(vec3(0.0, 0.0, 1.0), unpack_normal(xy, frame.look.ripple_strength),
               water.deep * saturate(at.normal.y) * saturate(open * 2.0));
}

// Waves of water that runs down, and of wind on flat ground.
vec3 flow_normal(SurfaceInput at, TangentFrame f, WaterCover water)
{
    const vec2 down = vec2(f.tangent.y, f.bitangent.y);
    const vec2 v = down * material.flow_speed *
                   saturate(1.0 - frame.weather.freeze_exp + material.water_accumulation.z);
    const FlowPhases phases = flow_phases(frame.time_s, material.flow_interval_s);
    const float t = material.flow_tiling;
    const vec2 first = texel_from_above(flow_map, at, t, phases.first * v).xy;
    const vec2 second = texel_from_above(flow_map, at, t, phases.second * v).xy;
    const float slope = 1.0 - saturate(at.normal.y) * saturate(at.normal.y);
    // On flat ground only the wind moves the water, a little.
    const float breeze = 0.05 + 0.03 * min(length(frame.weather.wind_m_s), 6.0);
    return mix(vec3(0.0, 0.0, 1.0),
               unpack_normal(mix(first, second, phases.blend), material.flow_normal_strength),
               max(slope, breeze * saturate(at.normal.y)) * water.anywhere);
}

#endif
