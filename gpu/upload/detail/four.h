// Four floats that one instruction works on: the compiler's own vectors, on any machine. Each lane has the bits that a
// float alone would have.
#ifndef PETRICHOR_GPU_UPLOAD_DETAIL_FOUR_H
#define PETRICHOR_GPU_UPLOAD_DETAIL_FOUR_H

#include <cstdint>
#include <cstring>

namespace petrichor::gpu {

using Four = float __attribute__((vector_size(16)));
using FourBits = std::int32_t __attribute__((vector_size(16)));  // of a comparison: -1 where it holds

inline Four four(const void* from)
{
    Four lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
}
inline Four all(float x)
{
    return Four{x, x, x, x};
}
// As std::min and std::max: of what is not a number, the first.
inline Four lesser(Four a, Four b)
{
    return b < a ? b : a;
}
inline Four greater(Four a, Four b)
{
    return a < b ? b : a;
}
// With 0 for the last.
inline Four three(Four v)
{
    const FourBits kept{-1, -1, -1, 0};
    FourBits bits;
    std::memcpy(&bits, &v, sizeof bits);
    bits &= kept;
    std::memcpy(&v, &bits, sizeof v);
    return v;
}
inline bool any(FourBits mask)
{
    std::uint64_t halves[2];
    std::memcpy(halves, &mask, sizeof halves);
    return (halves[0] | halves[1]) != 0;
}

}  // namespace petrichor::gpu

#endif
