// Elementary functions of our own, for numbers that end up in files: mathematical libraries differ
// in the last bit from processor to processor and from version to version, additions and
// multiplications do not. All are worked out in double precision, by series whose first dropped
// term is below 1e-11 of the value, so that a float that is made of one is off by half a step.
#ifndef PETRICHOR_BASE_PORTABLE_MATH_H
#define PETRICHOR_BASE_PORTABLE_MATH_H

#include <bit>
#include <cstdint>

namespace petrichor {

/// To the nearest whole number, without the call that rounding costs on plain x86-64.
inline std::int64_t nearest_whole(double x)
{
    return static_cast<std::int64_t>(x < 0.0 ? x - 0.5 : x + 0.5);
}

/// e^x; x is held to -700..700.
inline double portable_exp(double x)
{
    static constexpr double kEighths[8] = {1.0,
                                           1.0905077326652577,
                                           1.189207115002721,
                                           1.2968395546510096,
                                           1.4142135623730951,
                                           1.5422108254079407,
                                           1.681792830507429,
                                           1.8340080864093424};  // 2^(i/8)
    x = x < -700.0 ? -700.0 : x > 700.0 ? 700.0 : x;
    // 2^(k/8) e^r with |r| <= ln 2 / 16.
    const std::int64_t k = nearest_whole(x * 11.541560327111707);
    const double eighths = static_cast<double>(k);
    const double r = (x - eighths * 0.08664339756069239) - eighths * 9.300771387515496e-12;
    double sum = 1.0 / 720.0;
    sum = sum * r + 1.0 / 120.0;
    sum = sum * r + 1.0 / 24.0;
    sum = sum * r + 1.0 / 6.0;
    sum = sum * r + 0.5;
    sum = (sum * r + 1.0) * r + 1.0;
    const auto exponent = static_cast<std::uint64_t>((k >> 3) + 1023);
    return sum * kEighths[k & 7] * std::bit_cast<double>(exponent << 52);
}

/// The natural logarithm of a normal number above 0.
inline double portable_log(double x)
{
    const auto bits = std::bit_cast<std::uint64_t>(x);
    auto exponent = static_cast<std::int64_t>(bits >> 52) - 1023;
    double m = std::bit_cast<double>((bits & 0x000fffffffffffffull) | 0x3ff0000000000000ull);
    if (m > 1.4142135623730951) {
        m *= 0.5;
        ++exponent;
    }
    // log m = 2 artanh((m - 1) / (m + 1))
    const double s = (m - 1.0) / (m + 1.0), s2 = s * s;
    double sum = 1.0 / 15.0;
    sum = sum * s2 + 1.0 / 13.0;
    sum = sum * s2 + 1.0 / 11.0;
    sum = sum * s2 + 1.0 / 9.0;
    sum = sum * s2 + 1.0 / 7.0;
    sum = sum * s2 + 0.2;
    sum = sum * s2 + 1.0 / 3.0;
    sum = sum * s2 + 1.0;
    return 2.0 * s * sum + static_cast<double>(exponent) * 0.6931471805599453;
}

struct SinCos {
    double sine, cosine;
};
/// Of an angle within a million.
inline SinCos portable_sin_cos(double angle)
{
    const std::int64_t turns = nearest_whole(angle * 0.6366197723675814);
    const double quarter = static_cast<double>(turns);
    const double r = (angle - quarter * 1.5707963267341256) - quarter * 6.0771005065061922e-11;
    const double r2 = r * r;
    double s = -1.0 / 39916800.0;
    s = s * r2 + 1.0 / 362880.0;
    s = s * r2 - 1.0 / 5040.0;
    s = s * r2 + 1.0 / 120.0;
    s = s * r2 - 1.0 / 6.0;
    s = (s * r2 + 1.0) * r;
    double c = 1.0 / 479001600.0;
    c = c * r2 - 1.0 / 3628800.0;
    c = c * r2 + 1.0 / 40320.0;
    c = c * r2 - 1.0 / 720.0;
    c = c * r2 + 1.0 / 24.0;
    c = c * r2 - 0.5;
    c = c * r2 + 1.0;
    switch (turns & 3) {
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

inline float portable_exp(float x)
{
    return static_cast<float>(portable_exp(static_cast<double>(x)));
}
inline float portable_log(float x)
{
    return static_cast<float>(portable_log(static_cast<double>(x)));
}
/// base^power for a base of at least 0; 0 stays 0.
inline float portable_pow(float base, float power)
{
    if (!(base > 0.0f)) return 0.0f;
    const double log = portable_log(static_cast<double>(base));
    return static_cast<float>(portable_exp(static_cast<double>(power) * log));
}
inline float portable_sin(float angle)
{
    return static_cast<float>(portable_sin_cos(static_cast<double>(angle)).sine);
}
inline float portable_cos(float angle)
{
    return static_cast<float>(portable_sin_cos(static_cast<double>(angle)).cosine);
}

}  // namespace petrichor

#endif
