// The dry reflectance model: GGX with height-correlated Smith visibility, Schlick Fresnel, Lambert.
//
// Notation: n normal, v to the eye, l to the light, h between them; nl, nv, nh, lh clamped cosines;
// alpha = perceptual roughness squared. Sources: Walter et al. 2007, Heitz 2014, Schlick 1994.
#ifndef PETRICHOR_FORMULAS_LIGHT_BRDF_H
#define PETRICHOR_FORMULAS_LIGHT_BRDF_H

#include "base/interop.h"
#include "formulas/light/facet_loss.h"

SHARED_BEGIN

SHARED_CONST float kPi = 3.14159265f;

// Distribution of normals, 1/sr; integrates to 1 over nh.
SHARED_FN float ggx_distribution(float nh, float alpha)
{
    const float a2 = alpha * alpha;
    const float d = (nh * a2 - nh) * nh + 1.0f;
    return a2 / (kPi * d * d);
}

// Visibility = G / (4 nl nv).
SHARED_FN float ggx_visibility(float nl, float nv, float alpha)
{
    const float a2 = alpha * alpha;
    const float light = nl * sqrt(nv * nv * (1.0f - a2) + a2);
    const float view = nv * sqrt(nl * nl * (1.0f - a2) + a2);
    return 0.5f / max(light + view, 1.0e-6f);
}

SHARED_FN vec3 schlick_fresnel(vec3 f0, float lh)
{
    const float m = 1.0f - lh;
    const float m2 = m * m;
    return f0 + (splat3(1.0f) - f0) * (m2 * m2 * m);
}

// Between the directions to the eye and to the light; zero, not nothing, where they are opposite.
SHARED_FN vec3 half_vector(vec3 v, vec3 l)
{
    const vec3 sum = v + l;
    return sum * inversesqrt(max(dot(sum, sum), 1.0e-8f));
}

// What a lobe needs to know of the surface and the eye: the same for every light.
struct Lobe {
    vec3 normal;
    vec3 view;
    vec3 diffuse;  // albedo without its specular share, divided by pi
    vec3 f0;       // reflectance at normal incidence; all zero switches the highlight off
    float a2;      // alpha squared
    float nv;
    float view_term;  // of the visibility
    float lit;
    vec3 again;      // what facets send on to each other and leaves as from a matt surface (FoundAgain); none by itself
    vec3 steep;      // what a steep facet and flat ground send on
    FacetLoss loss;
};

SHARED_FN Lobe make_lobe(vec3 n, vec3 v, vec3 diffuse, vec3 f0, float alpha)
{
    Lobe lobe;
    lobe.normal = n;
    lobe.view = v;
    lobe.diffuse = diffuse * (1.0f / kPi);
    lobe.f0 = f0;
    lobe.a2 = alpha * alpha;
    lobe.nv = clamp(abs(dot(n, v)), 1.0e-4f, 1.0f);
    lobe.view_term = sqrt(lobe.nv * lobe.nv * (1.0f - lobe.a2) + lobe.a2);
    lobe.lit = f0.x + f0.y + f0.z > 0.0f ? 1.0f : 0.0f;
    lobe.again = splat3(0.0f);
    lobe.steep = splat3(0.0f);
    lobe.loss.top0 = 0.0f;
    lobe.loss.top1 = 0.0f;
    lobe.loss.below0 = 1.0f;
    lobe.loss.below1 = 0.0f;
    lobe.loss.along = 0.0f;
    return lobe;
}

// The same with the light that its facets lose to each other (formulas/light/facet_loss.h).
//   roughness  perceptual
//   along      what of it goes along the lobe: lost_along_lobe()
SHARED_FN Lobe with_all_light(Lobe lobe, float roughness, float along)
{
    const FoundAgain found = found_again(lobe.f0, roughness, lobe.nv, along);
    lobe.again = found.color * lobe.lit;
    lobe.steep = found.steep * lobe.lit;
    lobe.loss = found.loss;
    return lobe;
}

