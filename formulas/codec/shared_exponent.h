// Three numbers, none below 0, in a word: nine bits each and an exponent for all (VK_FORMAT_E5B9G9R9_UFLOAT_PACK32).
#ifndef PETRICHOR_FORMULAS_CODEC_SHARED_EXPONENT_H
#define PETRICHOR_FORMULAS_CODEC_SHARED_EXPONENT_H

#include "base/interop.h"

SHARED_BEGIN

SHARED_CONST float kSharedExponentMost = 65408.0f;

// Off by 1/512 of the largest of the three at most; above kSharedExponentMost that.
SHARED_FN uint shared_exponent_code(vec3 x)
{
    const vec3 c = clamp(x, splat3(0.0f), splat3(kSharedExponentMost));
    const float most = max(c.x, max(c.y, max(c.z, 1.52587890625e-5f)));
    // What nine bits round up to the next power of two has that one's exponent.
    const uint exponent = (floatBitsToUint(most) + 0x4000u) >> 23u;  // 111 to 142
    const float scale = uintBitsToFloat((262u - exponent) << 23u);
    return uint(c.x * scale + 0.5f) | (uint(c.y * scale + 0.5f) << 9u) | (uint(c.z * scale + 0.5f) << 18u) |
           ((exponent - 111u) << 27u);
}

SHARED_FN vec3 shared_exponent_value(uint code)
{
    const float scale = uintBitsToFloat(((code >> 27u) + 103u) << 23u);
    return vec3(float(code & 511u), float((code >> 9u) & 511u), float((code >> 18u) & 511u)) * scale;
}

SHARED_END

#endif
