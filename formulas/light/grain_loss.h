// Light that the facets of a grained surface lose to each other, and where it goes (facet_loss.h tells of round lobes).
//
// Light across a grain stays across it: facets lean along the grain alone, and what the direction has across is kept by
// mirroring. So the narrower the lobe, the more a direction loses as if it had no part across, and stood that much higher.
// What comes back goes the more along the lobe the longer that is, a little wider, by the shares lost on both ways.
//
// Fitted to sums over visible normals of GGX, roughnesses of 0.2 to 0.8 and anisotropies of 0.3 to 1: 0.006 in the mean and
// 0.037 at most beside what is lost. Shares and widths were chosen by walks from facet to facet at 0.2 to 0.6
// (FacetLoss.AlongAGrainItIsLostByDirection, FacetWalk.AlongAGrain..).
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

// Share of what comes back that goes along the lobe.
SHARED_FN float lost_along_grain(float roughness, float narrow)
{
    return mix(1.0f, lost_along_lobe(roughness), clamp((narrow - 0.25f) * (1.0f / 0.45f), 0.0f, 1.0f));
}

// The weight of a lost share in that: its root, as along round lobes, and the share itself where the lobe is narrow.
//   in_all  lost in all directions
SHARED_FN float weight_along_grain(float lost, float in_all, float narrow)
{
    return mix(lost * inversesqrt(max(in_all, 1.0e-6f)), sqrt(lost), narrow);
}

// Alphas along and across of what goes along the lobe: facets spread it.
SHARED_FN vec2 spread_along_grain(float along, float across)
{
    const float flat_share = 1.0f - across / along;
    return vec2(min(along * (1.0f + 0.2f * flat_share), 1.0f), min(across * (1.0f + 0.6f * flat_share), 1.0f));
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
    lobe.loss = found.loss;
    const float here = max(lost_at(found.loss, cosine), 1.0e-9f);
    const vec2 wide = spread_along_grain(along, across);
    lobe.loss.along *= weight_along_grain(here, lost_in_all(same), narrow) * inversesqrt(here) * (1.0f - lost_in_all(same)) /
                       (1.0f - lost_in_all(facet_roughness_of(wide.x, wide.y)));
    return lobe;
}

SHARED_END

#endif
