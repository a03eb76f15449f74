// Light that GGX's facets lose when one of them alone mirrors it, and how it comes back. What hits a second facet goes on by
// the shares that are lost on the way in and on the way out, the same in both directions, so the sum is reciprocal: as from a
// matt surface (Kulla and Conty 2017), and, the smoother the surface the more of it, along the lobe of one facet, since two small
// slopes turn light little. With both it is what a walk from facet to facet (Heitz et al. 2016) sends into a direction,
// to some per cent in the middle of all directions; the first alone is up to half of that off below a roughness of 0.5
// (FacetWalk.* walks again).
//
// The lost share over cosine and roughness is fitted to sums of GGX with height-correlated masking over its visible
// normals: from a roughness of 0.3 on at most 0.02 off, 0.014 from a cosine of 0.1 on; its mean over the hemisphere is at most 5 % of
// itself off (FacetLoss.* sums again).
//
// The smoother a surface, the more of what goes on meets one steep facet and the flat ground beside it: the facet mirrors light below the
// horizon, which the ground sends up, or the other way round. That is the lobe of one facet with one of both directions turned upside
// down, so its facets have the half vector of what is beside the normal, and of the difference of both cosines along it: no fit is in it.
// Its light is an eighth of the dark beside the sharpest highlight and a third of it at grazing angles. Up to a roughness of 0.4 it takes the place of
// the fit. That it grows by 6 alpha, and where it ends, was chosen by walks.
#ifndef PETRICHOR_FORMULAS_LIGHT_FACET_LOSS_H
#define PETRICHOR_FORMULAS_LIGHT_FACET_LOSS_H

#include "base/interop.h"

SHARED_BEGIN

// The lost share at a roughness: cosine (top0 + top1 cosine) / (below0 + below1 cosine + cosine^2).
struct FacetLoss {
    float top0;
    float top1;
    float below0;
    float below1;
    float along;  // times the root of a lost share: what goes along the lobe for what leaves as from a matt surface
};

// How much of the fit counts.
SHARED_FN float facet_loss_counts(float roughness)
{
    const float r2 = roughness * roughness;
    const float r8 = r2 * r2 * r2 * r2;
    return r8 / (r8 + 3.5e-6f);
}

//   roughness  perceptual, 0..1
SHARED_FN FacetLoss facet_loss(float roughness)
{
    const float r = roughness;
    const float r2 = r * r;
    const float top = r2 * facet_loss_counts(r);
    FacetLoss loss;
    loss.top0 = top * (0.07f + r * (-0.053f + r * (1.932f - 0.032f * r)));
    loss.top1 = top * r2 * (-2.833f + r * (0.381f + r * (13.834f - 9.978f * r)));
    loss.below0 = r2 * r2 * exp(-1.212f + r * (8.17f + r * (-12.19f + 4.578f * r)));
    loss.below1 = r2 * (-0.73f + r * (-3.069f + r * (15.621f - 8.574f * r)));
    loss.along = 0.0f;
    return loss;
}

// Share of white light at that cosine, 0..1, that one facet alone does not send on.
SHARED_FN float lost_at(FacetLoss loss, float cosine)
{
    return cosine * (loss.top0 + loss.top1 * cosine) / max(loss.below0 + (loss.below1 + cosine) * cosine, 1.0e-12f);
}

// The mean of that over the hemisphere, by cosine.
SHARED_FN float lost_in_all(float roughness)
{
    const float r = roughness;
    return r * r * facet_loss_counts(r) * (0.1599f + r * (-0.5533f + r * (4.4334f + r * (-5.0135f + 1.5548f * r))));
}

// Of what comes back, how much goes along a round lobe: after a look at walks over roughnesses of 0.2 to 0.9.
SHARED_FN float lost_along_lobe(float roughness)
{
    return 0.5f * clamp((0.8f - roughness) * (1.0f / 0.3f), 0.0f, 1.0f);
}

struct FoundAgain {
    vec3 color;      // of what leaves as from a matt surface, 1/sr, for each share of lost_at() that was lost on the way in
    vec3 steep;      // of what a steep facet and flat ground send on together
    FacetLoss loss;  // by that, and what goes along the lobe
};

// How much of what goes on is not a steep facet's and the ground's.
SHARED_FN float many_facets(float roughness)
{
    const float r2 = roughness * roughness;
    const float r8 = r2 * r2 * r2 * r2;
    return r8 / (r8 + 2.0e-4f);
}

// What of both directions is beside the normal is at least so much, squared: nearer to the mirror's direction one facet is all that counts.
SHARED_CONST float kSteepBeside = 1.0e-3f;

//   f0       reflectance at normal incidence
//   nv       cosine to the eye
//   along    lost_along_lobe()
SHARED_FN FoundAgain found_again(vec3 f0, float roughness, float nv, float along)
{
    FoundAgain found;
    found.loss = facet_loss(roughness);
    const float lost = max(lost_in_all(roughness), 1.0e-6f);
    const float here = max(lost_at(found.loss, nv), 1.0e-9f);
    const vec3 average = f0 + (splat3(1.0f) - f0) * (1.0f / 21.0f);
    const float matt = (1.0f - lost) * max(1.0f - along, 0.001f) * here / (3.14159265f * lost);
    const float many = many_facets(roughness);
    found.color = average * average * (matt * many) / (splat3(1.0f) - average * lost);
    found.steep = average * average * ((1.0f - many) * (1.0f + 6.0f * roughness * roughness));
    // Of the lobe of one facet, which then has the roots of both lost shares over what is kept in all.
    found.loss.along = along * sqrt(here) / matt;
    return found;
}

SHARED_END

#endif
