// Light that comes through from behind: Lux 2.02's fast translucency (after Barre-Brisebois and Bouchard
// 2011), and what a rim of fibres scatters. Per lux of a light that the surface would face, as all lobes.
#ifndef PETRICHOR_FORMULAS_LIGHT_TRANSLUCENT_H
#define PETRICHOR_FORMULAS_LIGHT_TRANSLUCENT_H

#include "base/interop.h"
#include "formulas/light/brdf.h"

SHARED_BEGIN

struct Translucency {
    float strength;    // 0: none
    float power;       // sharpness of the glow towards the light; 0: wrapped around, for leaves
    float distortion;  // how far the normal bends it
    float scale;
    float shadow;      // how much of a shadow on the surface it keeps
    vec3 color;        // of what comes through; times the albedo where the model says so
};

// Share of the light that comes through, over pi.
SHARED_FN float light_through(Translucency t, vec3 n, vec3 v, vec3 l)
{
    if (t.power >= 0.001f) {
        const float x = clamp(-dot(l + n * t.distortion, v), 0.0f, 1.0f);
        return t.strength * exp2(t.power * x - t.power) * t.scale * (1.0f / kPi);
    }
    const float wrapped = clamp((0.5f - dot(n, l)) / 2.25f, 0.0f, 1.0f);
    const float z = clamp(-dot(v, l), 0.0f, 1.0f);
    const float a2 = 0.49f;
    const float d = (z * a2 - z) * z + 1.0f;
    return wrapped * (a2 / (kPi * d * d)) * t.strength * t.scale * (1.0f / kPi);
}

// What of a shadow it is under: thin parts let light in from beside.
SHARED_FN float shadow_through(Translucency t, float visible)
{
    const float kept = t.power >= 0.001f ? (1.0f - t.shadow) * t.strength : 1.0f - t.shadow;
    return mix(visible, 1.0f, clamp(kept, 0.0f, 1.0f));
}

// Albedo that fibres at the rim add (Lux 2.02, "diffuse scattering").
//   power   how narrow the rim is;  bias   what is added everywhere
SHARED_FN vec3 scattered_albedo(vec3 albedo, vec3 color, float bias, float power, float nv)
{
    const float rim = exp2(-power * nv * nv) + bias;
    return min(albedo + color * rim, max(albedo, splat3(1.0f)));
}

SHARED_END

#endif
