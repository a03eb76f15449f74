// Film, cracks and puddles of the cell kernel. "Level" and wet area count liquid and ice together:
// a frozen puddle still fills its hollow.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_WATER_KERNEL_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_WATER_KERNEL_H

#include "weather/physics/cell_state.h"
#include "weather/physics/detail/cell_constants.h"
#include "weather/physics/detail/reservoir.h"
#include "weather/physics/detail/wetness_kernel.h"
#include "weather/physics/stores.h"

namespace petrichor::weather::detail {

// Lowers the water of one store by a depth; its wet area shrinks on the way, exactly (stores.h).
template <class Real>
struct Lowered {
    Real evaporated, infiltrated;
};
template <class Real>
PETRICHOR_KERNEL Lowered<Real> lower_store(const Hypsometry& relief, Real& liquid, const Real& ice,
                                           const Real& evaporation_mm, const Real& infiltration_mm)
{
    if (!any(liquid > Real(0.0))) return {Real(0.0), Real(0.0)};
    const Real total = liquid + ice;
    const Real drop = evaporation_mm + infiltration_mm;
    const Real level = level_of(relief, total);
    // Nothing is lost to rounding where nothing is asked for.
    const Real lost = select(
        drop > 0.0,
        clamped(total - volume_at(relief, level - drop), Real(0.0), larger(liquid, Real(0.0))),
        Real(0.0));
    const Real share = evaporation_mm / larger(drop, Real(1e-30));
    Lowered<Real> out;
    out.evaporated = lost * share;
    out.infiltrated = lost - out.evaporated;
    liquid = larger(liquid - lost, Real(0.0));
    return out;
}

// Moves as much of `amount` as there is from one store; what remains wanted.
template <class Real>
PETRICHOR_INLINE Real taken_from(Real& store, const Real& amount)
{
    const Real moved = smaller(store, amount);
    store = store - moved;
    return amount - moved;
}

// Capacity after a substep in which a share of the ground was wet.
template <class Real>
PETRICHOR_INLINE Real capacity_after(const CellVars<Real>& c, const Real& wet,
                                     const CellConstants& k, const PartConstants& part)
{
    const Real decayed = decayed_capacity(c.infiltration_mm_h, part.horton, k.surface.infiltration);
    const Real recovered =
        recovered_capacity(c.infiltration_mm_h, part.horton, k.surface.infiltration);
    return recovered + (decayed - recovered) * wet;
}
// Share of the pores that hold water, between two states of the film.
template <class Real>
PETRICHOR_INLINE Real pores_of(const Real& film_before, const Real& film, const CellConstants& k)
{
    const Real capacity = k.film_capacity;
    return (smaller(film_before, capacity) + smaller(film, capacity)) *
           (0.5 * k.inverse_film_capacity);
}

// Cracks and puddles over a substep, and where their water went.
template <class Real>
struct Hollows {
    Real crack, puddle;
    Real evaporated, infiltrated, overflow;
};

// A hollow takes what has room.
template <class Real>
PETRICHOR_INLINE void fill(Real& liquid, const Real& ice, double capacity, Real& flow)
{
    const Real room = larger(capacity - (liquid + ice), Real(0.0));
    const Real filling = smaller(flow, room);
    liquid += filling;
    flow = flow - filling;
}
// What has room runs into the cracks, then into the puddles; the rest is left.
template <class Real>
PETRICHOR_INLINE void fill_hollows(Hollows<Real>& h, const CellVars<Real>& c, Real& flow,
                                   const CellConstants& k)
{
    fill(h.crack, c.crack_ice, k.crack_capacity, flow);
    fill(h.puddle, c.puddle_ice, k.puddle_capacity, flow);
}
// Water that comes first fills cracks and puddles, evaporation and infiltration lower them, and
// water that goes on coming fills them again: while it rains a full hollow stays full.
template <class Real>
struct Inflow {
    Real first, on;
};
template <class Real>
PETRICHOR_KERNEL void fill_and_lower(Hollows<Real>& h, const CellVars<Real>& c,
                                     const Inflow<Real>& flow, const Real& crack_drop,
                                     const Real& puddle_drop, const Real& infiltration,
                                     const CellConstants& k)
{
    Real first = flow.first, on = flow.on;
    fill_hollows(h, c, first, k);
    const auto cracks =
        lower_store(k.surface.cracks, h.crack, c.crack_ice, crack_drop, infiltration);
    const auto puddles =
        lower_store(k.surface.puddles, h.puddle, c.puddle_ice, puddle_drop, infiltration);
    h.evaporated += cracks.evaporated + puddles.evaporated;
    h.infiltrated += cracks.infiltrated + puddles.infiltrated;
    fill_hollows(h, c, on, k);
    h.overflow += first + on;
}
// The same on ground that drinks, while its capacity decays: in turns.
template <class Real>
PETRICHOR_KERNEL void soak_and_fill(Hollows<Real>& h, const CellVars<Real>& c, const Real& flow,
                                    const Real& crack_drop, const Real& puddle_drop,
                                    const Real& first_capacity_mm_h, const CellConstants& k,
                                    const PartConstants& part)
{
    constexpr double kShare = 1.0 / kFillingTurns;
    Real capacity_mm_h = first_capacity_mm_h;
    for (int i = 0; i < kFillingTurns; ++i) {
        const Real depth =
            infiltration_depth(capacity_mm_h, part.horton_turn, k.surface.infiltration);
        capacity_mm_h = decayed_capacity(capacity_mm_h, part.horton_turn, k.surface.infiltration);
        const Real soaked = smaller(flow * kShare, depth);
        h.infiltrated += soaked;
        fill_and_lower(h, c, {Real(0.0), flow * kShare - soaked}, crack_drop * kShare,
                       puddle_drop * kShare, depth, k);
    }
}

// What runs off the film fills the hollows.
//   lasts  it runs all the time, rather than at the beginning
//   pores  wet share of the ground between them
template <class Real, class Mask>
PETRICHOR_INLINE Hollows<Real> hollows_after(CellVars<Real>& c, const Real& flow, const Mask& lasts,
                                             const Real& crack_drop, const Real& puddle_drop,
                                             const Real& pores, const CellConstants& k,
                                             const PartConstants& part)
{
    const Real zero = 0.0;
    Hollows<Real> h{c.crack, c.puddle, zero, zero, zero};
    const auto holds = c.crack + c.puddle > zero;
    const auto flows = flow > zero;
    if (!k.permeable) {
        if (any(holds | flows)) {
            const Real first = select(lasts, zero, flow);
            fill_and_lower(h, c, {first, flow - first}, crack_drop, puddle_drop, zero, k);
        }
        return h;
    }
    const Real capacity = c.infiltration_mm_h;
    c.infiltration_mm_h = capacity_after(c, select(holds | flows, Real(1.0), pores), k, part);
    // A flow that the ground can take to the end does not reach the hollows.
    const auto fills =
        flow > decayed_capacity(capacity, part.horton, k.surface.infiltration) * part.horton.hours;
    h.infiltrated = flow;
    if (any(holds)) {
        fill_and_lower(h, c, {zero, zero}, crack_drop, puddle_drop,
                       infiltration_depth(capacity, part.horton, k.surface.infiltration), k);
    }
    if (!any(fills)) return h;
    Hollows<Real> filling{c.crack, c.puddle, zero, zero, zero};
    soak_and_fill(filling, c, flow, crack_drop, puddle_drop, capacity, k, part);
    return {select(fills, filling.crack, h.crack), select(fills, filling.puddle, h.puddle),
            select(fills, filling.evaporated, h.evaporated),
            select(fills, filling.infiltrated, h.infiltrated),
            select(fills, filling.overflow, h.overflow)};
}

// Ice on the ground: sublimation and frost, melting, freezing. `film_supply` is what the film
// receives.
//   phase  melting (> 0) or freezing
template <class Real, class Mask>
PETRICHOR_KERNEL void change_ice(CellVars<Real>& c, Real& film_supply, const Real& to_air,
                                 const Real& settling, const Real& phase, const Mask& icy)
{
    const Real zero = 0.0;
    Real sublimated = select(icy, to_air, zero);
    Real left = taken_from(c.film_ice, sublimated);
    left = taken_from(c.crack_ice, left);
    left = taken_from(c.puddle_ice, left);
    sublimated = sublimated - left;
    c.film_ice += select(icy, settling, zero);
    c.total_sublimation += select(icy, sublimated - settling, zero);

    Real melt = larger(phase, zero);
    Real before = c.film_ice;
    melt = taken_from(c.film_ice, melt);
    film_supply += before - c.film_ice;
    before = c.crack_ice;
    melt = taken_from(c.crack_ice, melt);
    c.crack += before - c.crack_ice;
    before = c.puddle_ice;
    melt = taken_from(c.puddle_ice, melt);
    c.puddle += before - c.puddle_ice;

    // Freezing: the thin film first, then cracks, then puddles.
    Real freeze = larger(phase * -1.0, zero);
    before = film_supply;
    freeze = taken_from(film_supply, freeze);
    c.film_ice += before - film_supply;
    before = c.film;
    freeze = taken_from(c.film, freeze);
    c.film_ice += before - c.film;
    before = c.crack;
    freeze = taken_from(c.crack, freeze);
    c.crack_ice += before - c.crack;
    before = c.puddle;
    freeze = taken_from(c.puddle, freeze);
    c.puddle_ice += before - c.puddle;
}

constexpr double kDry_kg_m2 = 1e-4;  // a tenth of a micrometre

// A film that dries as an exponential would never be gone: the last of it leaves at once.
template <class Real, class Mask>
PETRICHOR_INLINE void dry_remnants(CellVars<Real>& c, const Mask& drying)
{
    const Real zero = 0.0;
    const auto film = drying & (c.film < kDry_kg_m2);
    const auto ice = drying & (c.film_ice < kDry_kg_m2);
    c.total_evaporation += select(film, c.film, zero);
    c.film = select(film, zero, c.film);
    c.total_sublimation += select(ice, c.film_ice, zero);
    c.film_ice = select(ice, zero, c.film_ice);
}

//   supply    rain, or what came out of the snow, kg/m2 of the substep
//   vapour    leaving (> 0) or settling, bare ground only
//   phase     melting (> 0) or freezing, bare ground only
//   slush     film up to which it is slush, kg/m2
template <class Real, class Mask>
PETRICHOR_KERNEL void move_water(CellVars<Real>& c, const Real& supply, const Real& vapour,
                                 const Real& phase, const Mask& icy, const Real& slush,
                                 const WetShares<Real>& wet, const CellConstants& k,
                                 const PartConstants& part)
{
    const Real zero = 0.0;
    const Real ice = c.film_ice + c.crack_ice + c.puddle_ice;
    // Water that keeps still: under cold snow, or none.
    const bool flows = part.sprayed > 0.0 || any((supply > zero) | (c.film > k.film_capacity));
    const bool soaks = k.permeable && any(c.crack + c.puddle > zero);
    const bool changes = any((vapour > zero) | (vapour < zero) | (phase > zero) | (phase < zero));
    if (!flows && !soaks && !changes) {
        if (k.permeable)
            c.infiltration_mm_h = capacity_after(c, pores_of(c.film, c.film, k), k, part);
        return;
    }

    const Real film_before = c.film;
    const Real to_air = larger(vapour, zero);
    const Real settling = larger(vapour * -1.0, zero);
    Real film_supply = supply + select(icy, zero, settling);
    if (any((ice > zero) | (icy & (settling > zero)) | (phase < zero))) {
        change_ice(c, film_supply, to_air, settling, phase, icy);
    }

    // ---- film: supply, its share of the evaporation, drainage above its capacity
    const Real evaporation = select(icy, zero, to_air);
    const Real per_wet = evaporation / larger(wet.all.mean, Real(1e-12));
    const Real open = 1.0 - wet.puddle;
    const Real film_wanted = per_wet * (open * wet.film);
    const auto film = drain_slush(c.film, (film_supply - film_wanted) * part.inverse_dt_1_s, slush,
                                  part.film_in_snow, part.film);
    c.film = film.water;
    Real evaporated = film_wanted - film.shortfall;
    if (part.sprayed > 0.0) {
        const Real sprayed = c.film * part.sprayed;
        c.film = c.film - sprayed;
        c.total_drainage += sprayed;
    }

    // ---- infiltration on the way down, then cracks and puddles fill
    const Real pores = pores_of(film_before, c.film, k);
    const auto hollows = hollows_after(c, film.drained, supply > zero,
                                       per_wet * (open * (1.0 - wet.film) * kCrackExposure),
                                       per_wet, pores, k, part);
    c.crack = hollows.crack;
    c.puddle = hollows.puddle;
    evaporated += hollows.evaporated;
    Real flow = hollows.overflow;

    // ---- what the balance spent energy on goes, no more and no less: the wet area may have shrunk
    // or grown on the way
    const Real owed = larger(evaporation - evaporated, zero);
    Real back = larger(evaporated - evaporation, zero);
    evaporated = evaporated - back;
    if (any(back > zero)) {
        fill(c.crack, c.crack_ice, k.crack_capacity, back);
        fill(c.puddle, c.puddle_ice, k.puddle_capacity, back);
        flow += back;
    }
    if (any(owed > zero)) {
        Real left = taken_from(c.film, owed);
        left = taken_from(c.puddle, left);
        left = taken_from(c.crack, left);
        evaporated += owed - left;
    }

    c.total_evaporation += evaporated - select(icy, zero, settling);
    dry_remnants(c, to_air > zero);
    c.total_infiltration += hollows.infiltrated;
    c.total_drainage += flow;
}

}  // namespace petrichor::weather::detail

#endif
