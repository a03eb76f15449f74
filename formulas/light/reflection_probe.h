// Reflection probes: what surfaces mirror of a scene that the picture does not show. A probe holds the light
// that arrives at one point, by direction; elsewhere in its box it is turned to where the ray meets the
// walls of the box (Lagarde & Zanuttini 2012).
#ifndef PETRICHOR_FORMULAS_LIGHT_REFLECTION_PROBE_H
#define PETRICHOR_FORMULAS_LIGHT_REFLECTION_PROBE_H

#include "base/interop.h"
#include "formulas/light/spherical_harmonics.h"

SHARED_BEGIN

// Levels of a probe, the first a mirror's, each other rougher by kProbeRoughness: up to where surfaces are
// too rough for a mirror of their own. Texels a side of the octahedral map of the first level. Every level
// has a border of one texel, so that neighbours need no case of their own.
SHARED_CONST int kProbeLevels = 3;
SHARED_CONST int kProbeSide = 128;
SHARED_CONST float kProbeRoughness = 0.16f;

SHARED_FN int reflection_probe_side(int level)
{
    return kProbeSide >> level;
}

// Where a level begins; of kProbeLevels: how many texels a probe has.
SHARED_FN int reflection_probe_offset(int level)
{
    int at = 0;
    for (int i = 0; i < level; ++i) {
        const int wide = reflection_probe_side(i) + 2;
        at += wide * wide;
    }
    return at;
}

// The level of a roughness: the first for the smoothest surfaces there are.
SHARED_FN float reflection_probe_level(float roughness)
{
    const float first = (roughness - 0.045f) / (kProbeRoughness - 0.045f);
    return clamp(min(first, max(roughness / kProbeRoughness, 1.0f)), 0.0f, float(kProbeLevels - 1));
}

// Of what glows and lights its surroundings: how much a surface of a roughness has as a highlight of that
// light. The rest it mirrors as it mirrors all: the first level of probes has what glows, the others do not.
SHARED_FN float glow_share(float roughness)
{
    return min(reflection_probe_level(roughness), 1.0f);
}

// 1 in the box low .. high, 0 from blend_m outside it on.
SHARED_FN float reflection_probe_share(vec3 position, vec3 low, vec3 high, float blend_m)
{
    const vec3 beyond = max(max(low - position, position - high), splat3(0.0f));
    return clamp(1.0f - length(beyond) / max(blend_m, 1.0e-3f), 0.0f, 1.0f);
}

// How much a probe counts beside others at the same place: the nearer the more. boost: 1000 to the power
// of its importance.
SHARED_FN float reflection_probe_weight(float share, float boost, vec3 way)
{
    return share * boost / (dot(way, way) + 0.25f);
}

// Of the three heaviest weights, in order: what the first two count, so that nothing jumps where the
// second and the third change places.
SHARED_FN vec2 reflection_probe_blend(vec3 heaviest)
{
    const vec2 w = vec2(heaviest.x, heaviest.y) - splat2(0.98f * heaviest.z);
    return w / max(w.x + w.y, 1.0e-20f);
}

// Distance along `ray` to the wall between low and high. Beyond a wall it counts as far ahead as it lies
// behind: rays that leave the box and rays along the wall go on without a jump.
SHARED_FN float distance_to_wall(float from, float ray, float low, float high)
{
    if (abs(ray) < 1.0e-6f) return 1.0e9f;
    return abs((ray > 0.0f ? high : low) - from) / abs(ray);
}

// Rougher surfaces than levels are for see a probe by its harmonics, not turned to the walls of its box.
struct ProbeSpread {
    vec4 centre;             // boost
    vec4 low;                // blend
    vec4 high;               // share of sky above
    vec4 bands[kHarmonics];  // rgb: radiance of surfaces, a: share of sky
};

// The bands of a probe in words of two numbers, to be read by number: four words a texel (RGBA32UI), the last with one band
// and, as floats, what 1 in a word of the light and of the sky is.
SHARED_CONST int kProbeBandTexels = (kHarmonics + 1) / 2;

// Two numbers of -1..1. The upper one is read with the lower one below it, to half of a 32767th all the same.
SHARED_FN uint probe_band_word(vec2 numbers)
{
    const uint lower = uint(int(floor(numbers.x * 32767.0f + 0.5f))) & 65535u;
    const float below = float(lower) * (1.0f / 65536.0f);
    return uint(int(floor(numbers.y * 32767.0f + 0.5f - below))) << 16u | lower;
}

SHARED_CONST float kProbeBandOne = 32767.0f * 65536.0f;

// .. times kProbeBandOne.
SHARED_FN vec2 probe_bands_of_word(uint word)
{
    return vec2(float(int(word << 16u)), float(int(word)));
}

// What a GGX lobe seen along the normal leaves of the i-th function; fitted to its integrals (0.003 of the first
// band, 0.007 of the second). At alpha 1 it is a cosine.
SHARED_FN float ggx_band(int i, float alpha)
{
    if (i == 0) return 1.0f;
    if (i < 4) {
        return (1.0f + (2.2081951f + 3.8120016f * alpha) * alpha) / (1.0f + (2.4882670f + 7.0461332f * alpha) * alpha);
    }
    return (1.0f + (1.8242479f + 0.3717228f * alpha) * alpha) / (1.0f + (2.6157152f + 9.1955338f * alpha) * alpha);
}

// Where a rough lobe has its middle: the rougher, the nearer to the normal (Lagarde and de Rousiers 2014).
SHARED_FN vec3 rough_mirror_direction(vec3 normal, vec3 mirrored, float roughness)
{
    const float smoothness = 1.0f - roughness * roughness;
    const float share = smoothness * (sqrt(max(smoothness, 0.0f)) + roughness * roughness);
    return normalize(normal + (mirrored - normal) * share);
}

// The direction from `centre` to where a ray from `position` meets the box; not unit.
SHARED_FN vec3 box_projected(vec3 position, vec3 ray, vec3 low, vec3 high, vec3 centre)
{
    const float t = min(distance_to_wall(position.x, ray.x, low.x, high.x),
                        min(distance_to_wall(position.y, ray.y, low.y, high.y),
                            distance_to_wall(position.z, ray.z, low.z, high.z)));
    return position + ray * t - centre;
}

SHARED_END

#endif
