// From exposed scene-referred light to a display: a filmic shoulder and toe, then the sRGB curve.
// The rational curve is Narkowicz 2015 ("ACES filmic tone mapping curve"), with its toe weakened.
#ifndef PETRICHOR_FORMULAS_COLOR_TONE_MAP_H
#define PETRICHOR_FORMULAS_COLOR_TONE_MAP_H

#include "base/interop.h"
#include "formulas/color/aces.h"
#include "formulas/color/agx.h"
#include "formulas/color/khronos_neutral.h"
#include "formulas/color/srgb.h"

// The curves by number; linear only clips.
#define TONE_MAP_LINEAR 0
#define TONE_MAP_FILMIC 1
#define TONE_MAP_AGX 2
#define TONE_MAP_ACES 3
#define TONE_MAP_NEUTRAL 4

SHARED_BEGIN

// A rational curve on one channel: 0 to 0, slope 1 in the dark, monotone, clipped at 1 by the
// encoder. 0.18 maps to 0.179 and 16 to 0.988.
SHARED_FN float filmic_channel(float x)
{
    const float y = max(x, 0.0f);
    return (y * (2.51f * y * 0.40f + 0.14f)) / (y * (2.43f * y * 0.40f + 0.84f) + 0.14f);
}

// Bright saturated light moves towards white, as on film, before the curve.
SHARED_FN vec3 tone_map(vec3 exposed)
{
    const float peak = max(exposed.x, max(exposed.y, exposed.z));
    const float to_white = peak / (peak + 6.0f);
    const float grey = dot(exposed, vec3(0.2126f, 0.7152f, 0.0722f));
    const vec3 c = mix(exposed, splat3(grey), to_white * 0.6f);
    return vec3(filmic_channel(c.x), filmic_channel(c.y), filmic_channel(c.z));
}

// Linear display light for exposed light under the curve of that number.
SHARED_FN vec3 display_light(int curve, vec3 exposed)
{
    if (curve == TONE_MAP_FILMIC) return tone_map(exposed);
    if (curve == TONE_MAP_AGX) return agx(exposed);
    if (curve == TONE_MAP_ACES) return aces(exposed);
    if (curve == TONE_MAP_NEUTRAL) return khronos_neutral(exposed);
    return exposed;
}

SHARED_END

#endif
