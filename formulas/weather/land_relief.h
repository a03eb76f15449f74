// How the light falls on steep wide ground: on the terraces, ribs and clods that no mesh has. Without them a mountain of
// triangles ten metres wide looks moulded. What is flatter than the mesh here is what holds snow (slope_relief). In world
// space and stateless; sizes and strengths are ours, chosen by eye.
//
// One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_WEATHER_LAND_RELIEF_H
#define PETRICHOR_FORMULAS_WEATHER_LAND_RELIEF_H

#include "base/interop.h"
#include "formulas/noise/noise.h"
#include "formulas/weather/surface_weather.h"

SHARED_BEGIN

// Ground has this relief from 32 degrees on, all of it from 45 degrees on. up: y of the normal of the mesh.
SHARED_CONST float kLandReliefUp = 0.85f;
SHARED_FN float land_relief_share(float up) { return 1.0f - smooth_edge(0.70f, kLandReliefUp, up); }

// How far it turns along the slope, in deviations: ribs and gullies, which run down it. width_m: of the pixel.
SHARED_FN float land_ribs(vec3 position_m, float width_m)
{
    const float ribs = variance_lost(width_m, 3.6f), cracks = variance_lost(width_m, 1.0f);
    const vec3 p = vec3(0.6f * position_m.x - 0.8f * position_m.z, 0.4f * position_m.y, 0.8f * position_m.x + 0.6f * position_m.z);
    const float sum = 0.7f * sqrt(1.0f - ribs) * (endless_noise_3(p * (1.0f / 9.6f) + 1.7f, 281u) - 0.5f) +
                      0.6f * sqrt(1.0f - cracks) * (endless_noise_3(p * (1.0f / 2.7f) + 6.1f, 291u) - 0.5f);
    return sum / 0.16f;
}

// The relief with gullies of 12 and 31 m, which run down steep ground, catch what slides and drifts, and the ribs between them,
// which are blown bare: so snow thins into rock in parts that are seen from miles away. Their mean is 0, their deviation 0.8
// of that of the rest.
SHARED_FN SlopeRelief with_gullies(SlopeRelief relief, vec3 position_m, float width_m, float strength)
{
    const float wide = variance_lost(width_m, 12.0f), narrow = variance_lost(width_m, 4.6f);
    const vec3 p = vec3(0.8f * position_m.x + 0.6f * position_m.z, 0.3f * position_m.y + 0.1f * position_m.x,
                        0.8f * position_m.z - 0.6f * position_m.x);
    const float sum = 0.8f * sqrt(1.0f - wide) * (endless_noise_3(p * (1.0f / 31.0f) + 4.4f, 301u) - 0.5f) +
                      0.6f * sqrt(1.0f - narrow) * (endless_noise_3(p * (1.0f / 12.0f) + 8.3f, 311u) - 0.5f);
    SlopeRelief all;
    all.flatter = relief.flatter + strength * sum / 0.25f;
    all.lost = relief.lost + 0.64f * strength * strength * (0.64f * wide + 0.36f * narrow);
    return all;
}

// The normal of the ground with it; relief: as slope_relief() of the place. By 13 degrees, as far as snow is held by them.
SHARED_FN vec3 land_normal(vec3 normal, float flatter, float ribs, float strength)
{
    const vec3 rise = vec3(0.0f, 1.0f, 0.0f) - normal * normal.y;
    const float steep = length(rise);
    if (steep < 1.0e-3f) return normal;
    const vec3 up = rise * (1.0f / steep);
    const vec3 along = cross(up, normal);
    return normalize(normal + up * (0.23f * strength * flatter) + along * (0.23f * strength * ribs));
}

SHARED_END

#endif
