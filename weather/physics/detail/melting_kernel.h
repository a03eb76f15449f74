// What melts or freezes while the weather changes over a step, with the surface held at 0 C
// meanwhile.
//
// At 0 C the balance F runs along a line over the step, F0 - a .. F0 + a. Ice melts by the mean of
// its positive part, water freezes by the mean of its negative part, so that an hour in which the
// sun comes out melts what an hour of minutes would.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_MELTING_KERNEL_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_MELTING_KERNEL_H

#include "weather/physics/detail/surface_kernel.h"

namespace petrichor::weather::detail {

// What a surface could change.
template <class Real>
struct PhaseStores {
    Real ice, water;  // kg/m2: could melt, could freeze
    MaskOf<Real> may_melt, may_freeze;
};

template <class Real>
struct PhaseChange {
    Real melt_flux = 0.0;  // W/m2, melting > 0, freezing < 0
    Real melting = 0.0;    // share of the step with melt
};

//   later  what the balance still gains from the middle of the step to its end, W/m2
// `root` moves to the melting point, or to what is left after the last ice or water has changed.
template <class Real, class Mask, class Wetness>
PETRICHOR_INLINE PhaseChange<Real> change_phase(const SurfacePoint<Real, Mask, Wetness>& p,
                                                const ExchangeParams& params,
                                                const PhaseStores<Real>& stores, const Real& later,
                                                double dt_s, SurfaceRoot<Real, Wetness>& root)
{
    const Real zero = 0.0;
    PhaseChange<Real> change;
    const Real reach = larger(larger(later, -later), Real(1e-9));
    // |T| < reach / slope, without the division
    const Real pull = root.surface_c * root.slope;
    const auto pinned = (stores.may_melt & (pull > -reach)) | (stores.may_freeze & (pull < reach));
    if (!any(pinned)) return change;

    SurfaceRoot<Real, Wetness> held;
    held.exchange = exchange_at(p, params, zero);
    centre_at_melting_point(held.vapour, p);
    const auto humidity = humidity_at_middle(held.vapour);
    lay_wet_line(p, humidity, held.exchange, held.wet);
    const auto f0 = balance_with(p, humidity, held.wet, zero, held.exchange);

    const Real above = clamped(f0.balance + reach, zero, reach * 2.0);
    const Real share = above * (0.5 / reach);
    const Real melting = larger(f0.balance, above * share * 0.5);
    const Real lost = larger(f0.vapour, zero) * dt_s;
    const Real most = larger(stores.ice - select(p.icy, lost, zero), zero) * (kLatentFusion / dt_s);
    const Real least =
        larger(stores.water - select(p.icy, zero, lost), zero) * (-kLatentFusion / dt_s);
    const Real wanted = clamped(select(stores.may_melt, melting, zero) +
                                    select(stores.may_freeze, f0.balance - melting, zero),
                                least, most);
    change.melt_flux = select(pinned, wanted, zero);
    change.melting = select(pinned & stores.may_melt, smaller(share, Real(1.0)), zero);

    // What the change of phase leaves over warms or cools the surface.
    held.surface_c = zero;
    const auto partly = pinned & ((wanted > f0.balance) | (wanted < f0.balance));
    if (any(partly)) {
        held.surface_c = select(partly, (f0.balance - wanted) / root.slope, zero);
        for (int i = 0; i < 2; ++i) {
            // A dusting that melts at once leaves a warm road, not one in the air of a cold one.
            held.exchange = select(partly, exchange_at(p, params, held.surface_c), held.exchange);
            follow(held.vapour, p, held.surface_c);
            const auto g = balance_with(p, humidity_at(held.vapour, held.surface_c), held.wet,
                                        held.surface_c, held.exchange);
            held.surface_c = select(partly, held.surface_c + (g.balance - wanted) / g.slope, zero);
        }
        follow(held.vapour, p, held.surface_c);
    }
    take(pinned, held, root);
    return change;
}

// The surface at the end of the step: the balance has moved on by `later`, and the melting point
// still holds it where there is something to change.
template <class Real>
PETRICHOR_INLINE Real end_temperature(const PhaseStores<Real>& stores,
                                      const PhaseChange<Real>& change, const Real& surface_c,
                                      const Real& later, const Real& slope)
{
    const Real zero = 0.0;
    Real end_c = surface_c + (later + change.melt_flux) / slope;
    end_c = select(stores.may_melt & (surface_c <= zero), smaller(end_c, zero), end_c);
    return select(stores.may_freeze & (surface_c >= zero), larger(end_c, zero), end_c);
}

}  // namespace petrichor::weather::detail

#endif
