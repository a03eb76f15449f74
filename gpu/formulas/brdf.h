// The dry reflectance model: GGX with height-correlated Smith visibility, Schlick Fresnel, Lambert.
//
// Notation: n normal, v to the eye, l to the light, h between them; nl, nv, nh, lh clamped cosines;
// alpha = perceptual roughness squared. Sources: Walter et al. 2007, Heitz 2014, Schlick 1994.
#ifndef PETRICHOR_BRDF_H
#define PETRICHOR_BRDF_H

#include "base/interop.h"

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
    return f0 + (vec3(1.0f) - f0) * (m2 * m2 * m);
}

// Reflected radiance per unit irradiance on a facing plane, times nl.
//   diffuse   albedo without its specular share
//   f0        reflectance at normal incidence; all zero switches the highlight off
SHARED_FN vec3 shade_direct(vec3 n, vec3 v, vec3 l, vec3 diffuse, vec3 f0, float alpha)
{
    const float nl = clamp(dot(n, l), 0.0f, 1.0f);
    const float nv = clamp(abs(dot(n, v)), 1.0e-4f, 1.0f);
    const vec3 sum = l + v;
    const vec3 h = sum * inversesqrt(max(dot(sum, sum), 1.0e-8f));
    const float nh = clamp(dot(n, h), 0.0f, 1.0f);
    const float lh = clamp(dot(l, h), 0.0f, 1.0f);
    const float lobe = ggx_distribution(nh, alpha) * ggx_visibility(nl, nv, alpha);
    const vec3 fresnel = schlick_fresnel(f0, lh);
    const float lit = f0.x + f0.y + f0.z > 0.0f ? 1.0f : 0.0f;
    return (diffuse * (1.0f / kPi) + fresnel * (lobe * lit)) * nl;
}

// Window of a punctual light: 1/d^2 that reaches 0 at the range (range 0: unlimited).
SHARED_FN float light_attenuation(float distance_m, float range_m)
{
    const float d2 = max(distance_m * distance_m, 1.0e-4f);
    if (range_m <= 0.0f) return 1.0f / d2;
    const float q = distance_m / range_m;
    const float q2 = q * q;
    return clamp(1.0f - q2 * q2, 0.0f, 1.0f) / d2;
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
