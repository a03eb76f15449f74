// A normal whose last bits say how rough its surface is, where it is rough.
//
// One text for C++ and GLSL. Of a smooth surface fifteen bits and the sign of both numbers are kept, and the last of the first is 1. Of a
// rough one, where the last is 0, eleven and twelve are left: less than its roughness blurs.
#ifndef PETRICHOR_FORMULAS_CODEC_ROUGH_NORMAL_H
#define PETRICHOR_FORMULAS_CODEC_ROUGH_NORMAL_H

#include "base/interop.h"

SHARED_BEGIN

SHARED_CONST float kRoughCodes = 255.0f;

// octahedral: -1..1, kept in 16 bits with sign; roughness 0..1.
SHARED_FN vec2 rough_normal_code(vec2 octahedral, float roughness)
{
    const uint x = uint(floor(clamp(octahedral.x, -1.0f, 1.0f) * 32767.0f + 0.5f) + 32768.0f);
    const uint y = uint(floor(clamp(octahedral.y, -1.0f, 1.0f) * 32767.0f + 0.5f) + 32768.0f);
    const uint rough = uint(clamp(roughness, 0.0f, 1.0f) * kRoughCodes + 0.5f);
    if (rough == 0u) return vec2((float(x | 1u) - 32768.0f) / 32767.0f, (float(y) - 32768.0f) / 32767.0f);
    // Not the lowest code, which is no number of its own.
    const uint high = max(x & 65504u, 32u) | ((rough & 15u) << 1u);
    const uint low = max(y & 65520u, 16u) | (rough >> 4u);
    return vec2((float(high) - 32768.0f) / 32767.0f, (float(low) - 32768.0f) / 32767.0f);
}

SHARED_FN float roughness_of_normal(vec2 code)
{
    const uint x = uint(floor(code.x * 32767.0f + 0.5f) + 32768.0f);
    const uint y = uint(floor(code.y * 32767.0f + 0.5f) + 32768.0f);
    const uint rough = ((x >> 1u) & 15u) | ((y & 15u) << 4u);
    return (x & 1u) != 0u ? 0.0f : float(rough) / kRoughCodes;
}

SHARED_END

#endif
