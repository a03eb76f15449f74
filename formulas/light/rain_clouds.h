// A closed layer of clouds that brings rain, from below: broad dark masses with lighter bands between, darker where it hangs low, and
// torn rags (stratus fractus) that drive below it. With no rain it is the even layer of clouds.h.
#ifndef PETRICHOR_FORMULAS_LIGHT_RAIN_CLOUDS_H
#define PETRICHOR_FORMULAS_LIGHT_RAIN_CLOUDS_H

#include "formulas/light/clouds.h"

SHARED_BEGIN

SHARED_CONST float kCloudsAHeight = 2.2f;     // lengths of the field in a height of the layer, 1.6 km
SHARED_CONST float kCloudDrift_per_m = 0.0015f;
SHARED_CONST float kRagHeight = 0.35f;        // of the rags, in heights of the layer
SHARED_CONST float kRagsAHeight = 1.3f;       // lengths of their field in a height of theirs
SHARED_CONST float kRagDrift_per_m = 0.0023f;
SHARED_CONST int kRagOctaves = 5;

// Distance to a layer over a round earth, in heights of the layer, for the cosine `up` with the vertical. radius: of the
// earth, in the same; 4000 for a layer in 1.6 km.
SHARED_FN float layer_reach(float up, float radius)
{
    const float along = radius * up;
    return (2.0f * radius + 1.0f) / (sqrt(along * along + 2.0f * radius + 1.0f) + along);
}

// 0 the thinnest of the layer .. 1 the thickest. field: cloud_field() there, about 0.67; broad: of the masses, 0..1.
// Through the air before them far ones have less contrast; under rain less of it is lost, since what is bright lies far.
SHARED_FN float layer_heavy(float field, float broad, float reach, float rain)
{
    const float thick = field + rain * (0.5f * (field - 0.67f) + 0.9f * (broad - 0.5f));
    const float t = clamp((thick - 0.32f) / 0.68f, 0.0f, 1.0f);
    return mix(0.5f, t * t * (3.0f - 2.0f * t), exp(-mix(0.13f, 0.03f, rain) * reach));
}

// Of the masses at a place of the field.
SHARED_FN float layer_broad(vec2 bent)
{
    return 0.65f * endless_noise(bent * 0.31f + splat2(3.0f), 330u) + 0.35f * endless_noise(bent * 0.74f + splat2(11.0f), 331u);
}

// How much of what is above them the rags hide, 0..1, in a direction; drift_m: how far the wind has carried them.
SHARED_FN float rags_hide(vec3 direction, vec2 drift_m, float texel_rad, float rain)
{
    const float reach = layer_reach(max(direction.y, 0.0f), 4000.0f / kRagHeight);
    const vec2 at = vec2(direction.x, direction.z) * (reach * kRagsAHeight) + drift_m * kRagDrift_per_m + splat2(9.0f);
    const float above = cloud_field(at + 0.7f * cloud_bend(at), kRagsAHeight * texel_rad * reach * reach, kRagOctaves) -
                        cloud_threshold(0.42f * rain);
    const float t = clamp(above / 0.13f, 0.0f, 1.0f);
    return 0.9f * t * t * (3.0f - 2.0f * t) * exp(-0.02f * reach);
}

// Radiance of the layer over that of an even one.
SHARED_FN float layer_relief(float heavy, float hidden, float rain)
{
    const float thin = clamp(1.0f - 2.0f * heavy, 0.0f, 1.0f);
    const float layer = mix(mix(1.32f, 1.65f, rain), mix(0.68f, 0.45f, rain), heavy) + 0.7f * rain * thin * thin;
    // Rags are lit by the layer above and, from below, by the wet land.
    return mix(layer, 0.22f + 0.25f * layer, hidden);
}

// The same in a direction from the beginning, with the layer's widest octaves: for means over the sky.
SHARED_FN float layer_relief_wide(vec3 direction, vec2 drift_m, float texel_rad, float rain)
{
    const float reach = layer_reach(max(direction.y, 0.0f), 4000.0f);
    const vec2 at = vec2(direction.x, direction.z) * (reach * kCloudsAHeight) + drift_m * kCloudDrift_per_m + splat2(40.0f);
    const vec2 bent = at + cloud_bend(at);
    const float field = cloud_field(bent, kCloudsAHeight * texel_rad * reach * reach, kHeapOctaves);
    const float hidden = rain > 0.0f ? rags_hide(direction, drift_m, texel_rad, rain) : 0.0f;
    return layer_relief(layer_heavy(field, layer_broad(bent), reach, rain), hidden, rain);
}

SHARED_END

#endif
