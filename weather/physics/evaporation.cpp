#include "weather/physics/evaporation.h"

#include "weather/physics/constants.h"
#include "weather/physics/humidity.h"

namespace petrichor::weather {

PenmanResult penman_monteith(const PenmanForcing& f)
{
    const double t_c = f.air_temp_k - kZeroCelsiusK;
    const double saturation = saturation_pressure_water_pa(f.air_temp_k);
    const double vapour = vapour_pressure_pa(f.air_temp_k, f.rel_humidity_pct);
    const double q = specific_humidity(vapour, f.pressure_pa);
    const double density = air_density_kg_m3(f.air_temp_k, q, f.pressure_pa);
    const double slope = saturation * 17.5043 * 241.3 / ((241.3 + t_c) * (241.3 + t_c));
    const double gamma = kAirHeatCapacity * f.pressure_pa / (kWaterToAirMass * kLatentVaporisation);
    PenmanResult result;
    result.aerodynamic_resistance_s_m = 1.0 / (f.exchange_coefficient * f.wind_m_s);
    result.latent_w_m2 =
        (slope * (f.net_radiation_w_m2 - f.ground_flux_w_m2) +
         density * kAirHeatCapacity * (saturation - vapour) / result.aerodynamic_resistance_s_m) /
        (slope + gamma);
    result.rate_kg_m2_s = result.latent_w_m2 / kLatentVaporisation;
    return result;
}

}  // namespace petrichor::weather
