// The light of reflection probes around a place. Wants probe_rows and probe_light, samplerBuffers.
#ifndef PETRICHOR_GPU_PASSES_REFLECTIONS_PROBES_GLSL
#define PETRICHOR_GPU_PASSES_REFLECTIONS_PROBES_GLSL
#include "formulas/codec/octahedral.h"
#include "formulas/light/reflection_probe.h"

vec4 probe_level(int probe, int level, vec3 direction)
{
    const int side = reflection_probe_side(level);
    const vec2 at = (octahedral_encode(direction) * 0.5 + 0.5) * float(side) + 0.5;
    const ivec2 low = ivec2(floor(at));
    const vec2 f = at - vec2(low);
    const int wide = side + 2;
    const int first = probe * reflection_probe_offset(kProbeLevels) + reflection_probe_offset(level) +
                      low.y * wide + low.x;
    return mix(mix(texelFetch(probe_light, first), texelFetch(probe_light, first + 1), f.x),
               mix(texelFetch(probe_light, first + wide), texelFetch(probe_light, first + wide + 1), f.x),
               f.y);
}

// rgb: what a mirror sees of surfaces; a: how much sky.
vec4 probe_toward(int probe, vec3 position, vec3 ray, float roughness)
{
    const vec3 low = texelFetch(probe_rows, probe * PROBE_ROWS + 1).xyz;
    const vec3 high = texelFetch(probe_rows, probe * PROBE_ROWS + 2).xyz;
    const vec3 direction =
        box_projected(position, ray, low, high, texelFetch(probe_rows, probe * PROBE_ROWS).xyz);
    const float level = reflection_probe_level(roughness);
    const int finer = min(int(level), kProbeLevels - 2);
    return mix(probe_level(probe, finer, direction), probe_level(probe, finer + 1, direction),
               level - float(finer));
}

struct Probed {
    vec4 light;   // as probe_toward
    float share;  // 0: no probe serves the place .. 1
    float open;   // share of sky above the probes
};

Probed probes_around(int count, vec3 position, vec3 ray, float roughness)
{
    vec3 heaviest = vec3(0.0);
    ivec2 chosen = ivec2(0);
    float covered = 0.0;
    for (int i = 0; i < count; ++i) {
        const vec4 centre = texelFetch(probe_rows, i * PROBE_ROWS);
        const vec4 low = texelFetch(probe_rows, i * PROBE_ROWS + 1);
        const vec3 high = texelFetch(probe_rows, i * PROBE_ROWS + 2).xyz;
        const float share = reflection_probe_share(position, low.xyz, high, low.w);
        const float weight = reflection_probe_weight(share, centre.w, position - centre.xyz);
        covered = max(covered, share);
        if (weight > heaviest.x) {
            heaviest = vec3(weight, heaviest.xy);
            chosen = ivec2(i, chosen.x);
        } else if (weight > heaviest.y) {
            heaviest = vec3(heaviest.x, weight, heaviest.y);
            chosen.y = i;
        } else {
            heaviest.z = max(heaviest.z, weight);
        }
    }
    Probed found = Probed(vec4(0.0, 0.0, 0.0, 1.0), covered, 1.0);
    if (covered <= 0.0) return found;
    const vec2 blend = reflection_probe_blend(heaviest);
    found.light = probe_toward(chosen.x, position, ray, roughness) * blend.x;
    found.open = texelFetch(probe_rows, chosen.x * PROBE_ROWS + 2).w * blend.x;
    if (blend.y > 0.0) {
        found.light += probe_toward(chosen.y, position, ray, roughness) * blend.y;
        found.open += texelFetch(probe_rows, chosen.y * PROBE_ROWS + 2).w * blend.y;
    }
    return found;
}

#endif
