#include "weather/physics/exchange.h"

#include <cmath>

#include "weather/physics/constants.h"
#include "weather/physics/detail/formulas.h"
#include "weather/physics/detail/surface_kernel.h"

namespace petrichor::weather {

double neutral_exchange(double wind_height_m, double temp_height_m, double roughness_m)
{
    return detail::neutral_exchange_of(detail::logarithm(wind_height_m / roughness_m),
                                       detail::logarithm(temp_height_m / (0.1 * roughness_m)));
}

double bulk_richardson(double wind_height_m, double air_temp_k, double surface_temp_k,
                       double wind_m_s)
{
    return detail::richardson_per_k_of(1.0 / (air_temp_k * wind_m_s * wind_m_s), wind_height_m) *
           (air_temp_k - surface_temp_k);
}

double stability_factor(double richardson, double neutral, double wind_height_m, double roughness_m)
{
    return detail::stability_factor_of(richardson,
                                       75.0 * neutral * std::sqrt(wind_height_m / roughness_m));
}

double convection_coefficient(double wind_height_m, double roughness_m, double heat_roughness_m)
{
    return detail::convection_of(detail::logarithm(wind_height_m / roughness_m),
                                 detail::logarithm(roughness_m / heat_roughness_m));
}

double wall_convection_w_m2_k(double difference_k)
{
    return detail::wall_convection_of(difference_k) * kAirHeatCapacity;
}

double leaf_exchange(double width_m, double wind_m_s)
{
    constexpr double kSide_mol = 0.135 * 1.4, kAir_kg_mol = 0.02897, kBetweenLeaves = 1.0 / 3.0;
    return width_m > 0.0 ? 2.0 * kSide_mol * kAir_kg_mol * std::sqrt(kBetweenLeaves * wind_m_s / width_m) : 0.0;
}

}  // namespace petrichor::weather
