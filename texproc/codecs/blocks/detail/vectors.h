// Sixteen texels at a time with the compiler's vector types: plain arithmetic, no fused operations,
// a fixed order of sums, hence the same bits with any instruction set.
#ifndef PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_VECTORS_H
#define PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_VECTORS_H

#include <cstdint>
#include <cstring>

namespace petrichor::texproc::detail {

using F8 = float __attribute__((vector_size(32)));
using I8 = std::int32_t __attribute__((vector_size(32)));
using B16 = std::uint8_t __attribute__((vector_size(16)));
using B8 = std::uint8_t __attribute__((vector_size(8)));

inline float sum(F8 v)
{
    return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}
inline F8 minimum(F8 a, F8 b)
{
    return a < b ? a : b;
}
inline F8 maximum(F8 a, F8 b)
{
    return a > b ? a : b;
}
inline F8 splat(float v)
{
    return F8{v, v, v, v, v, v, v, v};
}
inline float smallest(F8 v)
{
    float s = v[0];
    for (int i = 1; i < 8; ++i) s = v[i] < s ? v[i] : s;
    return s;
}
inline float largest(F8 v)
{
    float s = v[0];
    for (int i = 1; i < 8; ++i) s = v[i] > s ? v[i] : s;
    return s;
}
inline F8 truncated(F8 v)
{
    return __builtin_convertvector(__builtin_convertvector(v, I8), F8);
}
/// Nearest whole number of values that are not negative.
inline F8 rounded(F8 v)
{
    return truncated(v + 0.5f);
}

/// Whole numbers 0..255 as bytes.
inline void store_bytes(F8 v, std::uint8_t* to)
{
    const B8 bytes = __builtin_convertvector(__builtin_convertvector(v, I8), B8);
    std::memcpy(to, &bytes, sizeof bytes);
}

/// 16 values of one channel.
struct Plane {
    F8 v[2];
};
inline Plane to_plane(const std::uint8_t* from)
{
    Plane p;
    for (int h = 0; h < 2; ++h) {
        B8 bytes;
        std::memcpy(&bytes, from + 8 * h, 8);
        p.v[h] = __builtin_convertvector(bytes, F8);
    }
    return p;
}
inline float sum(const Plane& p)
{
    return sum(p.v[0] + p.v[1]);
}
inline Plane operator*(const Plane& a, const Plane& b)
{
    return {{a.v[0] * b.v[0], a.v[1] * b.v[1]}};
}

}  // namespace petrichor::texproc::detail

#endif
