#ifndef PETRICHOR_WEATHER_PHYSICS_PHASE_H
#define PETRICHOR_WEATHER_PHYSICS_PHASE_H

namespace petrichor::weather {

/// How much of precipitation falls as snow, when the file does not say.
enum class PhaseLaw {
    Linear,     ///< (rain - T) / (rain - snow), clamped; common practice
    Humidity,   ///< logistic in T and relative humidity; Jennings et al. 2018
    WetBulb,    ///< logistic in the wet-bulb temperature; Wang et al. 2019
    Threshold,  ///< all or nothing at `threshold_k`; hemispheric mean of Jennings et al. 2018
};

struct PhaseParams {
    PhaseLaw law = PhaseLaw::Linear;
    double all_snow_k = 273.15;   ///< linear: snow only at and below
    double all_rain_k = 275.15;   ///< linear: rain only at and above; > all_snow_k
    double threshold_k = 274.15;  ///< threshold: snow below
};

/// Snow fraction 0..1 of precipitation; falls with temperature.
double snow_fraction(const PhaseParams& params, double temp_k, double rel_humidity_pct,
                     double pressure_pa);

double snow_fraction_linear(double temp_k, double all_snow_k, double all_rain_k);
double snow_fraction_humidity(double temp_k, double rel_humidity_pct);
double snow_fraction_wet_bulb(double wet_bulb_k);
/// Temperature at which the humidity law gives half snow.
double half_snow_temperature_k(double rel_humidity_pct);

}  // namespace petrichor::weather

#endif
