// What surfaces too rough for a mirror of their own see of their surroundings. Patches know how much light a place has,
// probes from where it comes: a wide lobe at a grazing angle sees the houses along a street, not the sky over it.
#ifndef PETRICHOR_LIGHTING_ROUGH_MIRROR_GLSL
#define PETRICHOR_LIGHTING_ROUGH_MIRROR_GLSL

// The share of each probe at a place, as probes_around() has it; all of them: how much probes count there.
struct ProbeShares {
    float of[LIGHTING_MOST_PROBES];
    float all;
};

ProbeShares probe_shares(vec3 position)
{
    ProbeShares s;
    s.all = 0.0;
    vec3 heaviest = vec3(0.0);
    for (uint i = 0u; i < PROBES; ++i) {
        const float share = reflection_probe_share(position, probes[i].low.xyz, probes[i].high.xyz, probes[i].low.w);
        const float weight = reflection_probe_weight(share, probes[i].centre.w, position - probes[i].centre.xyz);
        s.of[i] = weight;
        s.all = max(s.all, share);
        const float second = min(weight, heaviest.x);
        heaviest.z = max(heaviest.z, min(second, heaviest.y));
        heaviest.y = max(heaviest.y, second);
        heaviest.x = max(heaviest.x, weight);
    }
    const vec2 two = reflection_probe_blend(heaviest);
    const float scale = two.x / max(heaviest.x - 0.98 * heaviest.z, 1.0e-20);
    for (uint i = 0u; i < PROBES; ++i)
        s.of[i] = s.of[i] >= heaviest.y ? max(s.of[i] - 0.98 * heaviest.z, 0.0) * scale : 0.0;
    return s;
}

// rgb: light of surfaces in a lobe about d, a: how much sky; at alpha 1 that of a matt surface.
vec4 probed_lobe(ProbeShares s, vec3 d, float alpha)
{
    vec4 sum = vec4(0.0);
    for (int k = 0; k < kHarmonics; ++k) {
        vec4 band = vec4(0.0);
        for (uint i = 0u; i < PROBES; ++i) band += probes[i].bands[k] * s.of[i];
        sum += band * (harmonic(k, d) * ggx_band(k, alpha));
    }
    return vec4(max(sum.rgb, vec3(0.0)), clamp(sum.a, 0.0, 1.0));
}

vec3 rough_mirror(LitPoint p, Ambient around, vec3 normal, float roughness)
{
    const vec3 ray = reflect(-p.view, normal);
    const float lod = roughness * float(SKY_PREFILTER_MIPS - 1);
    const vec3 sky = textureLod(specular_map, ray, lod).rgb;
    const vec3 even = sky * around.mirrored;
    if (PROBES == 0u) return even;
    const ProbeShares shares = probe_shares(p.position);
    const vec4 lobe = probed_lobe(shares, rough_mirror_direction(normal, ray, roughness), roughness * roughness);
    const vec4 matt = probed_lobe(shares, p.normal, 1.0);
    const vec3 there = matt.rgb + sky_irradiance(p.normal) * matt.a;
    const vec3 here = clamp(around.unhidden / max(there, vec3(1.0e-6)), vec3(0.0), vec3(2.0));
    return mix(even, (lobe.rgb + sky * lobe.a) * here, shares.all);
}

#endif
