// Light that GGX's facets lose when one of them alone mirrors it, and how it comes back (Kulla and Conty 2017): what hits a
// second facet goes on as from a matt surface, by the shares that are lost on the way in and on the way out. The same
// in both directions, so the sum is reciprocal.
//
// The lost share over cosine and roughness is fitted to sums of GGX with height-correlated masking over its visible
// normals: at most 0.02 off, 0.011 from a cosine of 0.1 on; its mean over the hemisphere is at most 5 % of itself off
// (FacetLoss.* sums again).
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
};

//   roughness  perceptual, 0..1
SHARED_FN FacetLoss facet_loss(float roughness)
{
    const float r = roughness;
    const float r2 = r * r;
    FacetLoss loss;
    loss.top0 = r2 * (0.07f + r * (-0.053f + r * (1.932f - 0.032f * r)));
    loss.top1 = r2 * r2 * (-2.833f + r * (0.381f + r * (13.834f - 9.978f * r)));
    loss.below0 = r2 * r2 * exp(-1.212f + r * (8.17f + r * (-12.19f + 4.578f * r)));
    loss.below1 = r2 * (-0.73f + r * (-3.069f + r * (15.621f - 8.574f * r)));
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
    return r * r * (0.1599f + r * (-0.5533f + r * (4.4334f + r * (-5.0135f + 1.5548f * r))));
}

// What comes back of it by colour, 1/sr, for each share of lost_at() that was lost on the way in.
//   f0       reflectance at normal incidence
//   nv       cosine to the eye
SHARED_FN vec3 found_again(FacetLoss loss, vec3 f0, float roughness, float nv)
{
    const float lost = max(lost_in_all(roughness), 1.0e-6f);
    const vec3 average = f0 + (splat3(1.0f) - f0) * (1.0f / 21.0f);
    const vec3 kept = average * average * ((1.0f - lost) / (3.14159265f * lost));
    return kept * lost_at(loss, nv) / (splat3(1.0f) - average * lost);
}

SHARED_END

#endif
