// Film, cracks and puddles of the cell kernel. "Level" and wet area count liquid and ice together:
// a frozen puddle still fills its hollow.
#ifndef PETRICHOR_WEATHER_DETAIL_WATER_KERNEL_H
#define PETRICHOR_WEATHER_DETAIL_WATER_KERNEL_H

#include "weather/physics/cell_state.h"
#include "weather/physics/detail/cell_constants.h"
#include "weather/physics/detail/reservoir.h"
#include "weather/physics/stores.h"

namespace petrichor::weather::detail {

template <class Real>
PETRICHOR_INLINE Real level_of(const Hypsometry& relief, const Real& stored)
{
    if (relief.area_fraction.empty()) {
        return smaller(square_root(larger(stored, Real(0.0)) * (2.0 * relief.depth_mm)),
                       Real(relief.depth_mm));
    }
    return each(stored, [&](double v) { return water_level_mm(relief, v); });
}
template <class Real>
PETRICHOR_INLINE Real volume_at(const Hypsometry& relief, const Real& level)
{
    if (relief.area_fraction.empty()) {
        const Real h = clamped(level, Real(0.0), Real(relief.depth_mm));
        return h * h * (0.5 / relief.depth_mm);
    }
    return each(level, [&](double h) { return stored_kg_m2(relief, h); });
}
template <class Real>
PETRICHOR_INLINE Real area_at(const Hypsometry& relief, const Real& level)
{
    if (relief.area_fraction.empty()) return level * (1.0 / relief.depth_mm);
    return each(level, [&](double h) { return wet_area(relief, h); });
}

template <class Real>
struct WetSurface {
    Real film_share, crack_area,
        puddle_area;  // 0..1; cracks where no puddle is, film where neither
    Real beta;        // wet share of the cell
};

// Under snow only the film's share is asked for: nothing evaporates there.
template <class Real, class Mask>
PETRICHOR_KERNEL WetSurface<Real> wet_surface(const CellVars<Real>& c, const CellConstants& k,
                                              const Mask& bare)
{
    WetSurface<Real> w;
    const Real all = (c.film + c.film_ice) + (c.crack + c.crack_ice) + (c.puddle + c.puddle_ice);
    if (!any(all > 0.0)) {
        w.film_share = w.crack_area = w.puddle_area = w.beta = Real(0.0);
        return w;
    }
    w.film_share = smaller((c.film + c.film_ice) * k.inverse_film_capacity, Real(1.0));
    if (!any(bare)) {
        w.crack_area = w.puddle_area = w.beta = Real(0.0);
        return w;
    }
    const Real crack = c.crack + c.crack_ice;
    const Real puddle = c.puddle + c.puddle_ice;
    w.crack_area = area_at(k.surface.cracks, level_of(k.surface.cracks, crack));
    w.puddle_area = area_at(k.surface.puddles, level_of(k.surface.puddles, puddle));
    w.beta = w.puddle_area +
             (1.0 - w.puddle_area) * (w.crack_area + (1.0 - w.crack_area) * w.film_share);
    return w;
}

// Lowers the water of one store by a depth; its wet area shrinks on the way, exactly (stores.h).
template <class Real>
struct Lowered {
    Real evaporated, infiltrated;
};
template <class Real>
PETRICHOR_KERNEL Lowered<Real> lower_store(const Hypsometry& relief, Real& liquid, const Real& ice,
                                           const Real& evaporation_mm, const Real& infiltration_mm)
{
    const Real total = liquid + ice;
    const Real drop = evaporation_mm + infiltration_mm;
    const Real level = level_of(relief, total);
    const Real lost =
        clamped(total - volume_at(relief, level - drop), Real(0.0), larger(liquid, Real(0.0)));
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

// Horton's law, stepped: the depth wet ground takes up in a substep, and its capacity afterwards.
template <class Real, class Mask>
PETRICHOR_INLINE Real infiltration_depth(CellVars<Real>& c, const Mask& wet, const CellConstants& k,
                                         const PartConstants& part)
{
    const HortonParams& h = k.surface.infiltration;
    const Real excess = c.infiltration_mm_h - h.last_mm_h;
    const Real depth = excess * part.horton_depth_h + h.last_mm_h * (part.dt_s / 3600.0);
    const Real dry = (c.infiltration_mm_h - h.first_mm_h) * part.horton_recover + h.first_mm_h;
    c.infiltration_mm_h = select(wet, excess * part.horton_keep + h.last_mm_h, dry);
    return select(wet, depth, Real(0.0));
}
template <class Real>
PETRICHOR_INLINE void recover_infiltration(CellVars<Real>& c, const CellConstants& k,
                                           const PartConstants& part)
{
    const double first = k.surface.infiltration.first_mm_h;
    if (k.permeable)
        c.infiltration_mm_h = (c.infiltration_mm_h - first) * part.horton_recover + first;
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

//   supply    rain, or what came out of the snow, kg/m2 of the substep
//   vapour    leaving (> 0) or settling, bare ground only
//   phase     melting (> 0) or freezing, bare ground only
template <class Real, class Mask>
PETRICHOR_KERNEL void move_water(CellVars<Real>& c, const Real& supply, const Real& vapour,
                                 const Real& phase, const Mask& icy, const WetSurface<Real>& wet,
                                 const CellConstants& k, const PartConstants& part)
{
    const Real zero = 0.0;
    const Real liquid = c.film + c.crack + c.puddle;
    const Real ice = c.film_ice + c.crack_ice + c.puddle_ice;
    const bool quiet = !any((supply > zero) | (liquid > zero) | (ice > zero) | (vapour < zero));
    if (quiet) {
        recover_infiltration(c, k, part);
        return;
    }

    const Real to_air = larger(vapour, zero);
    const Real settling = larger(vapour * -1.0, zero);
    Real film_supply = supply + select(icy, zero, settling);
    if (any((ice > zero) | (icy & (settling > zero)) | (phase < zero))) {
        change_ice(c, film_supply, to_air, settling, phase, icy);
    }

    // ---- film: supply, its share of the evaporation, drainage above its capacity
    const Real evaporation = select(icy, zero, to_air);
    const Real per_wet = evaporation / larger(wet.beta, Real(1e-12));
    const Real open = 1.0 - wet.puddle_area;
    const Real film_wanted = per_wet * (open * (1.0 - wet.crack_area) * wet.film_share);
    const auto film =
        drain_reservoir(c.film, (film_supply - film_wanted) * part.inverse_dt_1_s, part.film);
    c.film = film.water;
    Real evaporated = film_wanted - film.shortfall;
    Real flow = film.drained;
    if (part.sprayed > 0.0) {
        const Real sprayed = c.film * part.sprayed;
        c.film = c.film - sprayed;
        c.total_drainage += sprayed;
    }

    // ---- infiltration on the way down, then cracks and puddles fill
    Real infiltration = zero;
    if (k.permeable)
        infiltration = infiltration_depth(c, (supply > zero) | (liquid > zero), k, part);
    Real soaked = smaller(flow, infiltration);
    flow = flow - soaked;
    if (any((flow > zero) | (c.crack > zero))) {
        const Real room = larger(k.crack_capacity - (c.crack + c.crack_ice), zero);
        const Real filling = smaller(flow, room);
        c.crack += filling;
        flow = flow - filling;
        const auto cracks =
            lower_store(k.surface.cracks, c.crack, c.crack_ice, per_wet * open, infiltration);
        evaporated += cracks.evaporated;
        soaked += cracks.infiltrated;
    }
    if (any((flow > zero) | (c.puddle > zero))) {
        const Real room = larger(k.puddle_capacity - (c.puddle + c.puddle_ice), zero);
        const Real filling = smaller(flow, room);
        c.puddle += filling;
        flow = flow - filling;
        const auto puddles =
            lower_store(k.surface.puddles, c.puddle, c.puddle_ice, per_wet, infiltration);
        evaporated += puddles.evaporated;
        soaked += puddles.infiltrated;
    }

    // ---- the wet area shrank during the substep; the energy is spent, so the water still goes
    Real owed = evaporation - evaporated;
    Real back = taken_from(c.film, larger(owed, zero));
    back = taken_from(c.crack, back);
    back = taken_from(c.puddle, back);
    // A store lowered by more than the balance wanted (rounding only) gives nothing back.
    evaporated += larger(owed, zero) - back;

    c.total_evaporation += evaporated - select(icy, zero, settling);
    c.total_infiltration += soaked;
    c.total_drainage += flow;
}

}  // namespace petrichor::weather::detail

#endif
