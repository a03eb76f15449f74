// The snow pack of the cell kernel: up to three layers, top first. A layer that is not there has no
// mass, no thickness, no resistance and no heat capacity, so it drops out of every formula by
// itself.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_SNOW_KERNEL_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_SNOW_KERNEL_H

#include "weather/physics/cell_state.h"
#include "weather/physics/detail/cell_constants.h"
#include "weather/physics/detail/formulas.h"
#include "weather/physics/detail/snow_laws.h"

namespace petrichor::weather::detail {

template <class Real>
PETRICHOR_INLINE Real new_snow_density_of(const CellConstants& k, const Real& air_c,
                                          const Real& wind)
{
    switch (k.snow.new_density) {
        case NewSnowDensity::HedstromPomeroy:
            return new_snow_density_hedstrom_of(air_c);
        case NewSnowDensity::Constant:
            return Real(k.snow.constant_density_kg_m3);
        case NewSnowDensity::Pahaut:
            break;
    }
    return new_snow_density_pahaut_of(air_c, wind) * k.snow.new_density_factor;
}

// New snow joins the top layer at the temperature of the air, at most 0 C.
template <class Real>
PETRICHOR_KERNEL void add_snowfall(CellVars<Real>& c, const Real& mass, const Real& air_c,
                                   const Real& wind, const CellConstants& k)
{
    const auto falls = mass > 0.0;
    const Real density = new_snow_density_of(k, air_c, wind);
    const Real capacity = c.snow_ice[0] * kIceHeatCapacity + c.snow_liquid[0] * kWaterHeatCapacity;
    const Real added = mass * kIceHeatCapacity;
    const Real temp = smaller(air_c, Real(0.0));
    const Real mixed =
        (capacity * c.snow_temp_c[0] + added * temp) / larger(capacity + added, Real(1e-30));
    c.snow_temp_c[0] = select(falls, mixed, c.snow_temp_c[0]);
    c.snow_ice[0] += mass;
    c.snow_thickness[0] += mass / density;
}

// A layer that holds water stays at the melting point while the water freezes: its heat of fusion
// counts as heat capacity over this range.
constexpr double kFreezingRange_k = 0.1;
template <class Real>
PETRICHOR_INLINE Real heat_capacity_of(const Real& ice, const Real& liquid)
{
    return ice * kIceHeatCapacity +
           liquid * (kWaterHeatCapacity + kLatentFusion / kFreezingRange_k);
}

// Water in a layer below the melting point, left by mixing, freezes as far as the cold goes.
template <class Real>
PETRICHOR_INLINE void freeze_within(CellVars<Real>& c)
{
    if (!any(c.snow_liquid[0] + c.snow_liquid[1] + c.snow_liquid[2] > 0.0)) return;
    for (std::size_t i = 0; i < kSnowLayers; ++i) {
        const auto both = (c.snow_liquid[i] > 0.0) & (c.snow_temp_c[i] < 0.0);
        if (!any(both)) continue;
        const Real capacity = c.snow_ice[i] * kIceHeatCapacity;
        const Real frozen = select(
            both, smaller(c.snow_liquid[i], capacity * c.snow_temp_c[i] * (-1.0 / kLatentFusion)),
            Real(0.0));
        c.snow_temp_c[i] = select(
            both,
            smaller(c.snow_temp_c[i] + frozen * kLatentFusion / larger(capacity, Real(1e-30)),
                    Real(0.0)),
            c.snow_temp_c[i]);
        c.snow_ice[i] += frozen;
        c.snow_liquid[i] = c.snow_liquid[i] - frozen;
    }
}

template <class Real>
struct SnowColumn {
    Real below[kSnowLayers], own[kSnowLayers], share_top[kSnowLayers], share_down[kSnowLayers];
};

// Adds the pack on top of the ground's conductance and equivalent temperature (ground.h), which are
// G and B below a layer of half resistance h and storage S:
//   share_down = 1 / a           a = 1 + G h
//   own        = (G B + S a T) / n   n = G + S a
//   share_top  = a / b           b = a + n h
//   conductance= n / b
template <class Real>
PETRICHOR_KERNEL void snow_equivalent(const CellVars<Real>& c, const Real* resistivity,
                                      double per_dt_1_s, Real& conductance, Real& equivalent_c,
                                      SnowColumn<Real>& column)
{
    for (std::size_t i = kSnowLayers; i-- > 0;) {
        column.below[i] = equivalent_c;
        const auto there = c.snow_ice[i] > 0.0;
        if (!any(there)) continue;
        const Real half = c.snow_thickness[i] * resistivity[i] * 0.5;
        const Real storage = heat_capacity_of(c.snow_ice[i], c.snow_liquid[i]) * per_dt_1_s;
        const Real a = conductance * half + 1.0;
        const Real held = storage * a;
        const Real n = conductance + held;
        const Real inverse_b = 1.0 / (n * half + a);
        const Real inverse_an = 1.0 / (a * n);
        column.share_down[i] = n * inverse_an;
        column.share_top[i] = a * inverse_b;
        column.own[i] = (conductance * equivalent_c + held * c.snow_temp_c[i]) * (a * inverse_an);
        equivalent_c = select(there, column.own[i], equivalent_c);
        conductance = select(there, n * inverse_b, conductance);
    }
}

// Layer temperatures from that of the surface; `interface_c` becomes that of the ground's surface.
template <class Real>
PETRICHOR_INLINE void snow_temperatures(CellVars<Real>& c, const SnowColumn<Real>& column,
                                        Real& interface_c)
{
    for (std::size_t i = 0; i < kSnowLayers; ++i) {
        const auto there = c.snow_ice[i] > 0.0;
        if (!any(there)) continue;
        const Real node = column.own[i] + (interface_c - column.own[i]) * column.share_top[i];
        const Real under = column.below[i] + (node - column.below[i]) * column.share_down[i];
        c.snow_temp_c[i] = select(there, node, c.snow_temp_c[i]);
        interface_c = select(there, under, interface_c);
    }
}

// Sublimation, melt, rain, refreezing and percolation; what leaves at the bottom.
template <class Real, class Mask>
PETRICHOR_KERNEL Real snow_masses(CellVars<Real>& c, const Real& vapour, const Real& melt,
                                  const Real& rain, const Mask& no_snowfall, const CellConstants& k)
{
    const Real zero = 0.0;
    Real to_air = larger(vapour, zero);
    Real to_melt = melt;
    Real flow = rain;
    for (std::size_t i = 0; i < kSnowLayers; ++i) {
        const Real ice = c.snow_ice[i];
        const auto there = ice > zero;
        // Water runs through a layer that is not there; a cold and dry one stays as it is.
        const auto wet = c.snow_liquid[i] + flow + to_melt + to_air > zero;
        if (!any(there & (wet | (c.snow_temp_c[i] > zero)))) continue;
        // What the layer gained or lost beyond the melting point changes its phase from within.
        const Real heat = heat_capacity_of(ice, c.snow_liquid[i]) * c.snow_temp_c[i];
        const Real own = ice * kIceHeatCapacity;
        const Real capacity = own + c.snow_liquid[i] * kWaterHeatCapacity;
        // The reference counts the cold of the ice alone.
        const Real per_all = 1.0 / larger(own * capacity, Real(1e-30));
        const Real per_own = capacity * per_all;
        const Real usable = heat * (own * own * per_all);
        const Real refrozen =
            smaller(c.snow_liquid[i], larger(usable * (-1.0 / kLatentFusion), zero));
        const auto holds = c.snow_liquid[i] > zero;
        Real temp = select(holds, smaller(usable + refrozen * kLatentFusion, zero) * per_own,
                           smaller(c.snow_temp_c[i], zero));
        const Real gone = smaller(ice, to_air);
        to_air = to_air - gone;
        Real left = ice - gone;
        const Real melted = smaller(left, to_melt);
        to_melt = to_melt - melted;
        left = left - melted;
        const Real inside = smaller(left, larger(heat, zero) * (1.0 / kLatentFusion));
        left = left - inside;
        c.snow_thickness[i] =
            select(left < ice, c.snow_thickness[i] * (left * (kIceHeatCapacity * per_own)),
                   c.snow_thickness[i]);
        left = left + refrozen;
        Real liquid = c.snow_liquid[i] - refrozen + melted + inside + flow;
        c.total_melt += inside;
        // Water that meets cold snow freezes, as far as the cold content goes.
        const Real cold = left * kIceHeatCapacity;
        const Real frozen = smaller(liquid, cold * temp * (-1.0 / kLatentFusion));
        const auto freezes = frozen > zero;
        if (any(freezes)) {
            const Real warmed = temp + frozen * kLatentFusion / larger(cold, Real(1e-30));
            temp = select(freezes, smaller(warmed, zero), temp);
            left = left + frozen;
            liquid = liquid - frozen;
        }
        const Real held = held_liquid_of(c.snow_thickness[i], left, k.snow.irreducible_water);
        flow = select(there, larger(liquid - held, zero), flow);
        c.snow_liquid[i] = select(there, liquid - flow, zero);
        c.snow_ice[i] = left;
        c.snow_temp_c[i] = select(left > zero, temp, zero);
    }
    // Frost grows on top, as dense as what it grows on.
    const Real frost = larger(vapour * -1.0, zero);
    const Real top = c.snow_ice[0];
    c.snow_thickness[0] =
        select(top > zero, c.snow_thickness[0] * ((top + frost) / larger(top, Real(1e-30))),
               c.snow_thickness[0]);
    c.snow_ice[0] += frost;
    // Vapour that found no ice (rounding of the limit) did not leave.
    c.total_sublimation -= to_air;
    const Real pack = c.snow_ice[0] + c.snow_ice[1] + c.snow_ice[2];
    const auto remnant = (pack < 0.01) & no_snowfall;
    if (any(remnant)) {
        for (std::size_t i = 0; i < kSnowLayers; ++i) {
            flow = select(remnant, flow + c.snow_ice[i] + c.snow_liquid[i], flow);
            c.snow_ice[i] = select(remnant, zero, c.snow_ice[i]);
            c.snow_liquid[i] = select(remnant, zero, c.snow_liquid[i]);
            c.snow_thickness[i] = select(remnant, zero, c.snow_thickness[i]);
            c.snow_temp_c[i] = select(remnant, zero, c.snow_temp_c[i]);
        }
    }
    return flow;
}

// Ice is never warmer than 0 C where it lies on the ground either: heat from below melts the pack
// from the last layer upwards, and the water leaves. Melts at most `most`; returns what melted, and
// adds to `flow` what leaves.
template <class Real>
PETRICHOR_KERNEL Real melt_base(CellVars<Real>& c, const Real& most, Real& flow)
{
    const Real zero = 0.0;
    Real wanted = most;
    for (std::size_t i = kSnowLayers; i-- > 0;) {
        if (!any(wanted > zero)) break;
        const Real ice = c.snow_ice[i];
        const Real melted = smaller(ice, wanted);
        const Real left = ice - melted;
        const auto gone = left <= zero;
        flow += melted + select(gone, c.snow_liquid[i], zero);
        c.snow_liquid[i] = select(gone, zero, c.snow_liquid[i]);
        c.snow_temp_c[i] = select(gone, zero, c.snow_temp_c[i]);
        c.snow_thickness[i] =
            select(gone, zero, c.snow_thickness[i] * (left / larger(ice, Real(1e-30))));
        c.snow_ice[i] = left;
        wanted = wanted - melted;
    }
    return most - wanted;
}

// Wheels and ploughs take a share of every layer; what they throw away, kg/m2.
template <class Real>
PETRICHOR_INLINE Real clear_snow(CellVars<Real>& c, double share)
{
    Real thrown = 0.0;
    for (std::size_t i = 0; i < kSnowLayers; ++i) {
        const Real ice = c.snow_ice[i] * share, liquid = c.snow_liquid[i] * share;
        thrown += ice + liquid;
        c.snow_ice[i] = c.snow_ice[i] - ice;
        c.snow_liquid[i] = c.snow_liquid[i] - liquid;
        c.snow_thickness[i] = c.snow_thickness[i] * (1.0 - share);
    }
    return thrown;
}

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

// Water below a pack freezes with the cold of the ground, and ice melts with its warmth, as far as
// those go: the base moves towards 0 C by what it takes or gives. Where a dusting has melted away
// within the step the base is the surface.
template <class Real, class Mask>
PETRICHOR_INLINE void change_below(CellVars<Real>& c, const Mask& below, double conductance,
                                   double dt, Real& base_c)
{
    const Real zero = 0.0;
    const Real most = select(below, base_c, zero) * (conductance * dt / kLatentFusion);
    const Real frozen = smaller(c.film, larger(most * -1.0, zero));
    const Real melted = smaller(c.film_ice, larger(most, zero));
    c.film += melted - frozen;
    c.film_ice += frozen - melted;
    c.total_melt += melted;
    base_c += (frozen - melted) * (kLatentFusion / (conductance * dt));
}

// Cuts the pack into layers of 0.1 and 0.2 m from the top where `cut` says so; masses and heat go
// with the thickness.
//   inverse  1 / thickness of the layers as they are; anything finite for a layer that is not there
template <class Real, class Mask>
PETRICHOR_KERNEL void relayer(CellVars<Real>& c, const Real& depth, const Real* inverse,
                              const Mask& cut, int most_layers)
{
    const Real zero = 0.0;
    Real fresh[kSnowLayers] = {depth, zero, zero};
    if (most_layers > 1) {
        fresh[0] = select(depth > 0.2, Real(0.1), depth);
        const Real rest = depth - fresh[0];
        fresh[1] = rest;
        if (most_layers > 2) fresh[1] = select(rest > 0.4, Real(0.2), rest);
        fresh[2] = rest - fresh[1];
    }
    // Of each old layer, what lies above the first and above the second of the new boundaries.
    const Real first = fresh[0], second = fresh[0] + fresh[1];
    Real ice[kSnowLayers] = {zero, zero, zero};
    Real liquid[kSnowLayers] = {zero, zero, zero};
    Real heat[kSnowLayers] = {zero, zero, zero};
    Real top = zero;
    for (std::size_t i = 0; i < kSnowLayers; ++i) {
        const Real above_first = unit_clamped((first - top) * inverse[i]);
        const Real above_second = unit_clamped((second - top) * inverse[i]);
        const Real shares[kSnowLayers] = {above_first, above_second - above_first,
                                          1.0 - above_second};
        const Real layer_heat =
            (c.snow_ice[i] * kIceHeatCapacity + c.snow_liquid[i] * kWaterHeatCapacity) *
            c.snow_temp_c[i];
        for (std::size_t j = 0; j < kSnowLayers; ++j) {
            ice[j] += c.snow_ice[i] * shares[j];
            liquid[j] += c.snow_liquid[i] * shares[j];
            heat[j] += layer_heat * shares[j];
        }
        top += c.snow_thickness[i];
    }
    for (std::size_t j = kSnowLayers; j-- > 0;) {
        // A sliver of rounding joins the layer above.
        if (j > 0) {
            const auto sliver = fresh[j] <= 1e-9;
            ice[j - 1] += select(sliver, ice[j], zero);
            liquid[j - 1] += select(sliver, liquid[j], zero);
            heat[j - 1] += select(sliver, heat[j], zero);
            ice[j] = select(sliver, zero, ice[j]);
            liquid[j] = select(sliver, zero, liquid[j]);
            heat[j] = select(sliver, zero, heat[j]);
            fresh[j] = select(sliver, zero, fresh[j]);
        }
        const Real capacity = ice[j] * kIceHeatCapacity + liquid[j] * kWaterHeatCapacity;
        c.snow_ice[j] = select(cut, ice[j], c.snow_ice[j]);
        c.snow_liquid[j] = select(cut, liquid[j], c.snow_liquid[j]);
        c.snow_thickness[j] = select(cut, fresh[j], c.snow_thickness[j]);
        c.snow_temp_c[j] = select(cut, heat[j] / larger(capacity, Real(1e-30)), c.snow_temp_c[j]);
    }
}

// Albedo after a step: decay of cold snow, faster for the share of the step with melt.
template <class Real>
PETRICHOR_INLINE void age_albedo(CellVars<Real>& c, const Real& melting, const CellConstants& k,
                                 const StepConstants& s)
{
    const Real keep = melting * (s.albedo_melting - s.albedo_cold) + s.albedo_cold;
    const Real pack = c.snow_ice[0] + c.snow_ice[1] + c.snow_ice[2];
    c.snow_albedo = select(pack > 0.0, aged_albedo_of(c.snow_albedo, keep, k.snow.albedo_min),
                           Real(k.snow.albedo_max));
}

constexpr double kBroken_kg_m3 = 350.0;
constexpr double kDensest_kg_m3 = 850.0;  // nothing settles beyond this

// Anderson 1976, wet snow after Vionnet et al. 2012: by which factor a layer becomes denser within
// dt seconds.
//   load  on its middle, kg/m2
//   wet   liquid water, m3 a m3
template <class Real>
PETRICHOR_INLINE Real settling_growth(const Real& density, const Real& load, const Real& temp_c,
                                      const Real& wet, const SnowParams& snow, double dt)
{
    const Real softness = wet * snow.viscosity_wetness + 1.0;
    const Real weight = load * softness * (kGravity_m_s2 / snow.viscosity_pa_s) *
                        exponential(temp_c * 0.081 - density * snow.viscosity_density_m3_kg);
    // Crystals of dense snow are broken: below a millionth an hour nothing is left to count.
    const auto whole = density < kBroken_kg_m3;
    Real breaking = 0.0;
    if (any(whole)) {
        const Real rate =
            exponential(temp_c * (1.0 / 23.8) - larger(density - 150.0, Real(0.0)) * (1.0 / 21.7)) *
            2.8e-6;
        breaking = select(whole, rate, breaking);
    }
    return (weight + breaking) * dt + 1.0;
}

// Ageing once a step: fresh albedo, settling, layers; and the resistivity (1/k) of each layer for
// the step.
template <class Real>
PETRICHOR_KERNEL void age_snow(CellVars<Real>& c, const Real& snowfall, const Real& new_density,
                               const CellConstants& k, const StepConstants& s, double dt,
                               Real* resistivity)
{
    const Real zero = 0.0;
    if (any(snowfall > zero)) {
        c.snow_albedo = refreshed_albedo_of(c.snow_albedo, snowfall, k.snow.albedo_max,
                                            k.snow.albedo_refresh_kg_m2);
    }

    Real above = zero;
    Real inverse[kSnowLayers] = {Real(1e12), Real(1e12), Real(1e12)};  // 1 / thickness
    for (std::size_t i = 0; i < kSnowLayers; ++i) {
        const Real mass = c.snow_ice[i] + c.snow_liquid[i];
        if (!any(c.snow_thickness[i] > zero)) continue;
        const Real per_thickness = 1.0 / larger(c.snow_thickness[i], Real(1e-12));
        const Real density = smaller(mass * per_thickness, Real(1000.0));
        Real growth;
        if (k.snow.settling == Settling::Overburden) {
            growth = settling_growth(density, above + mass * 0.5, c.snow_temp_c[i],
                                     c.snow_liquid[i] * per_thickness * (1.0 / kWaterDensity),
                                     k.snow, dt);
        } else {
            const Real limit = select(c.snow_temp_c[i] > -1e-9, Real(500.0), Real(300.0));
            const Real denser = settled_density_of(density, limit, s.settling);
            growth = select(density < limit, denser / larger(density, Real(1e-12)), Real(1.0));
        }
        growth = select(density * growth < kDensest_kg_m3, growth, Real(1.0));
        c.snow_thickness[i] = c.snow_thickness[i] / growth;
        inverse[i] = per_thickness * growth;
        above = above + mass;
    }
    const Real depth = c.snow_thickness[0] + c.snow_thickness[1] + c.snow_thickness[2];
    const auto cut = (depth > 0.2) | (c.snow_thickness[1] > zero);
    if (any(cut)) relayer(c, depth, inverse, cut, k.snow.max_layers);

    for (std::size_t i = 0; i < kSnowLayers; ++i) {
        const auto there = c.snow_thickness[i] > zero;
        if (i > 0 && !any(there)) {
            resistivity[i] = zero;
            continue;
        }
        const Real density = select(
            there, (c.snow_ice[i] + c.snow_liquid[i]) / larger(c.snow_thickness[i], Real(1e-12)),
            new_density);
        resistivity[i] = snow_resistivity_of(density);
    }
}

}  // namespace petrichor::weather::detail

#endif
