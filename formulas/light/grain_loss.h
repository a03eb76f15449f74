// Light that the facets of a grained surface lose to each other, and where it goes (facet_loss.h tells of round lobes).
//
// Light across a grain stays across it: facets lean along the grain alone, and what the direction has across is kept by
// mirroring. So the narrower the lobe, the more a direction loses as if it had no part across, and stood that much higher.
// What comes back leaves, the less round the lobe is the more of it, along another lobe: nearly as long as can be, since two slopes along
// the grain turn light anywhere along it, and wider, since both lean across it. It goes by the shares lost on both ways.
//
// Fitted to sums over visible normals of GGX, roughnesses of 0.2 to 0.8 and anisotropies of 0.3 to 1: 0.006 in the mean and
// 0.037 at most beside what is lost. Shares and widths are fitted to walks from facet to facet of white metals, roughnesses of 0.2 to 0.8 and
// anisotropies of 0 to 1, 23520 pairs of directions (FacetLoss.AlongAGrainItIsLostByDirection, FacetWalk.AlongAGrain..).
#ifndef PETRICHOR_FORMULAS_LIGHT_GRAIN_LOSS_H
#define PETRICHOR_FORMULAS_LIGHT_GRAIN_LOSS_H

#include "base/interop.h"
#include "formulas/light/brdf.h"

SHARED_BEGIN

// Alpha along the tangent, of KHR_materials_anisotropy; across it is the square of the roughness.
SHARED_FN float alpha_along(float roughness, float anisotropy)
{
    return mix(roughness * roughness, 1.0f, anisotropy * anisotropy);
}

// Roughness of the round lobe that loses as much seen straight on, and in the mean, as one of two alphas.
SHARED_FN float facet_roughness_of(float along, float across)
{
    const float flat_share = 1.0f - across / along;
    const float first = 0.5f + flat_share * (0.06f - 0.12f * along);
    return sqrt(sqrt(first * along * along + (1.0f - first) * across * across));
}

SHARED_FN float facet_roughness(float roughness, float anisotropy)
{
    if (anisotropy <= 0.0f) return roughness;
    return facet_roughness_of(alpha_along(roughness, anisotropy), roughness * roughness);
}

// The cosine at which that lobe loses what this one does.
//   w       unit, over the surface: to the eye or to a light
//   t       unit, along the grain
//   along   alpha there
//   narrow  alpha across over alpha along, 0..1
SHARED_FN float grain_cosine(vec3 w, vec3 n, vec3 t, float along, float narrow)
{
    const float up = max(dot(n, w), 1.0e-4f);
    const float wt = dot(t, w);
    const float beside = max(1.0f - up * up - wt * wt, 0.0f);
    return up * inversesqrt(up * up + wt * wt * (1.0f + (1.0f - narrow) * (0.8f + 0.9f * along)) + beside * narrow * narrow);
}

// How much of a grain it is: 0 round .. 1. Of two alphas, the smaller one over the other.
SHARED_FN float grained(float narrow)
{
    const float t = clamp(1.5f * (1.0f - narrow), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

// Share of what comes back that goes along a lobe.
SHARED_FN float lost_along_grain(float roughness, float narrow)
{
    const float round_share = 1.0f - (1.0f - narrow) * (1.0f - narrow);
    const float r2 = round_share * round_share;
    return 1.0f - (1.0f - lost_along_lobe(roughness)) * r2 * r2;
}

// The weight of a lost share in that: its root, as along round lobes, and times the share along a grain.
//   in_all  lost in all directions
SHARED_FN float weight_along_grain(float lost, float in_all, float narrow)
{
    return sqrt(lost) * mix(1.0f, lost / max(in_all, 1.0e-6f), grained(narrow));
}

// Alphas along and across of what goes along a lobe: facets spread it.
SHARED_FN vec2 spread_along_grain(float along, float across)
{
    const float grain = grained(across / along);
    return vec2(min(mix(along, 0.67f + 0.17f * along, grain), 1.0f), min(across * (1.0f + (1.14f - 0.9f * along) * grain), 1.0f));
}

// A lobe with a grain, with the light that its facets lose to each other; without one, of a round lobe.
//   roughness  perceptual, across the grain
SHARED_FN Lobe with_light_along_grain(Lobe lobe, float roughness, vec3 tangent, float anisotropy)
{
    if (anisotropy <= 0.0f) return with_all_light(lobe, roughness, lost_along_lobe(roughness));
    const float across = roughness * roughness;
    const float along = alpha_along(roughness, anisotropy);
    const float narrow = across / along;
    const float same = facet_roughness_of(along, across);
    const float share = lost_along_grain(roughness, narrow);
    const float cosine = grain_cosine(lobe.view, lobe.normal, tangent, along, narrow);
    const FoundAgain found = found_again(lobe.f0, same, cosine, share);
    lobe.again = found.color * lobe.lit;
    lobe.steep = found.steep * lobe.lit;
    lobe.loss = found.loss;
    const float here = max(lost_at(found.loss, cosine), 1.0e-9f);
    const vec2 wide = spread_along_grain(along, across);
    lobe.loss.along *= weight_along_grain(here, lost_in_all(same), narrow) * inversesqrt(here) * (1.0f - lost_in_all(same)) /
                       (1.0f - lost_in_all(facet_roughness_of(wide.x, wide.y)));
    return lobe;
}

SHARED_END

#endif
