// Half floats (IEEE 754 binary16) by whole numbers: packHalf2x16 of a CPU driver takes several
// times as long.
#ifndef PETRICHOR_FORMULAS_CODEC_HALF_H
#define PETRICHOR_FORMULAS_CODEC_HALF_H

#include "base/interop.h"

SHARED_BEGIN

// The 16 bits of the nearest half, the even one of two; what is beyond 65504 is infinite. Of what
// is not a number the bits 0x7e00.
SHARED_FN uint half_code(float x)
{
    const uint all = floatBitsToUint(x);
    const uint u = all & 0x7fffffffu;
    // Below the least normal half a sum whose last bit has the weight of a half's does the
    // rounding.
    const uint rounded = u < 0x38800000u ? floatBitsToUint(uintBitsToFloat(u) + 0.5f) - 0x3f000000u
                                         : (u - 0x37fff001u + ((u >> 13u) & 1u)) >> 13u;
    const uint code = u >= 0x477ff000u ? (u > 0x7f800000u ? 0x7e00u : 0x7c00u) : rounded;
    return code | ((all >> 16u) & 0x8000u);
}

// Two in one word, the first in the low bits.
SHARED_FN uint half_codes(float low, float high)
{
    return half_code(low) | (half_code(high) << 16u);
}

SHARED_END

#endif
