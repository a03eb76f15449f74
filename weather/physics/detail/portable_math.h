// exp, log, sin, cos and friends made of +, -, *, / and bit moves only.
//
// The C library's versions differ in the last bit between machines and versions, and a state hash
// must not. These are exact to about 1e-15 relative, the same on every compiler that does not
// contract a*b+c (the project builds with -ffp-contract=off), and run on Lanes as on double.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_PORTABLE_MATH_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_PORTABLE_MATH_H

#include "weather/physics/constants.h"
#include "weather/physics/detail/lanes.h"

namespace petrichor::weather::detail {

// Adding 1.5 * 2^52 rounds to an integer that then sits in the low bits of the sum.
inline constexpr double kRoundMagic = 6755399441055744.0;

// 2^k for the integer k held by (k + kRoundMagic); -1022 <= k <= 1023.
PETRICHOR_INLINE double power_of_two(double k_plus_magic)
{
    const auto bits = std::bit_cast<std::uint64_t>(k_plus_magic);
    return std::bit_cast<double>((bits << 52) + (std::uint64_t{1023} << 52));
}
template <int kBytes>
PETRICHOR_INLINE Lanes<kBytes> power_of_two(const Lanes<kBytes>& k_plus_magic)
{
    using Bits = typename Native<kBytes>::Bits;
    using Number = typename Native<kBytes>::Number;
    Lanes<kBytes> r;
    PETRICHOR_UNROLL for (int p = 0; p < Lanes<kBytes>::kParts; ++p)
    {
        r.part[p] = (Number)(((Bits)k_plus_magic.part[p] << 52) + (std::int64_t{1023} << 52));
    }
    return r;
}

// Splits a positive normal number into mantissa in [1, 2) and exponent.
PETRICHOR_INLINE double mantissa_of(double a)
{
    const auto bits = std::bit_cast<std::uint64_t>(a);
    return std::bit_cast<double>((bits & 0x000FFFFFFFFFFFFFull) | 0x3FF0000000000000ull);
}
PETRICHOR_INLINE double exponent_of(double a)
{
    const auto bits = std::bit_cast<std::uint64_t>(a);
    return std::bit_cast<double>((bits >> 52) | 0x4330000000000000ull) - 4503599627370496.0 -
           1023.0;
}
template <int kBytes>
PETRICHOR_INLINE Lanes<kBytes> mantissa_of(const Lanes<kBytes>& a)
{
    using Bits = typename Native<kBytes>::Bits;
    using Number = typename Native<kBytes>::Number;
    Lanes<kBytes> r;
    PETRICHOR_UNROLL for (int p = 0; p < Lanes<kBytes>::kParts; ++p)
    {
        r.part[p] = (Number)(((Bits)a.part[p] & 0x000FFFFFFFFFFFFFll) | 0x3FF0000000000000ll);
    }
    return r;
}
template <int kBytes>
PETRICHOR_INLINE Lanes<kBytes> exponent_of(const Lanes<kBytes>& a)
{
    using Bits = typename Native<kBytes>::Bits;
    using Number = typename Native<kBytes>::Number;
    Lanes<kBytes> r;
    PETRICHOR_UNROLL for (int p = 0; p < Lanes<kBytes>::kParts; ++p)
    {
        r.part[p] = (Number)(((Bits)a.part[p] >> 52) | 0x4330000000000000ll);
    }
    return r - 4503599627370496.0 - 1023.0;
}

/// e^x; x is clamped to -708..708. NaN gives a finite number: check inputs at the door.
template <class Real>
PETRICHOR_INLINE Real exponential(const Real& x_in)
{
    const Real x = clamped(x_in, Real(-708.0), Real(708.0));
    const Real magic = x * 1.4426950408889634074 + kRoundMagic;
    const Real k = magic - kRoundMagic;
    // x = k ln2 + r in two parts, |r| <= 0.3466; the first part of ln2 has zeros at its end.
    const Real r = (x - k * 0.693147180369123816490) - k * 1.90821492927058770002e-10;
    // Taylor to r^12, in pairs so that the multiplications overlap; remainder below 2e-16.
    const Real r2 = r * r;
    const Real r4 = r2 * r2;
    const Real p01 = r + 1.0;
    const Real p23 = r * (1.0 / 6.0) + 0.5;
    const Real p45 = r * (1.0 / 120.0) + (1.0 / 24.0);
    const Real p67 = r * (1.0 / 5040.0) + (1.0 / 720.0);
    const Real p89 = r * (1.0 / 362880.0) + (1.0 / 40320.0);
    const Real pab = r * (1.0 / 39916800.0) + (1.0 / 3628800.0);
    const Real p0123 = p23 * r2 + p01;
    const Real p4567 = p67 * r2 + p45;
    const Real p89abc = r4 * (1.0 / 479001600.0) + (pab * r2 + p89);
    const Real series = (p89abc * r4 + p4567) * r4 + p0123;
    return series * power_of_two(magic);
}

/// e^x to 3e-10 relative, for -700 < x < 700 and for laws that are not known better.
template <class Real>
PETRICHOR_INLINE Real exponential_short(const Real& x)
{
    const Real magic = x * 1.4426950408889634074 + kRoundMagic;
    const Real k = magic - kRoundMagic;
    const Real r = x - k * 0.69314718055994530942;
    const Real r2 = r * r;
    const Real p01 = r + 1.0;
    const Real p23 = r * (1.0 / 6.0) + 0.5;
    const Real p45 = r * (1.0 / 120.0) + (1.0 / 24.0);
    const Real p67 = r * (1.0 / 5040.0) + (1.0 / 720.0);
    const Real r4 = r2 * r2;
    const Real p45678 = r4 * (1.0 / 40320.0) + (p67 * r2 + p45);
    return (p45678 * r4 + (p23 * r2 + p01)) * power_of_two(magic);
}

/// x = 2^k m with m about 1, and s = (m - 1) / (m + 1), |s| <= 0.1716.
template <class Real>
struct SplitLogarithm {
    Real k, s;
};
template <class Real>
PETRICHOR_INLINE SplitLogarithm<Real> split_logarithm(const Real& x)
{
    Real m = mantissa_of(x);
    Real k = exponent_of(x);
    const auto high = m > 1.41421356237309504880;
    m = select(high, m * 0.5, m);
    k = select(high, k + 1.0, k);
    return {k, (m - 1.0) / (m + 1.0)};
}

/// ln x for positive normal x.
template <class Real>
PETRICHOR_INLINE Real logarithm(const Real& x)
{
    const auto [k, s] = split_logarithm(x);
    // ln m = 2 atanh(s): odd series to s^21.
    const Real z = s * s;
    // In pairs, so that the multiplications overlap.
    const Real z2 = z * z;
    const Real z4 = z2 * z2;
    const Real p01 = z * (1.0 / 5.0) + 1.0 / 3.0;
    const Real p23 = z * (1.0 / 9.0) + 1.0 / 7.0;
    const Real p45 = z * (1.0 / 13.0) + 1.0 / 11.0;
    const Real p67 = z * (1.0 / 17.0) + 1.0 / 15.0;
    const Real p89 = z * (1.0 / 21.0) + 1.0 / 19.0;
    const Real p0123 = p23 * z2 + p01;
    const Real p4567 = p67 * z2 + p45;
    const Real series = (p89 * z4 + p4567) * z4 + p0123;
    const Real two_s = s * 2.0;
    return k * 0.693147180369123816490 +
           (two_s + (two_s * z * series + k * 1.90821492927058770002e-10));
}

/// x^y for positive x.
template <class Real>
PETRICHOR_INLINE Real power(const Real& x, double y)
{
    return exponential(logarithm(x) * y);
}

/// ln x to 2e-11, for positive normal x.
template <class Real>
PETRICHOR_INLINE Real logarithm_short(const Real& x)
{
    const auto [k, s] = split_logarithm(x);
    const Real z = s * s;
    const Real z2 = z * z;
    const Real p01 = z * (2.0 / 3.0) + 2.0;
    const Real p23 = z * (2.0 / 7.0) + 2.0 / 5.0;
    const Real p45 = z * (2.0 / 11.0) + 2.0 / 9.0;
    return k * 0.69314718055994530942 + s * ((p45 * z2 + p23) * z2 + p01);
}
/// x^y to 1e-9 relative, for positive x and small |y|.
template <class Real>
PETRICHOR_INLINE Real power_short(const Real& x, double y)
{
    return exponential_short(logarithm_short(x) * y);
}

template <class Real>
PETRICHOR_INLINE Real hyperbolic_tangent_positive(const Real& x)
{
    const Real e = exponential(x * -2.0);
    return (1.0 - e) / (e + 1.0);
}

/// sin and cos of an angle up to about 1e5 rad.
struct SinCos {
    double sin, cos;
};
inline SinCos sine_cosine(double angle_rad)
{
    const double magic = angle_rad * (2.0 / kPi) + kRoundMagic;
    const double k = magic - kRoundMagic;
    const double r = (angle_rad - k * 1.57079632673412561417) - k * 6.07710050650619224932e-11;
    const double z = r * r;
    double s = 1.0 / 6227020800.0 - z / 1307674368000.0;
    s = s * z - 1.0 / 39916800.0;
    s = s * z + 1.0 / 362880.0;
    s = s * z - 1.0 / 5040.0;
    s = s * z + 1.0 / 120.0;
    s = s * z - 1.0 / 6.0;
    s = s * z * r + r;
    double c = 1.0 / 479001600.0 - z / 87178291200.0;
    c = c * z - 1.0 / 3628800.0;
    c = c * z + 1.0 / 40320.0;
    c = c * z - 1.0 / 720.0;
    c = c * z + 1.0 / 24.0;
    c = c * z - 0.5;
    c = c * z + 1.0;
    switch (static_cast<long long>(k) & 3) {
        case 0:
            return {s, c};
        case 1:
            return {c, -s};
        case 2:
            return {-s, -c};
        default:
            return {-c, s};
    }
}

/// Angle 0..pi of a cosine in -1..1, to 1e-12: Abramowitz & Stegun 4.4.45 and two steps of
/// Newton's.
inline double arc_cosine(double x)
{
    const double a = x < 0.0 ? -x : x;
    double angle =
        std::sqrt(1.0 - a) * (1.5707288 + a * (-0.2121144 + a * (0.0742610 - a * 0.0187293)));
    for (int i = 0; i < 2; ++i) {
        const SinCos at = sine_cosine(angle);
        if (at.sin > 1e-8) angle += (at.cos - a) / at.sin;
    }
    return x < 0.0 ? 3.14159265358979323846 - angle : angle;
}

}  // namespace petrichor::weather::detail

#endif
