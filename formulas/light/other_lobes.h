// Reflectance of other programs, to compare with them: their direct light per lux of a light that the
// surface would face, cosine included, in our units (theirs over pi).
#ifndef PETRICHOR_FORMULAS_LIGHT_OTHER_LOBES_H
#define PETRICHOR_FORMULAS_LIGHT_OTHER_LOBES_H

#include "base/interop.h"
#include "formulas/light/brdf.h"
#include "formulas/light/layers.h"

SHARED_BEGIN

SHARED_FN float fifth_power(float x)
{
    const float x2 = x * x;
    return x2 * x2 * x;
}

// Cosines that all of them need.
struct LobeCosines {
    float nl;
    float nv;
    float nh;
    float lh;
};

SHARED_FN LobeCosines lobe_cosines(vec3 n, vec3 v, vec3 l)
{
    LobeCosines c;
    const float q = inversesqrt(max(2.0f + 2.0f * dot(l, v), 1.0e-8f));
    c.nl = clamp(dot(n, l), 0.0f, 1.0f);
    c.nv = clamp(abs(dot(n, v)), 1.0e-4f, 1.0f);
    c.nh = clamp((dot(n, l) + dot(n, v)) * q, 0.0f, 1.0f);
    c.lh = clamp((1.0f + dot(l, v)) * q, 0.0f, 1.0f);
    return c;
}

// Minimalist Cook-Torrance (Karlsson and Zioma 2015), of Unity's lightweight pipeline. Reciprocal, but
// smooth surfaces send out up to 1.6 times what comes in.
SHARED_FN vec3 shade_lwrp(vec3 n, vec3 v, vec3 l, vec3 diffuse, vec3 f0, float alpha)
{
    const LobeCosines c = lobe_cosines(n, v, l);
    const float d = c.nh * c.nh * (alpha * alpha - 1.0f) + 1.00001f;
    const float specular =
        alpha * alpha / (d * d * max(0.1f, c.lh * c.lh) * (4.0f * alpha + 2.0f));
    return (diffuse + f0 * specular) * (c.nl / kPi);
}

// Disney's diffuse (Burley 2012) over the standard highlight. Not energy conserving at grazing angles.
SHARED_FN float burley_diffuse(LobeCosines c, float roughness)
{
    const float rise = 2.0f * c.lh * c.lh * roughness - 0.5f;
    return (1.0f + rise * fifth_power(1.0f - c.nl)) * (1.0f + rise * fifth_power(1.0f - c.nv));
}

SHARED_FN vec3 shade_burley(vec3 n, vec3 v, vec3 l, vec3 diffuse, vec3 f0, float roughness)
{
    const LobeCosines c = lobe_cosines(n, v, l);
    const vec3 highlight = shade_direct(n, v, l, splat3(0.0f), f0, roughness * roughness);
    return highlight + diffuse * (burley_diffuse(c, roughness) * c.nl / kPi);
}

// Lux 2.02, which is Unity 5.6's standard: uncorrelated visibility, Burley's diffuse.
SHARED_FN vec3 shade_lux(vec3 n, vec3 v, vec3 l, vec3 diffuse, vec3 f0, float roughness)
{
    const LobeCosines c = lobe_cosines(n, v, l);
    const float alpha = roughness * roughness;
    const float b = c.nh * c.nh * (alpha * alpha - 1.0f) + 1.0f;
    const float distribution = alpha * alpha / (kPi * (b * b + 1.0e-7f));
    const float visibility = 0.5f / (c.nl * (c.nv * (1.0f - alpha) + alpha) +
                                     c.nv * (c.nl * (1.0f - alpha) + alpha) + 1.0e-5f);
    const float lit = f0.x == 0.0f ? 0.0f : 1.0f;
    const float specular = max(kPi * distribution * visibility * c.nl, 0.0f) * lit;
    const vec3 fresnel = f0 + (splat3(1.0f) - f0) * fifth_power(1.0f - c.lh);
    return (diffuse * (burley_diffuse(c, roughness) * c.nl) + fresnel * specular) / kPi;
}

// Scale and offset of F0 for what is mirrored of the surroundings: Lazarov 2013 as Karis changed it for
// mobile devices, and as Lux has it.
SHARED_FN vec2 lazarov_split_sum(float nv, float roughness)
{
    const float rx = 1.0f - roughness;
    const float ry = 0.0425f - 0.0275f * roughness;
    const float rz = 1.04f - 0.572f * roughness;
    const float rw = 0.022f * roughness - 0.04f;
    const float a = min(rx * rx, exp2(-9.28f * nv)) * rx + ry;
    return vec2(-1.04f * a + rz, 1.04f * a + rw);
}

// Hair: two highlights along the strands (Marschner et al. 2003), the first of their surface, the second,
// wider, through them and coloured. The scales of strands tilt one to the root, the other to the tip
// (Scheuermann 2004). Each is a long GGX lobe about a tilted normal.
//   t       along the strands, unit, in the surface
//   f0      reflectance of their surface at normal incidence; kHairReflectance of keratin
//   shift   tilt, radians
SHARED_CONST float kHairReflectance = 0.046f;

SHARED_FN vec3 shade_hair(vec3 n, vec3 t, vec3 v, vec3 l, vec3 diffuse, vec3 color, vec3 f0, float roughness,
                          float shift)
{
    const float nl = dot(n, l);
    const float nv = dot(n, v);
    if (nl <= 0.0f || nv <= 0.0f) return splat3(0.0f);
    const float lh = clamp(dot(l, half_vector(v, l)), 0.0f, 1.0f);
    const vec3 fresnel = schlick_fresnel(f0, lh);
    const float along = max(roughness * roughness, 0.01f);
    const vec3 root = normalize(n - t * shift);
    const vec3 tip = normalize(n + t * (1.5f * shift));
    // Long across the strands: the tangent of the lobe lies across them.
    const vec3 across_root = normalize(cross(root, t));
    const vec3 across_tip = normalize(cross(tip, t));
    const float first = anisotropic_lobe(root, across_root, v, l, 1.0f, along);
    const float second = anisotropic_lobe(tip, across_tip, v, l, 1.0f, min(2.0f * along, 1.0f));
    // A tilted lobe may look below the surface.
    const float low = clamp(min(min(dot(root, l), dot(root, v)), min(dot(tip, l), dot(tip, v))) * 8.0f,
                            0.0f, 1.0f);
    return (diffuse * (splat3(1.0f) - fresnel) * (1.0f / kPi) +
            (fresnel * first + color * (splat3(1.0f) - fresnel) * (0.5f * second)) * low) *
           nl;
}

SHARED_END

#endif
