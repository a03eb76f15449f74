// The film as a linear reservoir, solved exactly over a step; shared by drainage.cpp and the kernel.
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

// dw/dt = net - c max(0, w - w0), w >= 0.
//
// At most one crossing of w0 can happen with a constant net supply, so the step is two pieces: until
// the crossing (A) and after it (B). Above w0 the solution is an exponential towards the steady state
// ws = w0 + net/c, below it is a line.
template <class Real>
PETRICHOR_KERNEL ReservoirStep<Real> drain_reservoir(const Real& w, const Real& net, double c, double w0,
                                                     double dt)
{
    const Real steady = net * (1.0 / c) + w0;
    const auto above = w > w0;
    const auto falling = net < 0.0;
    if (!any(above | !falling)) {
        // Drying pores: a line, which is what the general form gives too.
        const Real available = w + net * dt;
        ReservoirStep<Real> dry;
        dry.shortfall = larger(available * -1.0, Real(0.0));
        dry.drained = Real(0.0);
        dry.water = larger(available, Real(0.0));
        return dry;
    }
    Real fall_time = dt;
    if (any(above & falling)) {
        fall_time = logarithm(larger((w - steady) / larger(w0 - steady, Real(1e-300)), Real(1.0))) * (1.0 / c);
    }
    const Real rise_time = (w0 - w) / larger(net, Real(1e-300));
    Real until = select(above, select(falling, fall_time, Real(dt)), select(falling, Real(dt), rise_time));
    until = smaller(until, Real(dt));
    const Real rest = dt - until;
    const Real high = steady + (w - steady) * exponential(until * -c);
    const Real low = w + net * until;
    const Real reached = select(above, high, low);
    Real crossed_up = w0;
    if (any((rest > 0.0) & !above)) crossed_up = steady + (w0 - steady) * exponential(rest * -c);
    const Real crossed_down = net * rest + w0;
    Real end = select(rest > 0.0, select(above, crossed_down, crossed_up), reached);
    ReservoirStep<Real> step;
    step.shortfall = larger(end * -1.0, Real(0.0));
    end = larger(end, Real(0.0));
    // Both from one sum, so that supply - loss - change closes to rounding.
    const Real available = w + net * dt + step.shortfall;
    step.drained = larger(available - end, Real(0.0));
    step.water = larger(available - step.drained, Real(0.0));
    return step;
}

}  // namespace petrichor::weather::detail

#endif
