// The weather of a step at a cell: higher or lower than the station, on a slope, under part of the
// sky.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_CELL_WEATHER_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_CELL_WEATHER_H

#include "weather/physics/detail/formulas.h"
#include "weather/physics/detail/saturation_curve.h"
#include "weather/physics/detail/step_forcing.h"
#include "weather/physics/phase.h"

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
    Real rain_factor, snow_factor;  // of the precipitation here, by phase: 1 on flat open ground
    // Of a plate (wall, roof, ceiling) the cosine of its tilt; 1 for ground, terrain too.
    Real gravity_across;
};

// What the weather of a step means for a cell, before it is asked for an instant.
template <class Real>
struct StepWeather {
    Real shift_k;                 // air here over air at the station
    Real light;                   // shortwave here over shortwave on flat open ground
    SaturationCurve<Real> curve;  // of the air, about the middle of the step
    Real saturation_pa;           // there
};
template <class Real>
PETRICHOR_INLINE Real shift_of(const CellPlace<Real>& place)
{
    return place.air_offset_k - place.height_difference_m * kLapseRate_k_m;
}
template <class Real>
PETRICHOR_INLINE void weather_of(const StepForcing& step, const CellPlace<Real>& place,
                                 StepWeather<Real>& w)
{
    w.shift_k = shift_of(place);
    w.saturation_pa = centre_curve(w.curve, Real(kWaterA), Real(kWaterB), Real(kWaterScale_pa),
                                   w.shift_k + step.middle.air_c);
    // Sun on a slope: the direct beam by its angle, the rest by the share of the sky; hidden sky
    // gives back a fifth. On flat open ground this is exactly 1, wherever the sun is.
    Real light = place.sky_view + (1.0 - place.sky_view) * 0.2;
    if (step.sun_up > 0.05) {
        const Real facing =
            larger(place.normal_east * step.sun_east + place.normal_north * step.sun_north +
                       place.normal_up * step.sun_up,
                   Real(0.0));
        light += (facing / step.sun_up * step.beam - place.sky_view) * (1.0 - step.diffuse);
    }
    w.light = light * place.shortwave_factor;
}

// The weather at one instant at the cell.
template <class Real>
struct CellWeather {
    Real air_c, q_air, density, pressure, wind, shortwave, longwave;
    Real per_air_wind2;  // 1 / (T U^2), of the Richardson number
    Real gravity_across, upright;
    // What still changes until the end of the substep.
    Real later_q, later_shortwave, later_longwave;
    double later_air_k, later_wind;  // wind: as a share
    double reflecting;               // 0: shortwave is what the ground takes up
};

template <class Real>
PETRICHOR_INLINE void weather_at(const StepWeather<Real>& day, const StationMoment& m,
                                 const CellPlace<Real>& place, double least_wind,
                                 CellWeather<Real>& w)
{
    w.air_c = day.shift_k + m.air_c;
    w.pressure = place.pressure_factor * m.pressure;
    w.wind = larger(place.wind_factor * m.wind, Real(least_wind));
    // How far the air is from the middle of the step is the same everywhere.
    Real saturation = day.saturation_pa;
    if (m.from_middle_k > kCurveReach_k || m.from_middle_k < -kCurveReach_k)
        saturation = saturation_water_pa(w.air_c);
    else if (m.from_middle_k != 0.0)
        saturation += saturation * point_of(day.curve, w.air_c).growth;
    const Real vapour = saturation * m.rh_share;

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
    w.gravity_across = place.gravity_across;
    w.upright = 1.0 - larger(place.gravity_across, -place.gravity_across);

    // Hidden sky radiates like the air.
    const Real squared = air_k * air_k;
    const Real emitted = place.sky_view * m.sky_w_m2_k4 + (1.0 - place.sky_view) * kStefanBoltzmann;
    w.longwave = squared * squared * emitted + place.sky_view * place.longwave_offset;
    w.shortwave = day.light * m.shortwave;
    w.reflecting = m.reflecting;
    w.later_air_k = m.later_air_k;
    w.later_wind = m.later_wind;
    w.later_q = w.q_air * (day.curve.slope * m.later_air_k + m.later_rh);
    w.later_shortwave = day.light * m.later_shortwave;
    w.later_longwave = place.sky_view * m.later_longwave;
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

}  // namespace petrichor::weather::detail

#endif
