// One step of one cell, or of eight cells side by side: the physical model itself.
//
//   precipitation -> (canopy) -> snow pack or film
//   surface energy balance, coupled implicitly to snow and ground below it
//   melt, refreezing, percolation through the pack -> film
//   film -> (infiltration) -> cracks -> (infiltration) -> puddles -> drainage, evaporation,
//   freezing
//
// Written without branches on the state, so that it means the same for double and for Lanes; `if
// (any(..))` only skips work that would change nothing.
//
// One balance serves the step: wet shares, melt and the temperature at its end are exact over the
// line along which the weather changes. Only a thin pack that comes or goes, which turns one
// surface into another, is followed in substeps.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_CELL_KERNEL_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_CELL_KERNEL_H

#include "weather/physics/cell_state.h"
#include "weather/physics/detail/canopy_kernel.h"
#include "weather/physics/detail/cell_constants.h"
#include "weather/physics/detail/cell_weather.h"
#include "weather/physics/detail/snow_kernel.h"
#include "weather/physics/detail/step_forcing.h"
#include "weather/physics/detail/substep_kernel.h"

namespace petrichor::weather::detail {

// A pack that can melt away within hours, kg/m2, and how near to melting it is.
constexpr double kThinPack_kg_m2 = 30.0;
constexpr double kNearMelting_k = 2.0;
constexpr double kUnusedDensity_kg_m3 = 100.0;  // of snow that does not come

template <class Real>
PETRICHOR_INLINE Real surface_stores(const CellVars<Real>& c)
{
    Real sum = 0.0;
    for (std::size_t i = 0; i < kSnowLayers; ++i) sum += c.snow_ice[i] + c.snow_liquid[i];
    return sum + (c.film + c.crack + c.puddle) + (c.film_ice + c.crack_ice + c.puddle_ice);
}
// Frozen share of all water on the surface; where there is next to none, that of what is falling,
// else what it was.
//   all  water on the surface
template <class Real>
PETRICHOR_INLINE void update_frozen_fraction(CellVars<Real>& c, const Real& all, const Real& precip,
                                             const Real& snow)
{
    Real frozen = c.film_ice + c.crack_ice + c.puddle_ice;
    for (std::size_t i = 0; i < kSnowLayers; ++i) frozen += c.snow_ice[i];
    Real falling = c.frozen_fraction;
    const auto falls = precip > 0.0;
    if (any(falls)) falling = select(falls, snow / larger(precip, Real(1e-30)), falling);
    c.frozen_fraction =
        unit_clamped(select(all < 0.01, falling, frozen / larger(all, Real(1e-30))));
}

// Vehicles stir the air above a road, fewer of them by night.
inline double least_wind_at(const StationMoment& m, const CellConstants& k)
{
    return m.shortwave > 0.0 ? k.least_wind : k.least_wind_by_night;
}

// One model step for one cell, `parts` substeps of equal length.
template <class Real>
PETRICHOR_KERNEL void advance_parts(CellVars<Real>& c, const StepForcing& step,
                                    const CellPlace<Real>& place, const Real& rain,
                                    const Real& snow, const Real* resistivity,
                                    const CellConstants& k, const StepConstants& s,
                                    const PartConstants& part, int parts)
{
    const Real zero = 0.0;
    StepWeather<Real> day;
    weather_of(step, place, day);
    for (Real* mean : {&c.flux_shortwave, &c.flux_longwave, &c.flux_sensible, &c.flux_latent,
                       &c.flux_ground, &c.flux_melt, &c.flux_residual, &c.step_runoff})
        *mean = zero;
    Real melting = zero;
    const double share = 1.0 / parts;
    CellWeather<Real> w;
    for (int i = 0; i < parts; ++i) {
        const auto at = [&](const StationMoment& m) {
            weather_at(day, m, place, least_wind_at(m, k), w);
        };
        if (parts == 1)
            at(step.middle);
        else
            at(moment_of(step, (i + 0.5) / parts, (i + 1.0) / parts));
        melting += advance_substep(c, w, rain, snow, resistivity, k, part, share);
    }
    age_albedo(c, melting, k, s);
}

template <class Real, class Mask>
PETRICHOR_KERNEL void blend(CellVars<Real>& c, const CellVars<Real>& other, const Mask& take)
{
    auto* to = reinterpret_cast<Real*>(&c);
    const auto* from = reinterpret_cast<const Real*>(&other);
    for (std::size_t i = 0; i < kCellNumbers; ++i) to[i] = select(take, from[i], to[i]);
}

// Water of a cell: what it holds, and what has left it.
template <class Real>
struct Books {
    Real on_surface, held, left;
};
template <class Real>
PETRICHOR_INLINE void read_books(const CellVars<Real>& c, Books<Real>& books)
{
    books.on_surface = surface_stores(c);
    books.held = books.on_surface + c.canopy_snow;
    books.left =
        (c.total_evaporation + c.total_sublimation) + (c.total_drainage + c.total_infiltration);
}

//   books  of the cell before the step, and then after it
template <class Real>
PETRICHOR_INLINE void advance_step(CellVars<Real>& c, const StepForcing& step,
                                   const CellPlace<Real>& place, const CellConstants& k,
                                   const StepConstants& s, Books<Real>& books)
{
    const Real zero = 0.0;
    Real rain = zero, snow = zero;
    if (step.precip > 0.0) {
        const Real share = snow_share_at(step, place, k.phase);
        const Real precip = place.precip_factor * step.precip;
        const Real frozen = precip * share;
        snow = frozen * place.snow_factor;
        rain = (precip - frozen) * place.rain_factor;
    }
    const Real snow_above = snow;
    if (k.canopy_capacity > 0.0) {
        const Real mid_c = shift_of(place) + step.air_c.at(0.5);
        snow = through_canopy(c.canopy_snow, snow * step.dt_s, mid_c, k.canopy_capacity,
                              s.unloading_cold, s.unloading_melting) *
               (1.0 / step.dt_s);
    }

    // ---- slow changes of the pack, once a step
    const Real pack = c.snow_ice[0] + c.snow_ice[1] + c.snow_ice[2];
    Real resistivity[kSnowLayers] = {zero, zero, zero};
    if (any(pack > zero) || any(snow > zero)) {
        Real new_density = kUnusedDensity_kg_m3;
        if (any(snow > zero)) {
            const Real mid_c = shift_of(place) + step.air_c.at(0.5);
            const Real mid_wind =
                larger(place.wind_factor * step.wind.at(0.5), Real(least_wind_at(step.middle, k)));
            new_density = select(snow > zero, new_snow_density_of(k, mid_c, mid_wind), new_density);
        }
        age_snow(c, snow * step.dt_s, new_density, k, s, step.dt_s, resistivity);
    }

    // ---- fast changes, in substeps where a thin pack comes or goes
    const auto comes = (pack <= zero) & (snow > zero);
    const auto goes =
        (pack > zero) & (pack < kThinPack_kg_m2) & (c.surface_temp_c > -kNearMelting_k);
    const auto fine = comes | goes;
    const bool all_alike = s.parts == s.whole_parts;
    if (all_alike || !any(fine)) {
        advance_parts(c, step, place, rain, snow, resistivity, k, s, s.whole, s.whole_parts);
    } else if (!any(!fine)) {
        advance_parts(c, step, place, rain, snow, resistivity, k, s, s.part, s.parts);
    } else {
        CellVars<Real> other = c;
        advance_parts(other, step, place, rain, snow, resistivity, k, s, s.whole, s.whole_parts);
        advance_parts(c, step, place, rain, snow, resistivity, k, s, s.part, s.parts);
        blend(c, other, !fine);
    }

    // ---- the books
    const Books<Real> before = books;
    read_books(c, books);
    c.step_rain = rain * step.dt_s;
    c.step_snow = snow_above * step.dt_s;
    const Real fallen = c.step_rain + c.step_snow;
    c.total_precip += fallen;
    const Real residual = (books.held - before.held) - (fallen - (books.left - before.left));
    c.mass_residual = residual;
    c.mass_residual_most = larger(c.mass_residual_most, larger(residual, residual * -1.0));
    update_frozen_fraction(c, books.on_surface, rain + snow_above, snow_above);
}

// Steps of equal length, one after the other.
template <class Real>
PETRICHOR_INLINE void advance_steps(CellVars<Real>& c, const StepForcing* steps, std::size_t count,
                                    const CellPlace<Real>& place, const CellConstants& k,
                                    const StepConstants& s)
{
    Books<Real> books;
    read_books(c, books);
    for (std::size_t i = 0; i < count; ++i) advance_step(c, steps[i], place, k, s, books);
}

}  // namespace petrichor::weather::detail

#endif
