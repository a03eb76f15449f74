// Calls every shared formula with arguments made from twelve numbers of 0..1, so that one test can
// compare what the device computes with what the CPU computes from the same text.
#ifndef PETRICHOR_FORMULAS_FORMULA_PROBE_H
#define PETRICHOR_FORMULAS_FORMULA_PROBE_H

#include "formulas/codec/half.h"
#include "formulas/codec/octahedral.h"
#include "formulas/codec/rough_normal.h"
#include "formulas/codec/shared_exponent.h"
#include "formulas/color/tone_map.h"
#include "formulas/color/white_balance.h"
#include "formulas/geometry/footprint.h"
#include "formulas/geometry/shapes.h"
#include "formulas/light/area.h"
#include "formulas/light/atmosphere.h"
#include "formulas/light/bent_normal.h"
#include "formulas/light/brdf.h"
#include "formulas/light/clear_ice.h"
#include "formulas/light/clouds.h"
#include "formulas/light/cube_map.h"
#include "formulas/light/cube_quads.h"
#include "formulas/light/exposure.h"
#include "formulas/light/fog.h"
#include "formulas/light/lamp_glow.h"
#include "formulas/light/grain.h"
#include "formulas/light/iridescence.h"
#include "formulas/light/layers.h"
#include "formulas/light/light_map.h"
#include "formulas/light/light_profile.h"
#include "formulas/light/ltc.h"
#include "formulas/light/near_light.h"
#include "formulas/light/mist.h"
#include "formulas/light/occlusion_points.h"
#include "formulas/light/other_lobes.h"
#include "formulas/light/patch_cells.h"
#include "formulas/light/rain_clouds.h"
#include "formulas/light/rain_curtains.h"
#include "formulas/light/skyline.h"
#include "formulas/light/reflection_probe.h"
#include "formulas/light/seen_lobe.h"
#include "formulas/light/second_lobe.h"
#include "formulas/light/two_lobes.h"
#include "formulas/light/shadow_plane.h"
#include "formulas/light/skin.h"
#include "formulas/light/translucent.h"
#include "formulas/light/vertex_light.h"
#include "formulas/light/water_film.h"
#include "formulas/light/weak_shadow.h"
#include "formulas/light/wet_lens.h"
#include "formulas/light/spherical_harmonics.h"
#include "formulas/weather/apply_weather.h"
#include "formulas/weather/beads.h"
#include "formulas/weather/deep_water.h"
#include "formulas/weather/depth_quads.h"
#include "formulas/weather/falling.h"
#include "formulas/weather/falls_here.h"
#include "formulas/weather/ground_relief.h"
#include "formulas/weather/ground_fields.h"
#include "formulas/weather/ground_tone.h"
#include "formulas/weather/gusts.h"
#include "formulas/weather/land_relief.h"
#include "formulas/weather/ice_pattern.h"
#include "formulas/weather/lost_slopes.h"
#include "formulas/weather/mix_sets.h"
#include "formulas/weather/parallax.h"
#include "formulas/weather/drop_births.h"
#include "formulas/weather/ring_sizes.h"
#include "formulas/weather/ripple.h"
#include "formulas/weather/snow_body.h"
#include "formulas/weather/snow_in_turf.h"
#include "formulas/weather/snow_glints.h"
#include "formulas/weather/run_off.h"
#include "formulas/weather/soaked_walls.h"
#include "formulas/weather/surface_weather.h"
#include "formulas/weather/wander.h"
#include "formulas/weather/weather_maps.h"

SHARED_BEGIN

SHARED_CONST int kProbeKinds = 88;

// A table for air_radiance.inc, about as dim as that of a clear sky.
SHARED_FN vec4 again_entry(int index)
{
    return -vec4(3.0f, 2.5f, 2.0f, 1.5f) - splat4(0.1f * float((index * 7) % 13));
}

#include "formulas/light/air_radiance.inc"

SHARED_FN float probe_light_map(vec4 a, vec4 b)
{
    const float fade = light_map_fade(100.0f * a.w, 20.0f, 40.0f);
    const vec3 sides = vec3(b.x, b.y, b.z + 0.1f);
    const vec3 toward = light_map_direction(sides);
    const vec3 near_map = directional_light_map(splat3(1.0f), sides, vec3(toward.y, toward.x, toward.z));
    const vec3 both = dual_light_map(near_map, vec3(a.x, a.y, a.z), fade);
    return both.x + both.y + both.z;
}

SHARED_FN vec3 probe_direction(float u, float v)
{
    const float y = 2.0f * u - 1.0f;
    const float level = sqrt(max(1.0f - y * y, 0.0f));
    return vec3(level * cos(6.2831853f * v), y, level * sin(6.2831853f * v));
}

SHARED_FN MarchedShape probe_shape(int kind, int iterations, float power, vec3 half_m)
{
    MarchedShape s;
    s.kind = kind;
    s.iterations = iterations;
    s.power = power;
    s.half_m = half_m;
    return s;
}

SHARED_FN WeatheredMaterial probe_matter(vec4 a, vec4 b, vec4 c)
{
    WeatheredMaterial m;
    m.albedo = vec3(a.x, a.y, a.z);
    m.specular = splat3(0.04f + 0.6f * a.w);
    m.smoothness = b.x;
    m.occlusion = b.y;
    m.emission_scale = 1.0f;
    m.normal_mix = 0.0f;
    m.metallic = c.z;
    return m;
}

SHARED_FN vec4 probe_material(WeatheredMaterial m)
{
    return vec4(m.albedo.x + m.specular.y, m.smoothness, m.occlusion + m.emission_scale,
                m.normal_mix);
}

// Three parts: a CPU's device keeps no more than 80 conditions within each other, and each that returns is one.
#include "formulas/probes/probes_from_0.inc"
#include "formulas/probes/probes_from_28.inc"
#include "formulas/probes/probes_from_56.inc"

SHARED_FN vec4 probe(int kind, vec4 a, vec4 b, vec4 c)
{
    if (kind < 28) return probes_from_0(kind, a, b, c);
    if (kind < 56) return probes_from_28(kind, a, b, c);
    return probes_from_56(kind, a, b, c);
}

SHARED_END

#endif
