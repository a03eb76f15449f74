// The film as a linear reservoir, solved exactly over a step; shared by drainage.cpp and the
// kernel.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_RESERVOIR_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_RESERVOIR_H

#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather::detail {

template <class Real>
struct ReservoirStep {
    Real water;      // at the end, >= 0
    Real drained;    // ran off during the step, >= 0
    Real shortfall;  // of the wanted loss, because the store was empty
};

// What depends on the reservoir and the length of the step only.
struct ReservoirConstants {
    double rate_1_s, inverse_rate_s, threshold;
    double dt_s, keep;  // keep = exp(-rate dt)
};
inline ReservoirConstants reservoir_constants(double rate_1_s, double threshold, double dt_s)
{
    return {rate_1_s, 1.0 / rate_1_s, threshold, dt_s, exponential(-rate_1_s * dt_s)};
}

// How fast a store drains, and for how long.
template <class Real>
struct Drain {
    Real rate_1_s, inverse_rate_s;
    Real dt_s, keep;  // keep = exp(-rate dt)
};
template <class Real>
PETRICHOR_INLINE Drain<Real> drain_of(const ReservoirConstants& r)
{
    return {Real(r.rate_1_s), Real(r.inverse_rate_s), Real(r.dt_s), Real(r.keep)};
}
template <class Real, class Mask>
PETRICHOR_INLINE Drain<Real> chosen(const Mask& first, const ReservoirConstants& a,
                                    const ReservoirConstants& b)
{
    return {select(first, Real(a.rate_1_s), Real(b.rate_1_s)),
            select(first, Real(a.inverse_rate_s), Real(b.inverse_rate_s)), Real(a.dt_s),
            select(first, Real(a.keep), Real(b.keep))};
}

// dw/dt = net - c max(0, w - w0), w >= 0.
//
// At most one crossing of w0 can happen with a constant net supply, so the step is two pieces:
// until the crossing (A) and after it (B). Above w0 the solution is an exponential towards the
// steady state ws = w0 + net/c, below it is a line.
template <class Real>
PETRICHOR_KERNEL ReservoirStep<Real> drain_reservoir(const Real& w, const Real& net, double w0,
                                                     const Drain<Real>& r)
{
    const Real zero = 0.0;
    const auto above = w > w0;
    const auto rising = net >= zero;
    const Real available = w + net * r.dt_s;
    ReservoirStep<Real> step;
    if (!any(above | (rising & (available > w0)))) {
        // Pores that dry or fill: a line, which is what the general form gives too.
        step.shortfall = larger(available * -1.0, zero);
        step.drained = zero;
        step.water = larger(available, zero);
        return step;
    }
    const Real steady = net * r.inverse_rate_s + w0;
    const Real kept = steady + (w - steady) * r.keep;  // above w0 all the time
    const auto falls_through = above & (kept < w0);
    const auto rises_through = (w <= w0) & rising & (available > w0);
    Real end = select(above, kept, available);
    if (any(falls_through)) {
        const Real until =
            logarithm(larger((w - steady) / larger(w0 - steady, Real(1e-300)), Real(1.0))) *
            r.inverse_rate_s;
        end = select(falls_through, net * (r.dt_s - smaller(until, r.dt_s)) + w0, end);
    }
    if (any(rises_through)) {
        const Real rest = larger(r.dt_s - (w0 - w) / larger(net, Real(1e-300)), zero);
        end = select(rises_through, steady + (w0 - steady) * exponential(rest * -r.rate_1_s), end);
    }
    step.shortfall = larger(end * -1.0, zero);
    end = larger(end, zero);
    // Both from one sum, so that supply - loss - change closes to rounding.
    const Real held = available + step.shortfall;
    step.drained = larger(held - end, zero);
    step.water = larger(held - step.drained, zero);
    return step;
}

// The same where the store is slush up to `limit`, and drains more slowly there: split at the limit
// too. Between both steady states it stays at the limit. At and below w0 a limit means nothing.
template <class Real>
PETRICHOR_KERNEL ReservoirStep<Real> drain_slush(const Real& w, const Real& net, const Real& limit,
                                                 const ReservoirConstants& slush,
                                                 const ReservoirConstants& water)
{
    const double w0 = water.threshold;
    const auto limited = limit > w0;
    const auto below = limited & (w <= limit);
    const Drain<Real> drain = chosen<Real>(below, slush, water);
    ReservoirStep<Real> step = drain_reservoir(w, net, w0, drain);
    const auto falls = limited & (w > limit) & (step.water < limit);
    const auto rises = below & (step.water > limit);
    const auto crosses = falls | rises;
    if (!any(crosses)) return step;
    // To w0 along a line, to the limit along an exponential, and on at the other rate.
    const Real steady = net * drain.inverse_rate_s + w0;
    const Real filling =
        select(rises, larger(w0 - w, Real(0.0)) / larger(net, Real(1e-300)), Real(0.0));
    const Real part = select(crosses, (larger(w, Real(w0)) - steady) / (limit - steady), Real(1.0));
    const Real until = filling + logarithm(larger(part, Real(1.0))) * drain.inverse_rate_s;
    Drain<Real> on = chosen<Real>(rises, water, slush);
    on.dt_s = larger(drain.dt_s - until, Real(0.0));
    on.keep = exponential(on.dt_s * -on.rate_1_s);
    const ReservoirStep<Real> then = drain_reservoir(limit, net, w0, on);
    const auto stays = (falls & (then.water > limit)) | (rises & (then.water < limit));
    const Real end = select(stays, limit, then.water);
    const Real shortfall = select(stays, Real(0.0), then.shortfall);
    const Real held = w + net * drain.dt_s + shortfall;
    const Real drained = larger(held - end, Real(0.0));
    step.shortfall = select(crosses, shortfall, step.shortfall);
    step.drained = select(crosses, drained, step.drained);
    step.water = select(crosses, larger(held - drained, Real(0.0)), step.water);
    return step;
}

}  // namespace petrichor::weather::detail

#endif
