// From exposed scene-referred light to a display: a filmic shoulder and toe, then the sRGB curve.
// The rational curve is Narkowicz 2015 ("ACES filmic tone mapping curve"), with its toe weakened.
#ifndef PETRICHOR_FORMULAS_COLOR_TONE_MAP_H
#define PETRICHOR_FORMULAS_COLOR_TONE_MAP_H

#include "base/interop.h"
#include "formulas/color/srgb.h"

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
    const vec3 c = mix(exposed, vec3(grey), to_white * 0.6f);
    return vec3(filmic_channel(c.x), filmic_channel(c.y), filmic_channel(c.z));
}

SHARED_END

#endif
