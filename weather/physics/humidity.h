#ifndef PETRICHOR_WEATHER_PHYSICS_HUMIDITY_H
#define PETRICHOR_WEATHER_PHYSICS_HUMIDITY_H

namespace petrichor::weather {

// Moist air. Temperatures in kelvin, pressures in Pa, humidity of the air always over liquid water.
// Pure functions, the same bits on every machine; arguments are not checked (the forcing table is).
//
//   range    150..340 K, 20 000..110 000 Pa
//   source   Buck 1981 (form of the saturation curves), with the coefficients used here

/// Saturation vapour pressure over liquid water, Pa: 611.213 exp(17.5043 T / (241.3 + T)).
double saturation_pressure_water_pa(double temp_k);
/// Saturation vapour pressure over ice, Pa: 611.15 exp(22.4422 T / (272.186 + T)).
double saturation_pressure_ice_pa(double temp_k);

/// Vapour pressure from relative humidity in percent (over water).
double vapour_pressure_pa(double temp_k, double rel_humidity_pct);
/// Vapour pressure from specific humidity (kg/kg).
double vapour_pressure_of_specific_humidity_pa(double specific_humidity, double pressure_pa);
/// Relative humidity in percent from a dew point; not limited to 100, NaN where either is NaN.
double rel_humidity_of_dew_point_pct(double temp_k, double dew_point_k);
/// Dew point of a vapour pressure > 0: the inverse of saturation_pressure_water_pa.
double dew_point_k(double vapour_pa);

/// kg of water vapour in a kg of moist air.
double specific_humidity(double vapour_pa, double pressure_pa);
/// kg/m3 of moist air.
double air_density_kg_m3(double temp_k, double specific_humidity, double pressure_pa);

/// Temperature of a ventilated wet thermometer, 1e-6 K; searched from 40 K below the air up to it.
double wet_bulb_k(double temp_k, double vapour_pa, double pressure_pa);

/// Mean pressure at a height above the sea, Pa; below 11 km.
double standard_pressure_pa(double elevation_m);

/// Height transfer: air temperature at another height, lapse rate 6.5 K/km.
double lapse_temperature_k(double temp_k, double from_m, double to_m);
/// Wind at another height above ground over a surface of the given roughness, logarithmic profile.
double lapse_wind_m_s(double wind_m_s, double from_m, double to_m, double roughness_m);
/// Height above the sea where precipitation turns half to snow, `t50_k` being that temperature.
double snow_line_m(double temp_k, double elevation_m, double t50_k);
/// The inverse of snow_line_m: the air temperature at `elevation_m` that puts the snow line there.
double temperature_of_snow_line_k(double snow_line_m, double elevation_m, double t50_k);

}  // namespace petrichor::weather

#endif
