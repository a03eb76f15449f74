// The weather of a step at a cell: higher or lower than the station, on a slope, under part of the
// sky.
#ifndef PETRICHOR_WEATHER_DETAIL_CELL_WEATHER_H
#define PETRICHOR_WEATHER_DETAIL_CELL_WEATHER_H

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
    // What still changes until the end of the substep.
    Real later_q, later_shortwave, later_longwave;
    double later_air_k, later_wind;  // wind: as a share
    double reflecting;               // 0: shortwave is what the ground takes up
};

//   x      0..1, from the beginning to the end of the step
//   until  the end of the substep, of which x is the middle
template <class Real>
PETRICHOR_INLINE CellWeather<Real> weather_at(const StepWeather<Real>& day, const StepForcing& step,
                                              const CellPlace<Real>& place, double x, double until,
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
    const double later = until - x;
    w.later_air_k = step.air_c.rise * later;
    w.later_wind = step.wind.rise * later / (step.wind.at(x) + 1.0);
    w.later_q = w.q_air * (day.curve.slope * w.later_air_k +
                           step.rh_pct.rise * later / (step.rh_pct.at(x) + 1.0));
    w.reflecting = step.reflecting;
    w.later_shortwave = day.light * (step.shortwave.rise * later);
    w.later_longwave = place.sky_view * (step.longwave.rise * later);
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

}  // namespace petrichor::weather::detail

#endif
