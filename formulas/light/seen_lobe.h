// The part of a rough lobe that lies over the surface. Maps of a light blurred for a roughness hold whole lobes, as
// seen by a surface that faces the direction mirrored; at grazing angles half of such a lobe lies below the surface, where
// light comes from nowhere, and wet ground lost a third of its sheen towards the horizon to the dark land there.
//
// One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_LIGHT_SEEN_LOBE_H
#define PETRICHOR_FORMULAS_LIGHT_SEEN_LOBE_H

#include "base/interop.h"

SHARED_BEGIN

struct SeenLobe {
    vec3 direction;   // where a map is asked, unit ..
    float roughness;  // .. and how much blurred
};

// The middle of what a lobe sees above the surface, and its width. normal, mirrored: unit, dot(normal, mirrored) > 0.
// Far from grazing it is the lobe as it was. The three constants are fitted to integrals of GGX with Smith's visibility and the
// Fresnel term of water under three skies (half white, overcast, bright horizon), roughness 0.1 to 0.8, elevations 1 to 45
// degrees: within 8 % up to roughness 0.3 and 17 % up to 0.8, where the whole lobe is up to 49 % too dark.
SHARED_FN SeenLobe seen_lobe(vec3 normal, vec3 mirrored, float roughness)
{
    const float up = clamp(dot(normal, mirrored), 0.001f, 1.0f);
    const float alpha = roughness * roughness;
    const float least = 3.4f * alpha / (1.0f + 5.5f * alpha);  // sine of the elevation of the middle, mirrored at the horizon
    const float up2 = up * up, least2 = least * least;
    const float lifted2 = min(sqrt(up2 * up2 + least2 * least2), 1.0f);
    const float lifted = sqrt(lifted2);
    const float along = sqrt((1.0f - lifted2) / max(1.0f - up2, 1.0e-6f));
    SeenLobe seen;
    // Unit as both are.
    seen.direction = mirrored * along + normal * (lifted - up * along);
    seen.roughness = roughness * (0.45f + 0.55f * min(up / lifted, 1.0f));
    return seen;
}

SHARED_END

#endif
