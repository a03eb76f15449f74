#include "weather/physics/snow.h"

#include "weather/physics/constants.h"
#include "weather/physics/detail/formulas.h"
#include "weather/physics/detail/snow_kernel.h"
#include "weather/physics/detail/snow_laws.h"

namespace petrichor::weather {

double new_snow_density_pahaut(double air_temp_k, double wind_m_s)
{
    return detail::new_snow_density_pahaut_of(air_temp_k - kZeroCelsiusK, wind_m_s);
}

double new_snow_density_hedstrom_pomeroy(double air_temp_k)
{
    return detail::new_snow_density_hedstrom_of(air_temp_k - kZeroCelsiusK);
}

double settled_density(double density, double limit, double dt_s)
{
    return detail::settled_density_of(density, limit,
                                      detail::kept_after(dt_s, detail::kSettling_h));
}

double compaction_rate(const SnowParams& p, double density, double load_kg_m2, double temp_k,
                       double wet)
{
    // The kernel's factor is a line in time.
    constexpr double kLong_s = 1e6;
    const double growth =
        detail::settling_growth(density, load_kg_m2, temp_k - kZeroCelsiusK, wet, p, kLong_s);
    return density * (growth - 1.0) / kLong_s;
}

double aged_albedo(const SnowParams& p, double albedo, double dt_s, bool melting)
{
    const double hours = melting ? p.albedo_melting_h : p.albedo_cold_h;
    return detail::aged_albedo_of(albedo, detail::kept_after(dt_s, hours), p.albedo_min);
}

double refreshed_albedo(const SnowParams& p, double albedo, double snowfall_kg_m2)
{
    return detail::refreshed_albedo_of(albedo, snowfall_kg_m2, p.albedo_max,
                                       p.albedo_refresh_kg_m2);
}

double snow_conductivity(double density)
{
    return detail::snow_conductivity_of(density);
}

double cold_content_j_m2(double ice_kg_m2, double temp_k)
{
    return detail::larger(kIceHeatCapacity * ice_kg_m2 * (kZeroCelsiusK - temp_k), 0.0);
}

double liquid_capacity_kg_m2(const SnowParams& params, double depth_m, double ice_kg_m2)
{
    return detail::held_liquid_of(depth_m, ice_kg_m2, params.irreducible_water);
}

double melt_kg_m2(double flux_w_m2, double dt_s)
{
    return flux_w_m2 * dt_s / kLatentFusion;
}

double snow_cover_fraction(const SnowParams& params, double depth_m)
{
    return detail::hyperbolic_tangent_positive(detail::larger(depth_m, 0.0) / params.cover_depth_m);
}

}  // namespace petrichor::weather
