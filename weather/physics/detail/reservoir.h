// The film as a linear reservoir, solved exactly over a step; shared by drainage.cpp and the
// kernel.
#ifndef PETRICHOR_WEATHER_DETAIL_RESERVOIR_H
#define PETRICHOR_WEATHER_DETAIL_RESERVOIR_H

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

// dw/dt = net - c max(0, w - w0), w >= 0.
//
// At most one crossing of w0 can happen with a constant net supply, so the step is two pieces:
// until the crossing (A) and after it (B). Above w0 the solution is an exponential towards the
// steady state ws = w0 + net/c, below it is a line.
template <class Real>
PETRICHOR_KERNEL ReservoirStep<Real> drain_reservoir(const Real& w, const Real& net,
                                                     const ReservoirConstants& r)
{
    const Real zero = 0.0;
    const double w0 = r.threshold;
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
        end = select(falls_through, net * (r.dt_s - smaller(until, Real(r.dt_s))) + w0, end);
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

}  // namespace petrichor::weather::detail

#endif
