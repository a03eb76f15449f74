#include "weather/physics/humidity.h"

#include <cmath>
#include <limits>

#include "weather/physics/constants.h"
#include "weather/physics/detail/formulas.h"

namespace petrichor::weather {

double saturation_pressure_water_pa(double temp_k)
{
    return detail::saturation_water_pa(temp_k - kZeroCelsiusK);
}

double saturation_pressure_ice_pa(double temp_k)
{
    return detail::saturation_ice_pa(temp_k - kZeroCelsiusK);
}

double vapour_pressure_pa(double temp_k, double rel_humidity_pct)
{
    return 0.01 * rel_humidity_pct * saturation_pressure_water_pa(temp_k);
}

double vapour_pressure_of_specific_humidity_pa(double q, double pressure_pa)
{
    return q * pressure_pa / (kWaterToAirMass + (1.0 - kWaterToAirMass) * q);
}

double rel_humidity_of_dew_point_pct(double temp_k, double dew_point_k)
{
    // The exponential makes a number of NaN.
    if (std::isnan(temp_k) || std::isnan(dew_point_k))
        return std::numeric_limits<double>::quiet_NaN();
    return 100.0 * saturation_pressure_water_pa(dew_point_k) / saturation_pressure_water_pa(temp_k);
}

double dew_point_k(double vapour_pa)
{
    const double x = detail::logarithm(vapour_pa / 611.213);
    return kZeroCelsiusK + 241.3 * x / (17.5043 - x);
}

double specific_humidity(double vapour_pa, double pressure_pa)
{
    return detail::specific_humidity_of(vapour_pa, pressure_pa);
}

double air_density_kg_m3(double temp_k, double specific_humidity, double pressure_pa)
{
    return detail::air_density_of(temp_k, specific_humidity, pressure_pa);
}

double wet_bulb_k(double temp_k, double vapour_pa, double pressure_pa)
{
    return kZeroCelsiusK + detail::wet_bulb_c_of(temp_k - kZeroCelsiusK, vapour_pa, pressure_pa);
}

double standard_pressure_pa(double elevation_m)
{
    return 101325.0 * detail::power(1.0 - 2.25577e-5 * elevation_m, 5.25588);
}

double lapse_temperature_k(double temp_k, double from_m, double to_m)
{
    return temp_k - kLapseRate_k_m * (to_m - from_m);
}

double lapse_wind_m_s(double wind_m_s, double from_m, double to_m, double roughness_m)
{
    return wind_m_s * detail::logarithm(to_m / roughness_m) /
           detail::logarithm(from_m / roughness_m);
}

double snow_line_m(double temp_k, double elevation_m, double t50_k)
{
    return elevation_m + (temp_k - t50_k) / kLapseRate_k_m;
}

double temperature_of_snow_line_k(double line_m, double elevation_m, double t50_k)
{
    return t50_k + (line_m - elevation_m) * kLapseRate_k_m;
}

}  // namespace petrichor::weather
