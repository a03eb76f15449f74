// How much of a cell is wet while its water dries away: exact means over a step, so that one energy
// balance serves an hour in which a film dries out.
//
//   film     evaporates where it covers the ground (film_cover.h)
//   hollows  evaporation lowers the level by e dt, and the water lost is V(h) - V(h - e dt)
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_WETNESS_KERNEL_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_WETNESS_KERNEL_H

#include "weather/physics/cell_state.h"
#include "weather/physics/detail/cell_constants.h"
#include "weather/physics/detail/film_cover.h"
#include "weather/physics/detail/reservoir.h"
#include "weather/physics/detail/surface_kernel.h"
#include "weather/physics/detail/uniform_relief.h"
#include "weather/physics/stores.h"

namespace petrichor::weather::detail {

template <class Real>
PETRICHOR_INLINE Real level_of(const Hypsometry& relief, const Real& stored)
{
    if (relief.area_fraction.empty()) return uniform_level_of(stored, relief.depth_mm);
    return each(stored, [&](double v) { return water_level_mm(relief, v); });
}
template <class Real>
PETRICHOR_INLINE Real volume_at(const Hypsometry& relief, const Real& level)
{
    if (relief.area_fraction.empty()) return uniform_volume_at(level, relief.depth_mm);
    return each(level, [&](double h) { return stored_kg_m2(relief, h); });
}
template <class Real>
PETRICHOR_INLINE Real area_at(const Hypsometry& relief, const Real& level)
{
    if (relief.area_fraction.empty()) return uniform_area_at(level, relief.depth_mm);
    return each(level, [&](double h) { return wet_area(relief, h); });
}

// The wet area of a hollow while its level falls.
//   end  what a little more evaporation would add
template <class Real>
PETRICHOR_INLINE WetShare<Real> area_while_falling(const Hypsometry& relief, const Real& level,
                                                   const Real& evaporation_mm,
                                                   const Real& infiltration_mm)
{
    const double tiny = 1e-30;
    const Real drop = evaporation_mm + infiltration_mm + tiny;
    const Real inverse = 1.0 / drop;
    const Real rest = larger(level - drop, Real(0.0));
    WetShare<Real> area;
    if (relief.area_fraction.empty()) {
        area.end = uniform_area_at(rest, relief.depth_mm);
        area.mean = (level + rest) * (0.5 / relief.depth_mm) * smaller(level * inverse, Real(1.0));
    } else {
        area.end = area_at(relief, rest);
        area.mean =
            select(drop > 1e-6,
                   unit_clamped((volume_at(relief, level) - volume_at(relief, rest)) * inverse),
                   area_at(relief, level));
    }
    area.end = area.mean + (area.end - area.mean) * ((evaporation_mm + tiny) * inverse);
    return area;
}

// Share of the air's demand that reaches water in cracks. It lies in still air and in shade some
// millimetres down, beside walls that are dry: the last stage of drying, which road tests see as
// dark joints and seams hours after the surface is dry.
constexpr double kCrackExposure = 0.15;

// Means over a step; where nothing is wet all are 0.
template <class Real>
struct WetShares {
    Real film, crack, puddle;  // film where no puddle is, cracks where neither
    WetShare<Real> all;        // of the cell
};

template <class Real, class Mask>
PETRICHOR_INLINE void take(const Mask& mask, const WetShares<Real>& from, WetShares<Real>& to)
{
    to.film = select(mask, from.film, to.film);
    to.crack = select(mask, from.crack, to.crack);
    to.puddle = select(mask, from.puddle, to.puddle);
    to.all.mean = select(mask, from.all.mean, to.all.mean);
    to.all.end = select(mask, from.all.end, to.all.end);
}

// What the shares of a step depend on.
template <class Real>
struct Wetness {
    Real film, film_cover, film_liquid, crack_level, puddle_level;
    Real supply, infiltration;  // kg/m2 and mm of the step
    MaskOf<Real> covered;       // by snow: all of it evaporates
    bool any_water, any_hollow;
    const CellConstants* k;
    const PartConstants* part;

    using Shares = WetShares<Real>;
    PETRICHOR_INLINE void share(const Real& potential_rate, Shares& out) const
    {
        if (any_water) return share_of_water(potential_rate, out);
        const Real zero = 0.0;
        out.film = out.crack = out.puddle = zero;
        out.all.mean = out.all.end = select(covered, Real(1.0), zero);
    }
    PETRICHOR_KERNEL void share_of_water(const Real& potential_rate, Shares& s) const
    {
        const Real zero = 0.0, one = 1.0;
        const Real potential = larger(potential_rate * part->dt_s, zero);
        WetShare<Real> crack{zero, zero}, puddle{zero, zero};
        if (any_hollow)
            puddle = area_while_falling(k->surface.puddles, puddle_level, potential, infiltration);
        const Real open = one - puddle.mean;
        const auto pore =
            cover_while_drying(film, film_cover, film_liquid, supply, potential * open, k->film,
                               part->film);
        // The film hides what lies in the cracks below it.
        const Real bare = open * (one - pore.mean) * kCrackExposure;
        if (any_hollow)
            crack =
                area_while_falling(k->surface.cracks, crack_level, potential * bare, infiltration);
        s.film = pore.mean;
        s.crack = crack.mean;
        s.puddle = puddle.mean;
        s.all.mean = puddle.mean + open * pore.mean + bare * crack.mean;
        s.all.end = puddle.end +
                    (one - puddle.end) * (pore.end + (one - pore.end) * kCrackExposure * crack.end);
        s.all.mean = select(covered, one, s.all.mean);
        s.all.end = select(covered, one, s.all.end);
    }
};

//   supply        rain of the step, kg/m2
//   infiltration  depth that open ground takes up, mm
template <class Real, class Mask>
PETRICHOR_INLINE void set_wetness(Wetness<Real>& w, const CellVars<Real>& c, const Real& supply,
                                  const Real& infiltration, const Mask& covered,
                                  const CellConstants& k, const PartConstants& part)
{
    const Real zero = 0.0;
    w.k = &k;
    w.part = &part;
    w.covered = covered;
    w.film = c.film + c.film_ice;
    w.film_liquid = c.film;
    w.supply = supply;
    w.infiltration = infiltration;
    const Real crack = c.crack + c.crack_ice;
    const Real puddle = c.puddle + c.puddle_ice;
    w.any_hollow = any((crack + puddle > zero) & !covered);
    w.any_water = w.any_hollow || any((w.film + supply > zero) & !covered);
    w.film_cover = film_cover_of(w.film, k.film.inverse_full);
    if (w.any_hollow) {
        w.crack_level = level_of(k.surface.cracks, crack);
        w.puddle_level = level_of(k.surface.puddles, puddle);
    }
}

}  // namespace petrichor::weather::detail

#endif
