// Lobes beside plain GGX: a clear coat, a sheen of fibres, highlights that are longer than wide, and
// light that a thin sheet lets through.
//
// Coat and sheen as in KHR_materials_clearcoat and KHR_materials_sheen, layered without gain; the distribution of
// fibres is Estevez and Kulla 2017, its visibility Neubelt and Pettineo 2013; anisotropic GGX is Burley
// 2012 with the correlated visibility of Heitz 2014, roughness as KHR_materials_anisotropy has it.
#ifndef PETRICHOR_FORMULAS_LIGHT_LAYERS_H
#define PETRICHOR_FORMULAS_LIGHT_LAYERS_H

#include "base/interop.h"
#include "formulas/light/brdf.h"
#include "formulas/light/grain_loss.h"

SHARED_BEGIN

// What lies over and in a surface besides its base.
struct Layers {
    float coat;             // weight of the clear coat, 0..1
    float coat_roughness;   // perceptual
    vec3 sheen;             // colour of the fibres
    float sheen_roughness;  // perceptual
    float anisotropy;       // 0 round .. 1
    vec3 tangent;           // along which highlights are long; unit, in the surface
    float transmitted;      // share of the diffuse light that comes out on the other side
    vec3 through;           // its colour, without the share that is mirrored
    vec3 other_normal;      // unit: of the coat; of skin's diffuse light
    float coat_spared;      // of the coat's highlight, what a light has not, 0..1: fills shadows and shows none
};

// Smoother fibres than this are a needle that no smooth law could follow.
SHARED_CONST float kSheenRoughnessLeast = 0.15f;

// Directional albedo of the sheen: the exponential of a polynomial in the square root of the cosine and
// the inverse of the roughness, fitted to sums of sheen_lobe over the hemisphere (where it is below 1 the error is
// at most 0.012 from a roughness of 0.17 on and 0.043 at the least; the test sums again).
SHARED_FN float sheen_albedo(float n_dot, float roughness)
{
    const float x = sqrt(clamp(n_dot, 0.0f, 1.0f));
    const float s = 1.0f / clamp(roughness, kSheenRoughnessLeast, 1.0f);
    const float c0 = -0.88132f + s * (0.46372f - 0.02799f * s);
    const float c1 = -0.31418f + s * (0.04641f - 0.02089f * s);
    const float c2 = 0.02266f + s * (-2.52825f + 0.15833f * s);
    const float c3 = -0.87420f + s * (4.13162f - 0.34763f * s);
    const float c4 = 1.12892f + s * (-3.00703f + 0.10519f * s);
    return exp(c0 + x * (c1 + x * (c2 + x * (c3 + x * c4))));
}

// 1/sr for white fibres; at grazing angles of smooth cloth this law alone sends out more than comes in.
SHARED_FN float sheen_lobe(float nl, float nv, float nh, float roughness)
{
    const float rough = max(roughness, kSheenRoughnessLeast);
    const float alpha = rough * rough;
    const float sine = sqrt(max(1.0f - nh * nh, 0.0f));
    const float d = (2.0f + 1.0f / alpha) * pow(max(sine, 1.0e-5f), 1.0f / alpha) / (2.0f * kPi);
    return d / max(4.0f * (nl + nv - nl * nv), 1.0e-4f);
}

// The same, held to what comes in: divided by its albedo where that is over one. Reciprocal.
SHARED_FN float sheen_kept(float nl, float nv, float nh, float roughness)
{
    const float most = max(sheen_albedo(nl, roughness), sheen_albedo(nv, roughness));
    return sheen_lobe(nl, nv, nh, roughness) / max(most, 1.0f);
}

// What the sheen leaves of the light for what lies below, on the way in and out.
SHARED_FN float below_sheen(vec3 sheen, float nl, float nv, float roughness)
{
    const float strength = max(sheen.x, max(sheen.y, sheen.z));
    const float most = max(sheen_albedo(nl, roughness), sheen_albedo(nv, roughness));
    return 1.0f - strength * min(most, 1.0f);
}

// Distribution times visibility of anisotropic GGX, 1/sr; alpha_t along the tangent t, alpha_b across.
SHARED_FN float anisotropic_lobe(vec3 n, vec3 t, vec3 v, vec3 l, float alpha_t, float alpha_b)
{
    const vec3 b = cross(n, t);
    const vec3 h = half_vector(v, l);
    const float nl = max(dot(n, l), 1.0e-4f);
    const float nv = max(dot(n, v), 1.0e-4f);
    const float ht = dot(h, t) / alpha_t;
    const float hb = dot(h, b) / alpha_b;
    const float nh = dot(n, h);
    const float q = max(ht * ht + hb * hb + nh * nh, 1.0e-6f);
    const float d = 1.0f / (kPi * alpha_t * alpha_b * q * q);
    const float from_l = length(vec3(alpha_t * dot(l, t), alpha_b * dot(l, b), nl));
    const float from_v = length(vec3(alpha_t * dot(v, t), alpha_b * dot(v, b), nv));
    return d * 0.5f / (nl * from_v + nv * from_l);
}

// What a steep facet of such a surface and flat ground send on together, 1/sr (facet_loss.h), in white.
SHARED_FN float anisotropic_steep(vec3 n, vec3 t, vec3 v, vec3 l, float alpha_t, float alpha_b)
{
    const vec3 b = cross(n, t);
    const float nl = max(dot(n, l), 1.0e-4f);
    const float nv = max(dot(n, v), 1.0e-4f);
    const float pt = dot(v, t) + dot(l, t);
    const float pb = dot(v, b) + dot(l, b);
    const float beside = max(pt * pt + pb * pb, kSteepBeside);
    const float from_l = length(vec3(alpha_t * dot(l, t), alpha_b * dot(l, b), nl));
    const float from_v = length(vec3(alpha_t * dot(v, t), alpha_b * dot(v, b), nv));
    // As of a round lobe whose facets lean as much that way.
    const float lean2 = beside / max(pt * pt / (alpha_t * alpha_t) + pb * pb / (alpha_b * alpha_b), 1.0e-6f);
    const float a2 = clamp(lean2, alpha_b * alpha_b, alpha_t * alpha_t);
    return steep_and_flat(nl, nv, nl / from_l, nv / from_v, nl * from_v + nv * from_l, beside, a2) * (a2 / (alpha_t * alpha_b));
}

