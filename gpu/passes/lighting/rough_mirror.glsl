// What surfaces too rough for a mirror of their own see of their surroundings. Patches know how much light a place has,
// probes from where it comes: a wide lobe at a grazing angle sees the houses along a street, not the sky over it.
#ifndef PETRICHOR_LIGHTING_ROUGH_MIRROR_GLSL
#define PETRICHOR_LIGHTING_ROUGH_MIRROR_GLSL

#include "formulas/light/seen_lobe.h"

// All of it is told out, with numbers for indices: a CPU's driver reads arrays by number at a tenth of the price.
#define EACH_PROBE(DO) DO(0u) DO(1u) DO(2u) DO(3u) DO(4u) DO(5u) DO(6u) DO(7u)

// The probes at a place, and what the place gets of their light.
struct ProbesHere {
    vec4 bands[kHarmonics];
    float share;  // how much they count
    vec3 here;    // light of the place over that of a matt surface at the probes
};

// rgb: light of surfaces in a lobe about d, a: how much sky; at alpha 1 that of a matt surface.
vec4 probed_lobe(ProbesHere s, vec3 d, float alpha)
{
    const vec4 first = s.bands[1] * harmonic(1, d) + s.bands[2] * harmonic(2, d) + s.bands[3] * harmonic(3, d);
    const vec4 second = s.bands[4] * harmonic(4, d) + s.bands[5] * harmonic(5, d) + s.bands[6] * harmonic(6, d) +
                        s.bands[7] * harmonic(7, d) + s.bands[8] * harmonic(8, d);
    const vec4 sum = s.bands[0] * harmonic(0, d) + first * ggx_band(1, alpha) + second * ggx_band(4, alpha);
    return vec4(max(sum.rgb, vec3(0.0)), clamp(sum.a, 0.0, 1.0));
}

// Two probes, and how much each counts. Of more than two, two times five loads of four words by number are cheaper for
// a CPU than 36 numbers of each, though those lie at the same address for all.
void mix_bands(inout ProbesHere s, ivec2 probe, vec2 counts)
{
    if (PROBES <= 2u) {
        const vec2 ordered = probe.x == 0 ? counts : counts.yx;
#define BAND(K)                                   \
    s.bands[K] = probes[0].bands[K] * ordered.x; \
    if (PROBES > 1u) s.bands[K] += probes[1].bands[K] * ordered.y;
        BAND(0) BAND(1) BAND(2) BAND(3) BAND(4) BAND(5) BAND(6) BAND(7) BAND(8)
#undef BAND
        return;
    }
    const ivec2 first = probe * kProbeBandTexels;
    const uvec4 last_x = texelFetch(probe_bands, first.x + kProbeBandTexels - 1);
    const uvec4 last_y = texelFetch(probe_bands, first.y + kProbeBandTexels - 1);
    const vec4 scale_x = uintBitsToFloat(last_x.zw).xxxy * counts.x;
    const vec4 scale_y = uintBitsToFloat(last_y.zw).xxxy * counts.y;
#define BAND(X, Y)                                                       \
    vec4(probe_bands_of_word(X.x), probe_bands_of_word(X.y)) * scale_x + \
        vec4(probe_bands_of_word(Y.x), probe_bands_of_word(Y.y)) * scale_y
#define TWO_BANDS(I)                                          \
    {                                                         \
        const uvec4 x = texelFetch(probe_bands, first.x + I); \
        const uvec4 y = texelFetch(probe_bands, first.y + I); \
        s.bands[2 * I] = BAND(x.xy, y.xy);                    \
        s.bands[2 * I + 1] = BAND(x.zw, y.zw);                \
    }
    TWO_BANDS(0) TWO_BANDS(1) TWO_BANDS(2) TWO_BANDS(3)
    s.bands[8] = BAND(last_x.xy, last_y.xy);
#undef TWO_BANDS
#undef BAND
}

ProbesHere probes_here(LitPoint p, Ambient around)
{
    ProbesHere s;
    s.share = 0.0;
    s.here = vec3(1.0);
    if (PROBES == 0u) return s;
    // Chosen as probes_around() does.
    vec3 heaviest = vec3(0.0);
    ivec2 chosen = ivec2(0);
#define WEIGH(I)                                                                                                     \
    if (PROBES > I) {                                                                                                \
        const float share =                                                                                          \
            reflection_probe_share(p.position, probes[I].low.xyz, probes[I].high.xyz, probes[I].low.w);              \
        const float weight = reflection_probe_weight(share, probes[I].centre.w, p.position - probes[I].centre.xyz);  \
        s.share = max(s.share, share);                                                                               \
        chosen.y = weight > heaviest.x ? chosen.x : weight > heaviest.y ? int(I) : chosen.y;                         \
        chosen.x = weight > heaviest.x ? int(I) : chosen.x;                                                          \
        const float second = min(weight, heaviest.x);                                                                \
        heaviest.z = max(heaviest.z, min(second, heaviest.y));                                                       \
        heaviest.y = max(heaviest.y, second);                                                                        \
        heaviest.x = max(heaviest.x, weight);                                                                        \
    }
    EACH_PROBE(WEIGH)
#undef WEIGH
    mix_bands(s, chosen, reflection_probe_blend(heaviest));
    const vec4 matt = probed_lobe(s, p.normal, 1.0);
    const vec3 there = matt.rgb + sky_irradiance(p.normal) * matt.a;
    s.here = clamp(around.unhidden / max(there, vec3(1.0e-6)), vec3(0.0), vec3(2.0));
    return s;
}

vec3 rough_mirror(LitPoint p, Ambient around, ProbesHere probed, vec3 normal, float roughness)
{
    const vec3 ray = reflect(-p.view, normal);
    const SeenLobe seen = seen_lobe(normal, ray, roughness);
    const vec3 sky = sky_lobe(seen.direction, seen.roughness * float(SKY_PREFILTER_MIPS - 1));
    const vec3 even = sky * around.mirrored;
    if (PROBES == 0u) return even;
    const vec4 lobe = probed_lobe(probed, rough_mirror_direction(normal, ray, roughness), roughness * roughness);
    return mix(even, (lobe.rgb + sky * lobe.a) * probed.here, probed.share);
}

#endif