// What a lobe of one facet mirrors, and what goes along it from facet to facet.
//   lost  lost_at() of the cosine to the light
SHARED_FN vec3 mirrored_along(Lobe lobe, float lh, float lost)
{
    return schlick_fresnel(lobe.f0, lh) + lobe.again * (lobe.loss.along * sqrt(lost));
}

// What a steep facet and flat ground send on together, 1/sr, in white (facet_loss.h): the distribution of facets at their half vector times
// what is seen of both ways, the second of which begins below the first.
//   light, eye  cosines over the roots that Smith's shadows take: 1 where nothing is hidden
//   seen        the sum of each cosine times the other's root
//   beside      square of what both directions have beside the normal
SHARED_FN float steep_and_flat(float nl, float nv, float light, float eye, float seen, float beside, float a2)
{
    const float apart = (nl - nv) * (nl - nv);
    const float d = beside + apart * a2;
    const float both = nl * nv;
    return a2 * 0.25f * (1.0f + min(light, eye)) * both * (beside + apart) * (beside + apart) / max(kPi * d * d * seen * (seen - both), 1.0e-30f);
}

// Reflected radiance per unit irradiance on a facing plane, times nl.
SHARED_FN vec3 shade_lobe(Lobe lobe, vec3 l)
{
    const float toward = dot(lobe.normal, l);
    const float nl = clamp(toward, 0.0f, 1.0f);
    // The half vector is (l + v) / |l + v|. Its cosines are needed squared: s = |l + v|^2 goes to the other
    // side of the fraction, and one division is all.
    const float s = clamp(2.0f + 2.0f * dot(l, lobe.view), 1.0e-8f, 4.0f);
    const float lh = 0.5f * sqrt(s);
    const float sum = max(toward + dot(lobe.normal, lobe.view), 0.0f);
    const float d = max(s - sum * sum * (1.0f - lobe.a2), s * lobe.a2);
    const float from_light = sqrt(nl * nl * (1.0f - lobe.a2) + lobe.a2);
    const float light_term = lobe.nv * from_light;
    const float seen = nl * lobe.view_term + light_term;
    const float specular = lobe.a2 * 0.5f * lobe.lit * s * s / max(kPi * d * d * seen, 1.0e-30f);
    const float steep = steep_and_flat(nl, lobe.nv, nl / from_light, lobe.nv / lobe.view_term, seen, max(s - sum * sum, kSteepBeside), lobe.a2);
    const float lost = lost_at(lobe.loss, nl);
    return (lobe.diffuse + lobe.again * lost + lobe.steep * steep + mirrored_along(lobe, lh, lost) * specular) * nl;
}

// The same for one light alone.
//   diffuse   albedo without its specular share
SHARED_FN vec3 shade_direct(vec3 n, vec3 v, vec3 l, vec3 diffuse, vec3 f0, float alpha)
{
    return shade_lobe(make_lobe(n, v, diffuse, f0, alpha), l);
}

// Window of a punctual light over the square of its distance: 1/d^2 that reaches 0 at the range, > 0.
//   inverse_m         1/d
//   inverse_range_m2  1/range^2
SHARED_FN float square_attenuation(float d2_m2, float inverse_m, float inverse_range_m2)
{
    const float q2 = d2_m2 * inverse_range_m2;
    return clamp(1.0f - q2 * q2, 0.0f, 1.0f) * min(inverse_m * inverse_m, 1.0e4f);
}

// The same over the distance (range 0: unlimited).
SHARED_FN float light_attenuation(float distance_m, float range_m)
{
    const float d2 = distance_m * distance_m;
    const float inverse = 1.0f / max(distance_m, 1.0e-4f);
    return square_attenuation(d2, inverse, range_m > 0.0f ? 1.0f / (range_m * range_m) : 0.0f);
}

// Cone of a spot light. cosine: of the angle between its axis and the direction to the point.
SHARED_FN float spot_attenuation(float cosine, float inner_cosine, float outer_cosine)
{
    const float t =
        clamp((cosine - outer_cosine) / max(inner_cosine - outer_cosine, 1.0e-4f), 0.0f, 1.0f);
    return t * t;
}

SHARED_END

#endif