SHARED_FN float coat_fresnel(float cosine)
{
    const float m = 1.0f - clamp(cosine, 0.0f, 1.0f);
    const float m2 = m * m;
    return 0.04f + 0.96f * m2 * m2 * m;
}

// A base with layers over it, from the answer of the base alone: that of shade_lobe(), or of two lobes
// (two_lobes.h). Arguments as of shade_layered_lobe().
SHARED_FN vec3 shade_layers_over(vec3 base, Lobe lobe, vec3 l, float roughness, Layers layers)
{
    const vec3 n = lobe.normal;
    const vec3 v = lobe.view;
    const float facing = dot(n, l);
    if (layers.anisotropy > 0.0f) {
        const float across = roughness * roughness;
        const float along = alpha_along(roughness, layers.anisotropy);
        const float narrow = across / along;
        const float lh = clamp(dot(l, half_vector(v, l)), 0.0f, 1.0f);
        const float nl = max(facing, 0.0f);
        const float lost = lost_at(lobe.loss, grain_cosine(l, n, layers.tangent, along, narrow));
        const vec2 wide = spread_along_grain(along, across);
        const float sent_on = lobe.loss.along * weight_along_grain(lost, lost_in_all(facet_roughness_of(along, across)), narrow) *
                              anisotropic_lobe(n, layers.tangent, v, l, wide.x, wide.y) * lobe.lit;
        base = (lobe.diffuse + lobe.again * (lost + sent_on) +
                lobe.steep * anisotropic_steep(n, layers.tangent, v, l, along, across) +
                schlick_fresnel(lobe.f0, lh) * (anisotropic_lobe(n, layers.tangent, v, l, along, across) * lobe.lit)) * nl;
    }
    if (layers.sheen.x + layers.sheen.y + layers.sheen.z > 0.0f) {
        const float nl = max(facing, 0.0f);
        const float nh = clamp(dot(n, half_vector(v, l)), 0.0f, 1.0f);
        base = base * below_sheen(layers.sheen, nl, lobe.nv, layers.sheen_roughness) +
               layers.sheen * (sheen_kept(nl, lobe.nv, nh, layers.sheen_roughness) * nl);
    }
    if (layers.coat > 0.0f) {
        const float nl = max(dot(layers.other_normal, l), 0.0f);
        const float nv = clamp(abs(dot(layers.other_normal, v)), 1.0e-4f, 1.0f);
        const vec3 h = half_vector(v, l);
        const float coat_alpha = max(layers.coat_roughness * layers.coat_roughness, 0.002f);
        const float coat_here = ggx_distribution(clamp(dot(layers.other_normal, h), 0.0f, 1.0f), coat_alpha) *
                                ggx_visibility(nl, nv, coat_alpha);
        // The extension leaves the base what the coat does not mirror to the eye, once. The same of the
        // light where that grazes more: so both ways are alike, and no more is sent out than comes in.
        const float below = 1.0f - layers.coat * max(coat_fresnel(nl), coat_fresnel(nv));
        const float mirrored =
            layers.coat * (1.0f - layers.coat_spared) * coat_fresnel(clamp(dot(l, h), 0.0f, 1.0f)) * coat_here * nl;
        base = base * below + splat3(mirrored);
    }
    return base + layers.through * (layers.transmitted / kPi * max(-facing, 0.0f));
}

// Reflected radiance per unit irradiance on a facing plane, times the cosine, of a base with layers; light
// from behind comes through. Of a lobe whose diffuse part lacks what is transmitted.
//   roughness   of the base, perceptual
SHARED_FN vec3 shade_layered_lobe(Lobe lobe, vec3 l, float roughness, Layers layers)
{
    return shade_layers_over(shade_lobe(lobe, l), lobe, l, roughness, layers);
}

// The same for one light alone.
//   diffuse   albedo without its specular share, before it is shared between the sides
SHARED_FN vec3 shade_layers(vec3 n, vec3 v, vec3 l, vec3 diffuse, vec3 f0, float roughness, Layers layers)
{
    const Lobe lobe =
        make_lobe(n, v, diffuse * (1.0f - layers.transmitted), f0, roughness * roughness);
    return shade_layered_lobe(lobe, l, roughness, layers);
}

// A direction within the surface for an angle of 0..pi, and back: the frame of Duff et al. 2017 about
// the normal.
SHARED_FN vec3 frame_tangent(vec3 n)
{
    const float s = n.z >= 0.0f ? 1.0f : -1.0f;
    const float a = -1.0f / (s + n.z);
    return vec3(1.0f + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x);
}

SHARED_FN vec3 tangent_at(vec3 n, float angle)
{
    const vec3 t = frame_tangent(n);
    return t * cos(angle) + cross(n, t) * sin(angle);
}

// 0..1 of half a turn: a tangent and its opposite are the same.
SHARED_FN float tangent_code(vec3 n, vec3 tangent)
{
    const vec3 t = frame_tangent(n);
    const float turn = atan2(dot(cross(n, t), tangent), dot(t, tangent)) / kPi;
    return turn - floor(turn);
}

SHARED_END

#endif
