#include "weather/physics/phase.h"

#include "weather/physics/detail/formulas.h"
#include "weather/physics/humidity.h"

namespace petrichor::weather {

double snow_fraction_linear(double temp_k, double all_snow_k, double all_rain_k)
{
    return detail::unit_clamped((all_rain_k - temp_k) / (all_rain_k - all_snow_k));
}

double snow_fraction_humidity(double temp_k, double rel_humidity_pct)
{
    return detail::snow_fraction_humidity_of(temp_k - kZeroCelsiusK, rel_humidity_pct);
}

double snow_fraction_wet_bulb(double wet_bulb_k)
{
    return detail::snow_fraction_wet_bulb_of(wet_bulb_k - kZeroCelsiusK);
}

double half_snow_temperature_k(double rel_humidity_pct)
{
    return kZeroCelsiusK + (10.04 - 0.09 * rel_humidity_pct) / 1.41;
}

double snow_fraction(const PhaseParams& params, double temp_k, double rel_humidity_pct,
                     double pressure_pa)
{
    switch (params.law) {
        case PhaseLaw::Humidity:
            return snow_fraction_humidity(temp_k, rel_humidity_pct);
        case PhaseLaw::WetBulb:
            return snow_fraction_wet_bulb(
                wet_bulb_k(temp_k, vapour_pressure_pa(temp_k, rel_humidity_pct), pressure_pa));
        case PhaseLaw::Threshold:
            return temp_k < params.threshold_k ? 1.0 : 0.0;
        case PhaseLaw::Linear:
            break;
    }
    return snow_fraction_linear(temp_k, params.all_snow_k, params.all_rain_k);
}

}  // namespace petrichor::weather
