// How much of the ground a film of water covers: the one law for all that speaks of it.
//
//   cover = sqrt(w / full) up to 1: the wet area of a relief whose heights are all equally frequent, as that of
//           cracks and puddles (uniform_relief.h), which `full` fills to its tops. A thin film leaves the tops
//           of stones dry; what is left lies between them. Stones are a few millimetres wide and conduct heat
//           so well that dry tops and the water between them have one temperature (Biot number 0.05).
//
// A film that nothing feeds uncovers the ground along a line: du/dt = -e / (2 full).
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_FILM_COVER_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_FILM_COVER_H

#include "weather/physics/detail/cell_constants.h"
#include "weather/physics/detail/portable_math.h"
#include "weather/physics/detail/reservoir.h"
#include "weather/physics/detail/surface_kernel.h"

namespace petrichor::weather::detail {

template <class Real>
PETRICHOR_INLINE Real film_cover_of(const Real& film, double inverse_full)
{
    return square_root(clamped(film * inverse_full, Real(0.0), Real(1.0)));
}

// (1 - exp(-x)) / x and exp(-x) for x >= 0: the eighth power of 1 / (1 + y + y^2/2 + y^3/6), y =
// x/8. Positive, monotone, below 1; within 1e-4 of the truth up to x = 1, 2e-3 anywhere.
template <class Real>
struct Decay {
    Real mean, end;
};
template <class Real>
PETRICHOR_INLINE Decay<Real> decay_of(const Real& x)
{
    const Real y = x * 0.125;
    const Real half = y * (y * (1.0 / 6.0) + 0.5) + 1.0;
    const Real r = 1.0 / (y * half + 1.0);
    const Real r2 = r * r;
    const Real r4 = r2 * r2;
    return {r * half * ((r + 1.0) * (r2 + 1.0)) * ((r4 + 1.0) * 0.125), r4 * r4};
}

// Cover over a step.
//   film       liquid and ice
//   cover      of that
//   supply     rain of the step, kg/m2
//   potential  what evaporates where all of it is wet, kg/m2 of the step
template <class Real>
PETRICHOR_INLINE WetShare<Real> cover_while_drying(const Real& film, const Real& cover,
                                                   const Real& liquid, const Real& supply,
                                                   const Real& potential, const FilmConstants& f,
                                                   const ReservoirConstants& r)
{
    const Real zero = 0.0, one = 1.0;
    WetShare<Real> share{zero, zero};
    const auto fed = supply > zero;
    if (any(fed)) {
        // In two halves; in each a share of the film evaporates, that of its middle.
        const Real added = supply * 0.5, wanted = potential * 0.5;
        const Real most = larger(film, supply * (r.inverse_rate_s / r.dt_s) + f.held);
        Real water = film, gone = zero;
        for (int half = 0; half < 2; ++half) {
            const Real middle = larger(smaller(water + added * 0.5, most), Real(1e-9));
            const Real wet = film_cover_of(middle, f.inverse_full);
            const auto decay = decay_of(wanted * (wet / middle));
            const Real left = water * decay.end + added * decay.mean;
            gone += smaller(water + added - left, wanted * wet);
            water = smaller(left, most);
        }
        const Real end = film_cover_of(water, f.inverse_full);
        share.mean = select(potential > 1e-12, gone / larger(potential, Real(1e-12)), end);
        share.end = smaller(end, share.mean);
        if (!any(supply <= zero)) return share;
    }
    // Above what is held it runs off as well: the cover of its mean until then.
    Real start = cover, before = zero, rest = one;
    const auto excess = liquid > f.held;
    if (any(excess)) {
        const Real net = larger(potential * (1.0 / r.dt_s), Real(1e-12));
        const Real steady = net * r.inverse_rate_s;
        const Real above = larger(liquid - f.held, zero);
        const Real until =
            smaller(logarithm(above * r.rate_1_s / net + 1.0) * r.inverse_rate_s, Real(r.dt_s));
        const Real left = larger((above + steady) * exponential(until * -r.rate_1_s) - steady, zero);
        const Real mean = larger(
            (above - left - net * until) * r.inverse_rate_s / larger(until, Real(1e-9)), zero);
        const Real under = film - liquid + f.held;
        const Real share_before = until * (1.0 / r.dt_s);
        before = select(excess, film_cover_of(mean + under, f.inverse_full) * share_before, before);
        rest = select(excess, larger(1.0 - share_before, zero), rest);
        start = select(excess, film_cover_of(left + under, f.inverse_full), start);
    }
    const Real fall = potential * rest * (0.5 * f.inverse_full);
    const Real end = larger(start - fall, zero);
    const Real lasts = smaller(start / larger(fall, Real(1e-12)), one);
    share.mean = select(fed, share.mean, smaller(before + rest * (start + end) * 0.5 * lasts, one));
    share.end = select(fed, share.end, end);
    return share;
}

}  // namespace petrichor::weather::detail

#endif
