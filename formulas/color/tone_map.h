// From exposed scene-referred light to a display: a filmic shoulder and toe, then the sRGB curve.
#ifndef PETRICHOR_FORMULAS_COLOR_TONE_MAP_H
#define PETRICHOR_FORMULAS_COLOR_TONE_MAP_H

#include "base/interop.h"

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

SHARED_FN float srgb_encode(float x)
{
    const float c = clamp(x, 0.0f, 1.0f);
    return c <= 0.0031308f ? 12.92f * c : 1.055f * pow(c, 1.0f / 2.4f) - 0.055f;
}

SHARED_END

#endif
