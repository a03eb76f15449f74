// Eight numbers that move together: the same arithmetic as double, for eight cells at once.
//
// A kernel is written once as a template over Real and runs with Real = double (one cell) or Real =
// Lanes<bytes> (eight cells in registers of 16, 32 or 64 bytes). Every operation is the IEEE one on
// each element, in the same order, so both give the same bits. Which registers are used is chosen
// by the file that instantiates the kernel; the type carries the width, so that two instantiations
// never share a symbol.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_LANES_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_LANES_H

#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

#if defined(__AVX__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

// Parts of a number stay in registers only when loops over them are unrolled early.
#define PETRICHOR_UNROLL _Pragma("GCC unroll 4")
#define PETRICHOR_INLINE inline __attribute__((always_inline))
// Large pieces stay functions of their own: inlining them several times costs minutes of
// compilation.
#define PETRICHOR_KERNEL __attribute__((noinline))

namespace petrichor::weather::detail {

inline constexpr int kLaneCount = 8;

template <int kBytes>
struct Native;
template <>
struct Native<16> {
    typedef double Number __attribute__((vector_size(16)));
    typedef std::int64_t Bits __attribute__((vector_size(16)));
};
template <>
struct Native<32> {
    typedef double Number __attribute__((vector_size(32)));
    typedef std::int64_t Bits __attribute__((vector_size(32)));
};

template <>
struct Native<64> {
    typedef double Number __attribute__((vector_size(64)));
    typedef std::int64_t Bits __attribute__((vector_size(64)));
};

template <int kBytes>
struct LaneMask {
    static constexpr int kParts = kLaneCount * 8 / kBytes;
    typename Native<kBytes>::Bits part[kParts];
};
// AVX-512 has registers for masks, a bit a lane.
template <>
struct LaneMask<64> {
    static constexpr int kParts = 1;
    std::uint8_t part[kParts];
};

template <int kBytes>
struct alignas(64) Lanes {
    static constexpr int kParts = kLaneCount * 8 / kBytes;
    static constexpr int kPerPart = kBytes / 8;
    typename Native<kBytes>::Number part[kParts];

