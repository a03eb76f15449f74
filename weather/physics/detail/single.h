// One number as a type of its own: the same arithmetic as double, for kernels that are compiled for
// other registers than the rest of the program. An instantiation with it never shares a symbol with
// one of double.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_SINGLE_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_SINGLE_H

#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather::detail {

struct Single {
    double value;

    Single() = default;
    PETRICHOR_INLINE Single(double v) : value(v) {}  // NOLINT: a plain number is a valid operand
};
static_assert(sizeof(Single) == sizeof(double));

#define PETRICHOR_SINGLE_OPERATOR(op, Result)               \
    PETRICHOR_INLINE Result operator op(Single a, Single b) \
    {                                                       \
        return Result(a.value op b.value);                  \
    }                                                       \
    PETRICHOR_INLINE Result operator op(Single a, double b) \
    {                                                       \
        return Result(a.value op b);                        \
    }                                                       \
    PETRICHOR_INLINE Result operator op(double a, Single b) \
    {                                                       \
        return Result(a op b.value);                        \
    }
PETRICHOR_SINGLE_OPERATOR(+, Single)
PETRICHOR_SINGLE_OPERATOR(-, Single)
PETRICHOR_SINGLE_OPERATOR(*, Single)
PETRICHOR_SINGLE_OPERATOR(/, Single)
PETRICHOR_SINGLE_OPERATOR(<, bool)
PETRICHOR_SINGLE_OPERATOR(>, bool)
PETRICHOR_SINGLE_OPERATOR(<=, bool)
PETRICHOR_SINGLE_OPERATOR(>=, bool)
#undef PETRICHOR_SINGLE_OPERATOR

PETRICHOR_INLINE Single operator-(Single a)
{
    return -a.value;
}
PETRICHOR_INLINE Single& operator+=(Single& a, Single b)
{
    a.value += b.value;
    return a;
}
PETRICHOR_INLINE Single& operator-=(Single& a, Single b)
{
    a.value -= b.value;
    return a;
}

PETRICHOR_INLINE Single select(bool mask, Single a, Single b)
{
    return mask ? a.value : b.value;
}
PETRICHOR_INLINE Single square_root(Single a)
{
    return __builtin_sqrt(a.value);
}
template <class F>
PETRICHOR_INLINE Single each(Single a, F&& f)
{
    return f(a.value);
}
PETRICHOR_INLINE Single power_of_two(Single k_plus_magic)
{
    return power_of_two(k_plus_magic.value);
}
PETRICHOR_INLINE Single mantissa_of(Single a)
{
    return mantissa_of(a.value);
}
PETRICHOR_INLINE Single exponent_of(Single a)
{
    return exponent_of(a.value);
}

}  // namespace petrichor::weather::detail

#endif
