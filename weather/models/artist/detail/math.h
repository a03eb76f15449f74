#ifndef PETRICHOR_WEATHER_MODELS_ARTIST_DETAIL_MATH_H
#define PETRICHOR_WEATHER_MODELS_ARTIST_DETAIL_MATH_H

#include <cmath>

#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather {

/// e^x, relative error below 1e-15; 0 below -708, infinite above 708, NaN stays NaN. One answer on
/// every processor.
inline double portable_exp(double x)
{
    if (x != x) return x;
    if (x < -708.0) return 0.0;
    if (x > 708.0) return HUGE_VAL;
    return detail::exponential(x);
}

/// 2^x by the same rules.
inline double portable_exp2(double x)
{
    return portable_exp(x * 0.69314718055994530942);
}

}  // namespace petrichor::weather

#endif
