#ifndef PETRICHOR_WEATHER_MODELS_ARTIST_MATH_H
#define PETRICHOR_WEATHER_MODELS_ARTIST_MATH_H

#include <bit>
#include <cmath>
#include <cstdint>

namespace petrichor::weather {

// The system's exp chooses between code with and without fused multiply-add at run time, so its
// last bit depends on the processor. These use only IEEE add, multiply and divide: one answer
// everywhere.

/// 2^n for n in -1022..1023.
inline double power_of_two(int n)
{
    return std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52);
}

/// e^x, relative error below 1e-15; 0 below -708, infinite above 709, NaN stays NaN.
inline double portable_exp(double x)
{
    if (x != x) return x;
    if (x < -708.0) return 0.0;
    if (x > 709.0) return HUGE_VAL;
    // x = n ln 2 + r, |r| <= ln 2 / 2; ln 2 in two parts so that n times the first part is exact.
    const double n = std::floor(x * 1.4426950408889634 + 0.5);
    const double r = (x - n * 6.93147180369123816490e-01) - n * 1.90821492927058770002e-10;
    // Taylor to r^13: the next term is below 5e-18.
    double sum = 1.0;
    for (int i = 13; i >= 1; --i) sum = 1.0 + sum * r / i;
    const int power = static_cast<int>(n);
    return power > 1000 ? sum * power_of_two(1000) * power_of_two(power - 1000)
                        : sum * power_of_two(power);
}

/// 2^x by the same rules.
inline double portable_exp2(double x)
{
    return portable_exp(x * 0.69314718055994530942);
}

}  // namespace petrichor::weather

#endif