    Lanes() = default;
    PETRICHOR_INLINE Lanes(double value)  // NOLINT: a plain number is a valid operand
    {
        PETRICHOR_UNROLL for (int p = 0; p < kParts; ++p) part[p] =
            value - typename Native<kBytes>::Number{};
    }
    PETRICHOR_INLINE double operator[](int lane) const
    {
        return part[lane / kPerPart][lane % kPerPart];
    }
    PETRICHOR_INLINE void set(int lane, double value)
    {
        part[lane / kPerPart][lane % kPerPart] = value;
    }
};

#define PETRICHOR_LANE_OPERATOR(op)                                                            \
    template <int kBytes>                                                                      \
    PETRICHOR_INLINE Lanes<kBytes> operator op(const Lanes<kBytes>& a, const Lanes<kBytes>& b) \
    {                                                                                          \
        Lanes<kBytes> r;                                                                       \
        PETRICHOR_UNROLL for (int p = 0; p < Lanes<kBytes>::kParts; ++p) r.part[p] =           \
            a.part[p] op b.part[p];                                                            \
        return r;                                                                              \
    }                                                                                          \
    template <int kBytes>                                                                      \
    PETRICHOR_INLINE Lanes<kBytes> operator op(const Lanes<kBytes>& a, double b)               \
    {                                                                                          \
        Lanes<kBytes> r;                                                                       \
        PETRICHOR_UNROLL for (int p = 0; p < Lanes<kBytes>::kParts; ++p) r.part[p] =           \
            a.part[p] op b;                                                                    \
        return r;                                                                              \
    }                                                                                          \
    template <int kBytes>                                                                      \
    PETRICHOR_INLINE Lanes<kBytes> operator op(double a, const Lanes<kBytes>& b)               \
    {                                                                                          \
        Lanes<kBytes> r;                                                                       \
        PETRICHOR_UNROLL for (int p = 0; p < Lanes<kBytes>::kParts; ++p) r.part[p] =           \
            a op b.part[p];                                                                    \
        return r;                                                                              \
    }
PETRICHOR_LANE_OPERATOR(+)
PETRICHOR_LANE_OPERATOR(-)
PETRICHOR_LANE_OPERATOR(*)
PETRICHOR_LANE_OPERATOR(/)
#undef PETRICHOR_LANE_OPERATOR

#define PETRICHOR_LANE_COMPARISON(op)                                                             \
    template <int kBytes>                                                                         \
    PETRICHOR_INLINE LaneMask<kBytes> operator op(const Lanes<kBytes>& a, const Lanes<kBytes>& b) \
    {                                                                                             \
        LaneMask<kBytes> r;                                                                       \
        PETRICHOR_UNROLL for (int p = 0; p < Lanes<kBytes>::kParts; ++p) r.part[p] =              \
            a.part[p] op b.part[p];                                                               \
        return r;                                                                                 \
    }                                                                                             \
    template <int kBytes>                                                                         \
    PETRICHOR_INLINE LaneMask<kBytes> operator op(const Lanes<kBytes>& a, double b)               \
    {                                                                                             \
        LaneMask<kBytes> r;                                                                       \
        PETRICHOR_UNROLL for (int p = 0; p < Lanes<kBytes>::kParts; ++p)                          \
        {                                                                                         \
            r.part[p] = a.part[p] op(b - typename Native<kBytes>::Number{});                      \
        }                                                                                         \
        return r;                                                                                 \
    }
#if defined(__AVX512F__) && defined(__AVX512DQ__)
#define PETRICHOR_LANE_COMPARISON_64(op, predicate)                                       \
    PETRICHOR_INLINE LaneMask<64> operator op(const Lanes<64>& a, const Lanes<64>& b)     \
    {                                                                                     \
        return {{_mm512_cmp_pd_mask((__m512d)a.part[0], (__m512d)b.part[0], predicate)}}; \
    }                                                                                     \
    PETRICHOR_INLINE LaneMask<64> operator op(const Lanes<64>& a, double b)               \
    {                                                                                     \
        return {{_mm512_cmp_pd_mask((__m512d)a.part[0], _mm512_set1_pd(b), predicate)}};  \
    }
PETRICHOR_LANE_COMPARISON_64(<, _CMP_LT_OS)
PETRICHOR_LANE_COMPARISON_64(>, _CMP_GT_OS)
PETRICHOR_LANE_COMPARISON_64(<=, _CMP_LE_OS)
PETRICHOR_LANE_COMPARISON_64(>=, _CMP_GE_OS)
#undef PETRICHOR_LANE_COMPARISON_64
#endif
PETRICHOR_LANE_COMPARISON(<)
PETRICHOR_LANE_COMPARISON(>)
PETRICHOR_LANE_COMPARISON(<=)
PETRICHOR_LANE_COMPARISON(>=)
#undef PETRICHOR_LANE_COMPARISON

#define PETRICHOR_MASK_OPERATOR(op)                                                     \
    template <int kBytes>                                                               \
    PETRICHOR_INLINE LaneMask<kBytes> operator op(const LaneMask<kBytes>& a,            \
                                                  const LaneMask<kBytes>& b)            \
    {                                                                                   \
        LaneMask<kBytes> r;                                                             \
        PETRICHOR_UNROLL for (int p = 0; p < LaneMask<kBytes>::kParts; ++p) r.part[p] = \
            static_cast<std::decay_t<decltype(r.part[p])>>(a.part[p] op b.part[p]);     \
        return r;                                                                       \
    }
PETRICHOR_MASK_OPERATOR(&)
PETRICHOR_MASK_OPERATOR(|)
#undef PETRICHOR_MASK_OPERATOR

template <int kBytes>
PETRICHOR_INLINE LaneMask<kBytes> operator!(const LaneMask<kBytes>& a)
{
    LaneMask<kBytes> r;
    PETRICHOR_UNROLL for (int p = 0; p < LaneMask<kBytes>::kParts; ++p) r.part[p] =
        static_cast<std::decay_t<decltype(r.part[p])>>(~a.part[p]);
    return r;
}

template <int kBytes>
PETRICHOR_INLINE Lanes<kBytes> operator-(const Lanes<kBytes>& a)
{
    return 0.0 - a;
}
template <int kBytes>
PETRICHOR_INLINE Lanes<kBytes>& operator+=(Lanes<kBytes>& a, const Lanes<kBytes>& b)
{
    a = a + b;
    return a;
}
template <int kBytes>
PETRICHOR_INLINE Lanes<kBytes>& operator-=(Lanes<kBytes>& a, const Lanes<kBytes>& b)
{
    a = a - b;
    return a;
}

// mask ? a : b, element by element, by bits: no rounding, NaN passes through.
template <int kBytes>
PETRICHOR_INLINE Lanes<kBytes> select(const LaneMask<kBytes>& mask, const Lanes<kBytes>& a,
                                      const Lanes<kBytes>& b)
{
    using Bits = typename Native<kBytes>::Bits;
    using Number = typename Native<kBytes>::Number;
    Lanes<kBytes> r;
    PETRICHOR_UNROLL for (int p = 0; p < Lanes<kBytes>::kParts; ++p)
    {
#if defined(__AVX__)
        if constexpr (kBytes == 32) {
            r.part[p] = (Number)_mm256_blendv_pd((__m256d)b.part[p], (__m256d)a.part[p],
                                                 (__m256d)mask.part[p]);
            continue;
        }
#endif
        r.part[p] = (Number)(((Bits)a.part[p] & mask.part[p]) | ((Bits)b.part[p] & ~mask.part[p]));
    }
    return r;
}
#if defined(__AVX512F__) && defined(__AVX512DQ__)
// The forms without a mask warn of an operand that they do not read (GCC 12).
inline constexpr std::uint8_t kAllLanes = 0xFF;
PETRICHOR_INLINE Lanes<64> select(const LaneMask<64>& mask, const Lanes<64>& a, const Lanes<64>& b)
{
    Lanes<64> r;
    r.part[0] = (Native<64>::Number)_mm512_mask_blend_pd(mask.part[0], (__m512d)b.part[0],
                                                         (__m512d)a.part[0]);
    return r;
}
PETRICHOR_INLINE bool any(const LaneMask<64>& mask)
{
    return mask.part[0] != 0;
}
PETRICHOR_INLINE Lanes<64> square_root(const Lanes<64>& a)
{
    Lanes<64> r;
    r.part[0] = (Native<64>::Number)_mm512_maskz_sqrt_pd(kAllLanes, (__m512d)a.part[0]);
    return r;
}
#endif
template <int kBytes>
PETRICHOR_INLINE bool any(const LaneMask<kBytes>& mask)
{
    typename Native<kBytes>::Bits all = mask.part[0];
    PETRICHOR_UNROLL for (int p = 1; p < LaneMask<kBytes>::kParts; ++p) all |= mask.part[p];
#if defined(__AVX__)
    if constexpr (kBytes == 32) return _mm256_movemask_pd((__m256d)all) != 0;
#endif
    std::int64_t found = 0;
    for (int i = 0; i < kBytes / 8; ++i) found |= all[i];
    return found != 0;
}
template <int kBytes>
PETRICHOR_INLINE Lanes<kBytes> square_root(const Lanes<kBytes>& a)
{
    Lanes<kBytes> r;
    PETRICHOR_UNROLL for (int p = 0; p < Lanes<kBytes>::kParts; ++p)
    {
#if defined(__AVX__)
        if constexpr (kBytes == 32) {
            r.part[p] = (typename Native<kBytes>::Number)_mm256_sqrt_pd((__m256d)a.part[p]);
            continue;
        }
#endif
        for (int i = 0; i < Lanes<kBytes>::kPerPart; ++i)
            r.part[p][i] = __builtin_sqrt(a.part[p][i]);
    }
    return r;
}
/// f of each element, one after the other: for look-ups in tables.
template <int kBytes, class F>
PETRICHOR_INLINE Lanes<kBytes> each(const Lanes<kBytes>& a, F&& f)
{
    Lanes<kBytes> r;
    for (int lane = 0; lane < kLaneCount; ++lane) r.set(lane, f(a[lane]));
    return r;
}

// The same words for one number.
PETRICHOR_INLINE double select(bool mask, double a, double b)
{
    return mask ? a : b;
}
PETRICHOR_INLINE bool any(bool mask)
{
    return mask;
}
PETRICHOR_INLINE double square_root(double a)
{
    return std::sqrt(a);
}
template <class F>
PETRICHOR_INLINE double each(double a, F&& f)
{
    return f(a);
}

template <class Real>
struct MaskOfReal {
    using Type = bool;
};
template <int kBytes>
struct MaskOfReal<Lanes<kBytes>> {
    using Type = LaneMask<kBytes>;
};
template <class Real>
using MaskOf = typename MaskOfReal<Real>::Type;

// a < b ? a : b and a > b ? a : b, which is what the minimum and maximum instructions do, bit for
// bit.
template <class Real>
PETRICHOR_INLINE Real smaller(const Real& a, const Real& b)
{
    return select(a < b, a, b);
}
template <class Real>
PETRICHOR_INLINE Real larger(const Real& a, const Real& b)
{
    return select(a > b, a, b);
}
#if defined(__SSE2__)
PETRICHOR_INLINE Lanes<16> smaller(const Lanes<16>& a, const Lanes<16>& b)
{
    Lanes<16> r;
    PETRICHOR_UNROLL for (int p = 0; p < Lanes<16>::kParts; ++p) r.part[p] =
        _mm_min_pd(a.part[p], b.part[p]);
    return r;
}
PETRICHOR_INLINE Lanes<16> larger(const Lanes<16>& a, const Lanes<16>& b)
{
    Lanes<16> r;
    PETRICHOR_UNROLL for (int p = 0; p < Lanes<16>::kParts; ++p) r.part[p] =
        _mm_max_pd(a.part[p], b.part[p]);
    return r;
}
#endif
#if defined(__AVX__)
PETRICHOR_INLINE Lanes<32> smaller(const Lanes<32>& a, const Lanes<32>& b)
{
    Lanes<32> r;
    PETRICHOR_UNROLL for (int p = 0; p < Lanes<32>::kParts; ++p) r.part[p] =
        _mm256_min_pd(a.part[p], b.part[p]);
    return r;
}
PETRICHOR_INLINE Lanes<32> larger(const Lanes<32>& a, const Lanes<32>& b)
{
    Lanes<32> r;
    PETRICHOR_UNROLL for (int p = 0; p < Lanes<32>::kParts; ++p) r.part[p] =
        _mm256_max_pd(a.part[p], b.part[p]);
    return r;
}
#endif
#if defined(__AVX512F__) && defined(__AVX512DQ__)
PETRICHOR_INLINE Lanes<64> smaller(const Lanes<64>& a, const Lanes<64>& b)
{
    Lanes<64> r;
    r.part[0] =
        (Native<64>::Number)_mm512_maskz_min_pd(kAllLanes, (__m512d)a.part[0], (__m512d)b.part[0]);
    return r;
}
PETRICHOR_INLINE Lanes<64> larger(const Lanes<64>& a, const Lanes<64>& b)
{
    Lanes<64> r;
    r.part[0] =
        (Native<64>::Number)_mm512_maskz_max_pd(kAllLanes, (__m512d)a.part[0], (__m512d)b.part[0]);
    return r;
}
#endif
template <class Real>
PETRICHOR_INLINE Real clamped(const Real& a, const Real& low, const Real& high)
{
    return smaller(larger(a, low), high);
}
template <class Real>
PETRICHOR_INLINE Real unit_clamped(const Real& a)
{
    return clamped(a, Real(0.0), Real(1.0));
}

}  // namespace petrichor::weather::detail

#endif
