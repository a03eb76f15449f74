// One substep of one cell, or of eight side by side: the surface point, its balance, and where the
// heat and the water go.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_SUBSTEP_KERNEL_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_SUBSTEP_KERNEL_H

#include "weather/physics/cell_state.h"
#include "weather/physics/detail/brine_kernel.h"
#include "weather/physics/detail/cell_constants.h"
#include "weather/physics/detail/cell_weather.h"
#include "weather/physics/detail/ground_kernel.h"
#include "weather/physics/detail/melting_kernel.h"
#include "weather/physics/detail/slush_kernel.h"
#include "weather/physics/detail/snow_kernel.h"
#include "weather/physics/detail/surface_kernel.h"
#include "weather/physics/detail/water_kernel.h"
#include "weather/physics/detail/wetness_kernel.h"

namespace petrichor::weather::detail {

// dt seconds with constant weather, `share` of the step, whose means it adds to. `rain`, `snow` in
// kg m-2 s-1; `resistivity` (1 / conductivity) of the snow layers. Returns the share of the step at
// the melting point, receiving heat.
template <class Real>
PETRICHOR_KERNEL Real advance_substep(CellVars<Real>& c, const CellWeather<Real>& w,
                                      const Real& rain, const Real& snow, const Real* resistivity,
                                      const CellConstants& k, const PartConstants& part,
                                      double share)
{
    const Real zero = 0.0;
    const double dt = part.dt_s;
    const GroundStack& ground = part.ground;
    const Real rain_mass = rain * dt;

    // ---- snowfall, then the column below the surface as a conductance
    if (any(snow > zero)) add_snowfall(c, snow * dt, w.air_c, w.wind, k);
    freeze_within(c);
    const Real pack = c.snow_ice[0] + c.snow_ice[1] + c.snow_ice[2];
    const auto covered = pack > zero;
    Real ground_equivalents[kGroundLayers];
    const Real ground_seen =
        ground_equivalent(ground, c.ground_temp_c,
                          k.surface.open_below ? w.air_c : Real(k.deep_temp_c), ground_equivalents);
    Real conductance = ground.conductance_w_m2_k;
    Real below_c = ground_seen;
    SnowColumn<Real> column;
    const bool any_snow = any(covered);
    Real cover = zero;
    if (any_snow) {
        snow_equivalent(c, resistivity, part.inverse_dt_1_s, conductance, below_c, column);
        const Real depth = c.snow_thickness[0] + c.snow_thickness[1] + c.snow_thickness[2];
        cover = hyperbolic_tangent_positive(depth * k.inverse_cover_depth);
    }

    // ---- the surface point
    const Real liquid = c.film + c.crack + c.puddle;
    const Real ice = c.film_ice + c.crack_ice + c.puddle_ice;
    const auto bare_icy = (ice > liquid) | ((liquid <= zero) & (c.surface_temp_c < zero));
    const MaskOf<Real> icy = covered | bare_icy;

    SurfacePoint<Real, MaskOf<Real>, Wetness<Real>> p;
    Real soaking = zero;
    if (k.permeable)
        soaking = select(
            liquid + rain_mass > zero,
            infiltration_depth(c.infiltration_mm_h, part.horton, k.surface.infiltration), zero);
    set_wetness(p.wet, c, rain_mass, soaking, covered, k, part);
    const Real film_share = smaller(p.wet.film * k.inverse_film_capacity, Real(1.0));
    const Real bare_albedo = film_share * (k.albedo_wet - k.albedo_dry) + k.albedo_dry;
    const Real albedo = bare_albedo + cover * (c.snow_albedo - bare_albedo);
    const Real emissivity = cover * (k.snow_emissivity - k.emissivity) + k.emissivity;
    const Real taken_up = 1.0 - albedo * w.reflecting;
    const Real absorbed_sw = taken_up * w.shortwave;
    // Traffic warms the road, not the snow that lies on it.
    const Real given = absorbed_sw + (1.0 - cover) * k.surface.traffic_heat_w_m2;
    p.absorbed = given + emissivity * w.longwave;
    p.emitting = emissivity * kStefanBoltzmann;
    p.air_c = w.air_c;
    p.q_air = w.q_air;
    p.pressure = w.pressure;
    Real neutral = k.neutral_bare;
    if (any_snow) {
        const Real log_z0 = cover * (k.log_snow_roughness - k.log_roughness) + k.log_roughness;
        neutral = neutral_exchange_of<Real>(
            k.log_wind_height - log_z0,
            k.log_temp_height_10 - (log_z0 + (1.0 - cover) * k.heat_roughness));
    }
    p.exchange = w.density * neutral * w.wind;
    p.of_leaves = k.leaf_exchange > 0.0 ? (1.0 - cover) * k.leaf_exchange * square_root(w.wind) : zero;
    p.richardson_k = richardson_per_k_of(w.per_air_wind2, k.wind_height_m) * w.gravity_across;
    p.upright = w.upright;
    p.convection = cover * (k.convection_snow - k.convection_bare) + k.convection_bare;
    p.icy = icy;
    p.latent_heat = select(icy, Real(kLatentSublimation), Real(kLatentVaporisation));
    p.rain_heat = rain * (k.exchange.rain_heat * kWaterHeatCapacity);
    p.conductance = conductance;
    p.below_c = below_c;
    // No more can leave than is there.
    p.most_vapour =
        select(covered, pack, select(bare_icy, ice, liquid + rain_mass)) * part.inverse_dt_1_s;

    // ---- its temperature: three Newton steps, then the melting point if something changes phase
    SurfaceRoot<Real, Wetness<Real>> root;
    surface_root(p, k.exchange, c.surface_temp_c, root);
    // The balance is that of the middle of the weather; until the end it still changes by this.
    const Real later = taken_up * w.later_shortwave + emissivity * w.later_longwave +
                       root.exchange * (kAirHeatCapacity * w.later_air_k +
                                        p.latent_heat * root.wet.shares.all.end * w.later_q) -
                       root.turbulent * w.later_wind;
    PhaseStores<Real> stores;
    stores.ice = select(covered, pack, ice);
    stores.water = select(covered, zero, liquid + rain_mass);
    stores.may_melt = covered | (ice > zero);
    stores.may_freeze = stores.water > zero;
    // Salted ground has no point at which it melts: brine and ice share a range of temperatures.
    const auto salted = c.salt > zero;
    const bool any_salt = any(salted);
    const MaskOf<Real> salted_bare = salted & !covered, salted_snow = salted & covered;
    if (any_salt) {
        stores.may_melt = stores.may_melt & (covered | !salted);
        stores.may_freeze = stores.may_freeze & !salted;
    }
    PhaseChange<Real> change = change_phase(p, k.exchange, stores, later, dt, root);
    if (any_salt) {
        const BrineStores<Real> brine{c.salt, stores.water, stores.water + ice};
        change_brine(p, brine, salted_bare, dt, root, change);
    }
    const auto f = fluxes_at(p, root);
    const Real surface_c = root.surface_c;
    c.surface_temp_c = end_temperature(stores, change, surface_c, later, f.slope);
    if (any_salt) {
        // Brine goes on holding: what it changed is not undone at the end.
        c.surface_temp_c = select(salted_bare, surface_c + later / f.slope, c.surface_temp_c);
    }
    const Real residual = f.balance - change.melt_flux;

    // ---- new temperatures below
    Real interface_c = surface_c;
    if (any_snow) snow_temperatures(c, column, interface_c);

    // ---- masses
    const Real vapour_mass = f.vapour * dt;
    const Real melt_mass = change.melt_flux * (dt / kLatentFusion);
    Real to_film = rain_mass;
    if (any_snow) {
        Real runoff = snow_masses(c, select(covered, vapour_mass, zero),
                                  select(covered, larger(melt_mass, zero), zero),
                                  select(covered, rain_mass, zero), snow <= zero, k);
        runoff += melted_by_ground(c, covered, ground.conductance_w_m2_k, dt, interface_c);
        if (any_salt) {
            const BrineStores<Real> brine{c.salt, c.film + c.crack + c.puddle,
                                          c.film + c.crack + c.puddle + c.film_ice + pack};
            runoff +=
                changed_by_salt(c, salted_snow, brine, ground.conductance_w_m2_k, dt, interface_c);
        }
        const MaskOf<Real> changes_below = covered & !salted &
                                           (((c.film > zero) & (interface_c < zero)) |
                                            ((c.film_ice > zero) & (interface_c > zero)));
        if (any(changes_below))
            change_below(c, changes_below, ground.conductance_w_m2_k, dt, interface_c);
        if (part.cleared > 0.0) c.total_drainage += clear_snow(c, part.cleared);
        to_film = select(covered, runoff, rain_mass);
        c.total_sublimation += select(covered, vapour_mass, zero);
        c.step_runoff += select(covered, runoff, zero);
    }
    ground_update(ground, interface_c, ground_equivalents, c.ground_temp_c);
    c.total_melt += larger(melt_mass, zero);
    const bool holds_slush = any_snow && part.film_in_snow.rate_1_s != part.film.rate_1_s;
    const Real slush = holds_slush ? select(covered, slush_limit(c), zero) : zero;
    const Real gone_before = c.total_drainage + c.total_infiltration;
    move_water(c, to_film, select(covered, zero, vapour_mass), select(covered, zero, melt_mass),
               bare_icy, slush, root.wet.shares, k, part);
    if (any_salt)
        carry_salt(c, (c.total_drainage + c.total_infiltration) - gone_before, part.salt_kept);

    c.flux_shortwave += absorbed_sw * share;
    c.flux_longwave += (f.net_radiation - given) * share;
    c.flux_sensible += f.sensible * share;
    c.flux_latent += f.latent * share;
    c.flux_ground += f.ground * share;
    c.flux_melt += change.melt_flux * share;
    c.flux_residual += residual * share;
    c.energy_residual_squares += residual * residual * dt;
    c.energy_seconds += Real(dt);
    return change.melting * share;
}

}  // namespace petrichor::weather::detail

#endif
