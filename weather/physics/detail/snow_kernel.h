// The snow pack of the cell kernel: up to three layers, top first. A layer that is not there has no
// mass, no thickness, no resistance and no heat capacity, so it drops out of every formula by
// itself.
#ifndef PETRICHOR_WEATHER_DETAIL_SNOW_KERNEL_H
#define PETRICHOR_WEATHER_DETAIL_SNOW_KERNEL_H

#include "weather/physics/cell_state.h"
#include "weather/physics/detail/cell_constants.h"
#include "weather/physics/detail/formulas.h"

namespace petrichor::weather::detail {

template <class Real>
PETRICHOR_INLINE Real new_snow_density_of(const CellConstants& k, const Real& air_c,
                                          const Real& wind)
{
    switch (k.snow.new_density) {
        case NewSnowDensity::HedstromPomeroy:
            return exponential(smaller(air_c, Real(0.0)) * (1.0 / 2.59)) * 51.25 + 67.92;
        case NewSnowDensity::Constant:
            return Real(k.snow.constant_density_kg_m3);
        case NewSnowDensity::Pahaut:
            break;
    }
    return new_snow_density_pahaut_of(air_c, wind);
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

// Adds the pack on top of the ground's conductance and equivalent temperature (ground.h).
template <class Real>
PETRICHOR_KERNEL void snow_equivalent(const CellVars<Real>& c, const Real* resistivity, double dt,
                                      Real& conductance, Real& equivalent_c,
                                      SnowColumn<Real>& column)
{
    const double per_dt = 1.0 / dt;
    for (std::size_t i = kSnowLayers; i-- > 0;) {
        column.below[i] = column.own[i] = equivalent_c;
        column.share_top[i] = column.share_down[i] = Real(1.0);
        if (!any(c.snow_ice[i] > 0.0)) continue;
        const Real half = c.snow_thickness[i] * resistivity[i] * 0.5;
        const Real storage = heat_capacity_of(c.snow_ice[i], c.snow_liquid[i]) * per_dt;
        column.share_down[i] = 1.0 / (conductance * half + 1.0);
        const Real under = conductance * column.share_down[i];
        const Real total = under + storage;
        equivalent_c =
            select(storage > 0.0, (under * equivalent_c + storage * c.snow_temp_c[i]) / total,
                   equivalent_c);
        column.own[i] = equivalent_c;
        column.share_top[i] = 1.0 / (total * half + 1.0);
        conductance = total * column.share_top[i];
    }
}

// Layer temperatures from that of the surface; `interface_c` becomes that of the ground's surface.
template <class Real>
PETRICHOR_INLINE void snow_temperatures(CellVars<Real>& c, const SnowColumn<Real>& column,
                                        Real& interface_c)
{
    for (std::size_t i = 0; i < kSnowLayers; ++i) {
        const Real node = column.own[i] + (interface_c - column.own[i]) * column.share_top[i];
        c.snow_temp_c[i] = select(c.snow_ice[i] > 0.0, node, Real(0.0));
        interface_c = column.below[i] + (node - column.below[i]) * column.share_down[i];
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
        if (!any(ice > zero)) continue;  // water runs through
        // What the layer gained or lost beyond the melting point changes its phase from within.
        const Real heat = heat_capacity_of(ice, c.snow_liquid[i]) * c.snow_temp_c[i];
        const Real capacity = ice * kIceHeatCapacity + c.snow_liquid[i] * kWaterHeatCapacity;
        // The reference counts the cold of the ice alone.
        const Real usable = ice * kIceHeatCapacity / larger(capacity, Real(1e-30));
        const Real refrozen =
            smaller(c.snow_liquid[i], larger(heat * usable * (-1.0 / kLatentFusion), zero));
        Real temp = smaller(heat * usable + refrozen * kLatentFusion, zero) /
                    larger(ice * kIceHeatCapacity, Real(1e-30));
        const Real gone = smaller(ice, to_air);
        to_air = to_air - gone;
        Real left = ice - gone;
        const Real melted = smaller(left, to_melt);
        to_melt = to_melt - melted;
        left = left - melted;
        const Real inside = smaller(left, larger(heat, zero) * (1.0 / kLatentFusion));
        left = left - inside;
        c.snow_thickness[i] =
            select(ice > zero, c.snow_thickness[i] * (left / larger(ice, Real(1e-30))), zero);
        left = left + refrozen;
        Real liquid = c.snow_liquid[i] - refrozen + melted + inside + flow;
        c.total_melt += inside;
        // Water that meets cold snow freezes, as far as the cold content goes.
        const Real cold = left * kIceHeatCapacity;
        const Real frozen = smaller(liquid, cold * temp * (-1.0 / kLatentFusion));
        temp = smaller(temp + frozen * kLatentFusion / larger(cold, Real(1e-30)), zero);
        left = left + frozen;
        liquid = liquid - frozen;
        const Real held = larger((c.snow_thickness[i] - left * (1.0 / kIceDensity)) *
                                     (1000.0 * k.snow.irreducible_water),
                                 zero);
        flow = larger(liquid - held, zero);
        c.snow_liquid[i] = liquid - flow;
        c.snow_ice[i] = left;
        c.snow_temp_c[i] = temp;
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
        c.snow_thickness[i] =
            select(gone, zero, c.snow_thickness[i] * (left / larger(ice, Real(1e-30))));
        c.snow_ice[i] = left;
        wanted = wanted - melted;
    }
    return most - wanted;
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

// Cuts the pack into layers of 0.1 and 0.2 m from the top; masses and heat go with the thickness.
template <class Real>
PETRICHOR_KERNEL void relayer(CellVars<Real>& c, int most_layers)
{
    const Real zero = 0.0;
    const Real depth = c.snow_thickness[0] + c.snow_thickness[1] + c.snow_thickness[2];
    Real fresh[kSnowLayers] = {depth, zero, zero};
    if (most_layers > 1) {
        fresh[0] = select(depth > 0.2, Real(0.1), depth);
        const Real rest = depth - fresh[0];
        fresh[1] = rest;
        if (most_layers > 2) fresh[1] = select(rest > 0.4, Real(0.2), rest);
        fresh[2] = rest - fresh[1];
    }
    Real ice[kSnowLayers] = {zero, zero, zero};
    Real liquid[kSnowLayers] = {zero, zero, zero};
    Real heat[kSnowLayers] = {zero, zero, zero};
    Real old_top = zero;
    for (std::size_t i = 0; i < kSnowLayers; ++i) {
        const Real old_bottom = old_top + c.snow_thickness[i];
        const Real inverse =
            select(c.snow_thickness[i] > 0.0, 1.0 / larger(c.snow_thickness[i], Real(1e-30)), zero);
        const Real layer_heat =
            (c.snow_ice[i] * kIceHeatCapacity + c.snow_liquid[i] * kWaterHeatCapacity) *
            c.snow_temp_c[i];
        Real top = zero;
        Real ice_left = c.snow_ice[i], liquid_left = c.snow_liquid[i], heat_left = layer_heat;
        for (std::size_t j = 0; j < kSnowLayers; ++j) {
            const Real bottom = top + fresh[j];
            const Real overlap = larger(smaller(old_bottom, bottom) - larger(old_top, top), zero);
            // The last layer takes what is left, so that nothing is lost to rounding.
            const bool last = j + 1 == kSnowLayers;
            const Real share = smaller(overlap * inverse, Real(1.0));
            const Real di = last ? ice_left : smaller(c.snow_ice[i] * share, ice_left);
            const Real dl = last ? liquid_left : smaller(c.snow_liquid[i] * share, liquid_left);
            const Real dh = last ? heat_left : layer_heat * share;
            ice_left = ice_left - di;
            liquid_left = liquid_left - dl;
            heat_left = heat_left - dh;
            ice[j] += di;
            liquid[j] += dl;
            heat[j] += dh;
            top = bottom;
        }
        old_top = old_bottom;
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
        c.snow_ice[j] = ice[j];
        c.snow_liquid[j] = liquid[j];
        c.snow_thickness[j] = fresh[j];
        c.snow_temp_c[j] = select(capacity > 0.0, heat[j] / larger(capacity, Real(1e-30)), zero);
    }
}

// Albedo after a step: decay of cold snow, faster for the share of the step with melt.
template <class Real>
PETRICHOR_INLINE void age_albedo(CellVars<Real>& c, const Real& melting, const CellConstants& k,
                                 const StepConstants& s)
{
    const Real keep = melting * (s.albedo_melting - s.albedo_cold) + s.albedo_cold;
    const Real pack = c.snow_ice[0] + c.snow_ice[1] + c.snow_ice[2];
    c.snow_albedo =
        select(pack > 0.0, (c.snow_albedo - k.snow.albedo_min) * keep + k.snow.albedo_min,
               Real(k.snow.albedo_max));
}

constexpr double kBroken_kg_m3 = 350.0;

// Ageing once a step: fresh albedo, settling, layers; and the resistivity (1/k) of each layer for
// the step.
template <class Real>
PETRICHOR_KERNEL void age_snow(CellVars<Real>& c, const Real& snowfall, const Real& new_density,
                               const CellConstants& k, const StepConstants& s, double dt,
                               Real* resistivity)
{
    const Real zero = 0.0;
    if (any(snowfall > zero)) {
        c.snow_albedo += (k.snow.albedo_max - c.snow_albedo) *
                         (1.0 - exponential(snowfall * (-1.0 / k.snow.albedo_refresh_kg_m2)));
    }

    Real above = zero;
    for (std::size_t i = 0; i < kSnowLayers; ++i) {
        const Real mass = c.snow_ice[i] + c.snow_liquid[i];
        const auto there = c.snow_thickness[i] > zero;
        if (!any(there)) continue;
        const Real density = mass / larger(c.snow_thickness[i], Real(1e-12));
        Real denser = density;
        if (k.snow.settling == Settling::Overburden) {
            const Real cold = c.snow_temp_c[i] * -1.0;
            const Real load = above + mass * 0.5;
            const Real weight =
                load * (kGravity_m_s2 / 3.7e7) * exponential(cold * -0.081 - density * 0.018);
            // Crystals of dense snow are broken: below a millionth an hour nothing is left to
            // count.
            const auto whole = density < kBroken_kg_m3;
            Real breaking = zero;
            if (any(whole)) {
                const Real rate = exponential(cold * (-1.0 / 23.8) -
                                              larger(density - 150.0, zero) * (1.0 / 21.7)) *
                                  2.8e-6;
                breaking = select(whole, rate, zero);
            }
            denser = density * ((weight + breaking) * dt + 1.0);
        } else {
            const Real limit = select(c.snow_temp_c[i] > -1e-9, Real(500.0), Real(300.0));
            denser = select(density < limit, limit + (density - limit) * s.settling, density);
        }
        denser = larger(smaller(denser, Real(850.0)), density);
        c.snow_thickness[i] = select(there, mass / larger(denser, Real(1e-12)), zero);
        above = above + mass;
    }
    const Real depth = c.snow_thickness[0] + c.snow_thickness[1] + c.snow_thickness[2];
    if (any(depth > 0.2) || any(c.snow_thickness[1] > zero)) relayer(c, k.snow.max_layers);

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
