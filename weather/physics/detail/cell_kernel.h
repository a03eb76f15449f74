// One step of one cell, or of eight cells side by side: the physical model itself.
//
//   precipitation -> snow pack or film
//   surface energy balance, coupled implicitly to snow and ground below it
//   melt, refreezing, percolation through the pack -> film
//   film -> (infiltration) -> cracks -> (infiltration) -> puddles -> drainage, evaporation,
//   freezing
//
// Written without branches on the state, so that it means the same for double and for Lanes; `if
// (any(..))` only skips work that would change nothing.
#ifndef PETRICHOR_WEATHER_DETAIL_CELL_KERNEL_H
#define PETRICHOR_WEATHER_DETAIL_CELL_KERNEL_H

#include "weather/physics/cell_state.h"
#include "weather/physics/detail/cell_constants.h"
#include "weather/physics/detail/ground_kernel.h"
#include "weather/physics/detail/reservoir.h"
#include "weather/physics/detail/snow_kernel.h"
#include "weather/physics/detail/step_forcing.h"
#include "weather/physics/detail/surface_kernel.h"
#include "weather/physics/detail/water_kernel.h"

namespace petrichor::weather::detail {

// What distinguishes a cell from the station. Lanes or one number.
template <class Real>
struct CellPlace {
    Real height_difference_m;  // above the station
    Real pressure_factor;      // standard pressure here over that at the station
    Real sky_view;
    Real normal_east, normal_north, normal_up;
    Real air_offset_k;  // perturbations: added to air temperature
    Real precip_factor, wind_factor, shortwave_factor, longwave_offset;
};

// What the weather of a step means for a cell, before it is asked for an instant.
template <class Real>
struct StepWeather {
    Real shift_k;                 // air here over air at the station
    Real light;                   // shortwave here over shortwave on flat open ground
    SaturationCurve<Real> curve;  // of the air, about the middle of the step
};
template <class Real>
PETRICHOR_INLINE Real shift_of(const CellPlace<Real>& place)
{
    return place.air_offset_k - place.height_difference_m * kLapseRate_k_m;
}
template <class Real>
PETRICHOR_INLINE StepWeather<Real> weather_of(const StepForcing& step, const CellPlace<Real>& place)
{
    StepWeather<Real> w;
    w.shift_k = shift_of(place);
    w.curve = water_curve(w.shift_k + step.air_c.at(0.5));
    // Sun on a slope: the direct beam by its angle, the rest by the share of the sky; hidden sky
    // gives back a fifth. On flat open ground this is exactly 1, wherever the sun is.
    Real light = place.sky_view + (1.0 - place.sky_view) * 0.2;
    if (step.sun_up > 0.05) {
        const Real facing =
            larger(place.normal_east * step.sun_east + place.normal_north * step.sun_north +
                       place.normal_up * step.sun_up,
                   Real(0.0));
        light += (facing / step.sun_up - place.sky_view) * (1.0 - step.diffuse);
    }
    w.light = light * place.shortwave_factor;
    return w;
}

// The weather at one instant at the cell.
template <class Real>
struct CellWeather {
    Real air_c, q_air, density, pressure, wind, shortwave, longwave;
    Real per_air_wind2;  // 1 / (T U^2), of the Richardson number
};

//   x  0..1, from the beginning to the end of the step
template <class Real>
PETRICHOR_INLINE CellWeather<Real> weather_at(const StepWeather<Real>& day, const StepForcing& step,
                                              const CellPlace<Real>& place, double x,
                                              double least_wind)
{
    CellWeather<Real> w;
    const double station_c = step.air_c.at(x);
    w.air_c = day.shift_k + station_c;
    w.pressure = place.pressure_factor * step.pressure.at(x);
    w.wind = larger(place.wind_factor * step.wind.at(x), Real(least_wind));
    // How far the air is from the middle of the step is the same everywhere.
    const double from_middle = station_c - step.air_c.at(0.5);
    Real saturation = day.curve.pressure_pa;
    if (from_middle > kCurveReach_k || from_middle < -kCurveReach_k)
        saturation = saturation_water_pa(w.air_c);
    else if (from_middle != 0.0)
        saturation = point_of(day.curve, w.air_c).pressure_pa;
    const Real vapour = saturation * (0.01 * step.rh_pct.at(x));

    // q = 0.622 e / D with D = P - 0.378 e, density = P / (R T (1 + 0.608 q)) and 1 / (T U^2): one
    // division.
    const Real air_k = w.air_c + kZeroCelsiusK;
    const Real dry = w.pressure - vapour * (1.0 - kWaterToAirMass);
    const Real moist = dry + vapour * (0.608 * kWaterToAirMass);
    const Real wind2 = w.wind * w.wind;
    const Real warm = air_k * moist;
    const Real inverse = 1.0 / (dry * warm * wind2);
    w.q_air = vapour * kWaterToAirMass * (warm * wind2 * inverse);
    const Real dry_wind2 = dry * wind2 * inverse;  // 1 / (T moist)
    w.density = w.pressure * dry * dry_wind2 * (1.0 / kAirGasConstant);
    w.per_air_wind2 = dry * moist * inverse;

    w.shortwave = day.light * larger(step.shortwave.at(x), 0.0);
    // The sky keeps its emissivity when the air is colder or warmer; hidden sky radiates like the
    // air.
    const Real ratio = air_k * (1.0 / (station_c + kZeroCelsiusK));
    const Real ratio2 = ratio * ratio;
    const Real squared = air_k * air_k;
    w.longwave = place.sky_view * (ratio2 * ratio2 * step.longwave.at(x) + place.longwave_offset) +
                 (1.0 - place.sky_view) * (squared * squared * kStefanBoltzmann);
    return w;
}

// Snow share of the step's precipitation at the cell.
template <class Real>
PETRICHOR_KERNEL Real snow_share_at(const StepForcing& step, const CellPlace<Real>& place,
                                    const PhaseParams& phase)
{
    const Real shift = shift_of(place);
    const Real air_c = shift + step.air_c.at(0.5);
    const double rh = step.rh_pct.at(0.5);
    Real share = 0.0;
    switch (phase.law) {
        case PhaseLaw::Linear:
            share = unit_clamped(((phase.all_rain_k - kZeroCelsiusK) - air_c) *
                                 (1.0 / (phase.all_rain_k - phase.all_snow_k)));
            break;
        case PhaseLaw::Humidity:
            share = snow_fraction_humidity_of(air_c, Real(rh));
            break;
        case PhaseLaw::WetBulb:
            share = snow_fraction_wet_bulb_of(
                wet_bulb_c_of(air_c, saturation_water_pa(air_c) * (0.01 * rh),
                              place.pressure_factor * step.pressure.at(0.5)));
            break;
        case PhaseLaw::Threshold:
            share = select(air_c < phase.threshold_k - kZeroCelsiusK, Real(1.0), Real(0.0));
            break;
    }
    if (!step.phase_known) return share;
    // The file's word holds where the air is the file's air.
    return select((shift >= 0.0) & (shift <= 0.0), Real(step.snow_share), share);
}

// What a substep adds to the means of its step.
template <class Real>
struct StepSums {
    Real shortwave = 0.0, longwave = 0.0, sensible = 0.0, latent = 0.0, ground = 0.0, melt = 0.0;
    Real residual = 0.0, runoff = 0.0;
};

// Where the base of a pack would be above 0 C: melts it with the heat that the ground then gives,
// and lowers the base's temperature by what that takes. Returns the water that leaves.
template <class Real, class Mask>
PETRICHOR_INLINE Real melted_by_ground(CellVars<Real>& c, const Mask& covered, double conductance,
                                       double dt, Real& base_c)
{
    Real flow = 0.0;
    const Real warmth = select(covered, larger(base_c, Real(0.0)), Real(0.0));
    if (!any(warmth > 0.0)) return flow;
    const Real melted = melt_base(c, warmth * (conductance * dt / kLatentFusion), flow);
    base_c = base_c - melted * (kLatentFusion / (conductance * dt));
    c.total_melt += melted;
    return flow;
}

// dt seconds with constant weather. `rain`, `snow` in kg m-2 s-1; `resistivity` (1 / conductivity)
// of the snow layers.
template <class Real>
PETRICHOR_KERNEL void advance_substep(CellVars<Real>& c, const CellWeather<Real>& w,
                                      const Real& rain, const Real& snow, const Real* resistivity,
                                      const CellConstants& k, const PartConstants& part,
                                      StepSums<Real>& sums)
{
    const Real zero = 0.0;
    const double dt = part.dt_s;
    const GroundStack& ground = part.ground;
    const Real rain_mass = rain * dt;

    // ---- snowfall, then the column below the surface as a conductance
    if (any(snow > zero)) add_snowfall(c, snow * dt, w.air_c, w.wind, k);
    const Real ice_before = c.snow_ice[0] + c.snow_ice[1] + c.snow_ice[2];
    const auto covered = ice_before > zero;
    Real ground_equivalents[kGroundLayers];
    const Real ground_seen =
        ground_equivalent(ground, c.ground_temp_c, k.deep_temp_c, ground_equivalents);
    Real conductance = ground.conductance_w_m2_k;
    Real below_c = ground_seen;
    SnowColumn<Real> column;
    const bool any_snow = any(covered);
    Real cover = zero;
    if (any_snow) {
        snow_equivalent(c, resistivity, dt, conductance, below_c, column);
        const Real depth = c.snow_thickness[0] + c.snow_thickness[1] + c.snow_thickness[2];
        cover = hyperbolic_tangent_positive(depth * k.inverse_cover_depth);
    }

    // ---- the surface point
    const WetSurface<Real> wet = wet_surface(c, k, ice_before <= zero);
    const Real liquid = c.film + c.crack + c.puddle;
    const Real ice = c.film_ice + c.crack_ice + c.puddle_ice;
    const auto bare_icy = (ice > liquid) | ((liquid <= zero) & (c.surface_temp_c < zero));
    const MaskOf<Real> icy = covered | bare_icy;

    SurfacePoint<Real, MaskOf<Real>> p;
    const Real bare_albedo = wet.film_share * (k.albedo_wet - k.albedo_dry) + k.albedo_dry;
    const Real albedo = bare_albedo + cover * (c.snow_albedo - bare_albedo);
    const Real emissivity = cover * (k.snow_emissivity - k.emissivity) + k.emissivity;
    const Real absorbed_sw = (1.0 - albedo) * w.shortwave;
    p.absorbed = absorbed_sw + emissivity * w.longwave;
    p.emitting = emissivity * kStefanBoltzmann;
    p.air_c = w.air_c;
    p.q_air = w.q_air;
    p.pressure = w.pressure;
    p.neutral = Real(k.neutral_bare);
    if (any_snow) {
        const Real log_z0 = cover * (k.log_snow_roughness - k.log_roughness) + k.log_roughness;
        p.neutral = kVonKarman * kVonKarman /
                    ((k.log_wind_height - log_z0) * (k.log_temp_height_10 - log_z0));
    }
    p.exchange = w.density * p.neutral * w.wind;
    p.richardson_k = w.per_air_wind2 * (kGravity_m_s2 * k.wind_height_m);
    p.root_z = cover * (k.root_z_snow - k.root_z_bare) + k.root_z_bare;
    p.beta = select(covered, Real(1.0), wet.beta);
    p.icy = icy;
    p.latent_heat = select(icy, Real(kLatentSublimation), Real(kLatentVaporisation));
    p.rain_heat = rain * kWaterHeatCapacity;
    p.conductance = conductance;
    p.below_c = below_c;
    // No more can leave than is there.
    p.most_vapour = select(covered, ice_before, select(bare_icy, ice, liquid + rain_mass)) *
                    part.inverse_dt_1_s;

    // ---- its temperature: three Newton steps, then the melting point if something changes phase
    SurfaceRoot<Real> root = surface_root(p, k.exchange, c.surface_temp_c);
    Real surface_c = root.surface_c;
    const auto melts = (surface_c > zero) & (covered | (ice > zero));
    const auto freezes = (surface_c < zero) & (ice_before <= zero) & (liquid + rain_mass > zero);
    const auto pinned = melts | freezes;
    Real melt_flux = zero;
    if (any(pinned)) {
        const Real at_zero_exchange = exchange_at(p, k.exchange, zero);
        SurfaceVapour<Real> vapour = vapour_at_melting_point(root.vapour, p);
        const auto f0 = fluxes_at_middle(p, vapour, at_zero_exchange);
        const Real lost = larger(f0.vapour, zero) * dt;
        const Real meltable =
            larger(select(covered, ice_before - lost, select(bare_icy, ice - lost, ice)), zero);
        const Real freezable =
            larger(select(covered, zero, liquid + rain_mass - select(bare_icy, zero, lost)), zero);
        const Real most = meltable * (kLatentFusion / dt);
        const Real least = freezable * (-kLatentFusion / dt);
        const Real wanted = clamped(f0.balance, least, most);
        melt_flux = select(pinned, wanted, zero);
        root.exchange = select(pinned, at_zero_exchange, root.exchange);
        // What is left after the last ice or water has changed warms or cools the surface.
        Real after = zero;
        const auto partly = pinned & ((wanted > f0.balance) | (wanted < f0.balance));
        if (any(partly)) {
            after = select(partly, (f0.balance - wanted) / f0.slope, zero);
            for (int i = 0; i < 2; ++i) {
                follow(vapour, p, after);
                const auto f = fluxes_at(p, vapour, after, root.exchange);
                after = select(partly, after + (f.balance - wanted) / f.slope, after);
            }
            follow(vapour, p, after);
        }
        surface_c = select(pinned, after, surface_c);
        root.vapour = chosen(pinned, vapour, root.vapour);
    }
    const auto f = fluxes_at(p, root.vapour, surface_c, root.exchange);
    c.surface_temp_c = surface_c;
    const Real residual = f.balance - melt_flux;

    // ---- new temperatures below
    Real interface_c = surface_c;
    if (any_snow) snow_temperatures(c, column, interface_c);

    // ---- masses
    const Real vapour_mass = f.vapour * dt;
    const Real melt_mass = melt_flux * (dt / kLatentFusion);
    Real to_film = rain_mass;
    if (any_snow) {
        Real runoff = snow_masses(c, select(covered, vapour_mass, zero),
                                  select(covered, larger(melt_mass, zero), zero),
                                  select(covered, rain_mass, zero), snow <= zero, k);
        runoff += melted_by_ground(c, covered, ground.conductance_w_m2_k, dt, interface_c);
        to_film = select(covered, runoff, rain_mass);
        c.total_sublimation += select(covered, vapour_mass, zero);
        sums.runoff += select(covered, runoff, zero);
    }
    ground_update(ground, interface_c, ground_equivalents, c.ground_temp_c);
    c.total_melt += larger(melt_mass, zero);
    move_water(c, to_film, select(covered, zero, vapour_mass), select(covered, zero, melt_mass),
               bare_icy, wet, k, part);

    sums.shortwave += absorbed_sw * dt;
    sums.longwave += (f.net_radiation - absorbed_sw) * dt;
    sums.sensible += f.sensible * dt;
    sums.latent += f.latent * dt;
    sums.ground += f.ground * dt;
    sums.melt += melt_flux * dt;
    sums.residual += residual * dt;
    c.energy_residual_squares += residual * residual * dt;
    c.energy_seconds += Real(dt);
}

template <class Real>
PETRICHOR_INLINE Real all_stores(const CellVars<Real>& c)
{
    Real sum = 0.0;
    for (std::size_t i = 0; i < kSnowLayers; ++i) sum += c.snow_ice[i] + c.snow_liquid[i];
    return sum + (c.film + c.crack + c.puddle) + (c.film_ice + c.crack_ice + c.puddle_ice);
}

// Frozen share of all water on the surface; where there is next to none, that of what is falling,
// else what it was.
template <class Real>
PETRICHOR_INLINE void update_frozen_fraction(CellVars<Real>& c, const Real& precip,
                                             const Real& snow)
{
    Real frozen = c.film_ice + c.crack_ice + c.puddle_ice;
    for (std::size_t i = 0; i < kSnowLayers; ++i) frozen += c.snow_ice[i];
    const Real all = all_stores(c);
    const Real falling =
        select(precip > 0.0, snow / larger(precip, Real(1e-30)), c.frozen_fraction);
    c.frozen_fraction =
        unit_clamped(select(all < 0.01, falling, frozen / larger(all, Real(1e-30))));
}

// One model step for one cell, `parts` substeps of equal length.
template <class Real>
PETRICHOR_KERNEL void advance_parts(CellVars<Real>& c, const StepForcing& step,
                                    const CellPlace<Real>& place, const Real& rain,
                                    const Real& snow, const Real* resistivity,
                                    const CellConstants& k, const PartConstants& part, int parts)
{
    StepSums<Real> sums;
    const StepWeather<Real> day = weather_of(step, place);
    for (int i = 0; i < parts; ++i) {
        const double x = (i + 0.5) / parts;
        const auto w = weather_at(day, step, place, x, k.least_wind);
        advance_substep(c, w, rain, snow, resistivity, k, part, sums);
    }
    const double inverse = 1.0 / step.dt_s;
    c.flux_shortwave = sums.shortwave * inverse;
    c.flux_longwave = sums.longwave * inverse;
    c.flux_sensible = sums.sensible * inverse;
    c.flux_latent = sums.latent * inverse;
    c.flux_ground = sums.ground * inverse;
    c.flux_melt = sums.melt * inverse;
    c.flux_residual = sums.residual * inverse;
    c.step_runoff = sums.runoff;
}

template <class Real, class Mask>
PETRICHOR_KERNEL void blend(CellVars<Real>& c, const CellVars<Real>& other, const Mask& take)
{
    auto* to = reinterpret_cast<Real*>(&c);
    const auto* from = reinterpret_cast<const Real*>(&other);
    for (std::size_t i = 0; i < kCellNumbers; ++i) to[i] = select(take, from[i], to[i]);
}

template <class Real>
PETRICHOR_INLINE void advance_step(CellVars<Real>& c, const StepForcing& step,
                                   const CellPlace<Real>& place, const CellConstants& k,
                                   const StepConstants& s)
{
    const Real zero = 0.0;
    const Real before = all_stores(c);
    const Real out_before =
        c.total_evaporation + c.total_sublimation + c.total_drainage + c.total_infiltration;
    Real rain = zero, snow = zero;
    if (step.precip > 0.0) {
        const Real share = snow_share_at(step, place, k.phase);
        const Real precip = place.precip_factor * step.precip;
        snow = precip * share;
        rain = precip - snow;
    }

    // ---- slow changes of the pack, once a step
    const Real pack = c.snow_ice[0] + c.snow_ice[1] + c.snow_ice[2];
    Real resistivity[kSnowLayers] = {zero, zero, zero};
    if (any(pack > zero) || any(snow > zero)) {
        const Real mid_c = shift_of(place) + step.air_c.at(0.5);
        const Real mid_wind = larger(place.wind_factor * step.wind.at(0.5), Real(k.least_wind));
        age_snow(c, snow * step.dt_s, new_snow_density_of(k, mid_c, mid_wind), k, s, step.dt_s,
                 resistivity);
    } else {
        c.snow_albedo = Real(k.snow.albedo_max);
    }

    // ---- fast changes, in substeps where water is about or the surface is near 0 C
    const auto bare = pack <= zero;
    const auto near_zero = (c.surface_temp_c > -1.0) & (c.surface_temp_c < 1.0);
    const auto wet = bare & ((c.film + c.puddle > 1e-9) | (rain > zero) | (snow > zero));
    // Dry bare ground has nothing that could freeze or melt.
    const auto changes = (pack > zero) | (c.film_ice + c.crack_ice + c.puddle_ice + c.crack > zero);
    const auto fine = (near_zero & changes) | wet;
    const auto plain = !fine;
    const bool any_fine = any(fine);
    const bool any_plain = any(plain);
    if (s.parts <= 1 || !any_fine) {
        advance_parts(c, step, place, rain, snow, resistivity, k, s.whole, 1);
    } else if (!any_plain) {
        advance_parts(c, step, place, rain, snow, resistivity, k, s.part, s.parts);
    } else {
        CellVars<Real> other = c;
        advance_parts(other, step, place, rain, snow, resistivity, k, s.whole, 1);
        advance_parts(c, step, place, rain, snow, resistivity, k, s.part, s.parts);
        blend(c, other, plain);
    }

    // ---- the books
    c.step_rain = rain * step.dt_s;
    c.step_snow = snow * step.dt_s;
    c.total_precip += c.step_rain + c.step_snow;
    const Real out =
        (c.total_evaporation + c.total_sublimation + c.total_drainage + c.total_infiltration) -
        out_before;
    const Real residual = (all_stores(c) - before) - ((c.step_rain + c.step_snow) - out);
    c.mass_residual = residual;
    c.mass_residual_most = larger(c.mass_residual_most, larger(residual, residual * -1.0));
    update_frozen_fraction(c, rain + snow, snow);
}

}  // namespace petrichor::weather::detail

#endif
