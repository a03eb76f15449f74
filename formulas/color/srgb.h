// The transfer curve of sRGB (IEC 61966-2-1), both ways, on one channel of 0..1.
#ifndef PETRICHOR_FORMULAS_COLOR_SRGB_H
#define PETRICHOR_FORMULAS_COLOR_SRGB_H

#include "base/interop.h"

SHARED_BEGIN

// Linear light to the code of a display. The argument is taken as it is: clamp it first.
SHARED_FN float srgb_from_linear(float x)
{
    return x <= 0.0031308f ? 12.92f * x : 1.055f * pow(x, 1.0f / 2.4f) - 0.055f;
}

SHARED_FN float linear_from_srgb(float code)
{
    return code <= 0.04045f ? code / 12.92f : pow((code + 0.055f) / 1.055f, 2.4f);
}

// The same, clamped to what a display shows, within 2e-6 of it: the power is a polynomial in the fourth root,
// which a pixel has in a third of the time.
SHARED_FN float srgb_encode(float x)
{
    const float y = clamp(x, 0.0f, 1.0f);
    const float s = sqrt(sqrt(y));
    const float high = 0.068207905f * s - 0.3184157f;
    const float middle = (high * s + 0.6571879f) * s - 0.8529571f;
    return y <= 0.0031308f
               ? 12.92f * y
               : ((middle * s + 1.3659209f) * s + 0.13960417f) * s - 0.059546612f;
}

// Of a colour; what is brighter than 1 goes on along the curve.
SHARED_FN vec3 srgb_codes(vec3 light)
{
    return vec3(srgb_from_linear(max(light.x, 0.0f)), srgb_from_linear(max(light.y, 0.0f)),
                srgb_from_linear(max(light.z, 0.0f)));
}

SHARED_END

#endif
