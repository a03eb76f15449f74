#include "weather/physics/snow.h"

#include "weather/physics/constants.h"
#include "weather/physics/detail/formulas.h"

namespace petrichor::weather {

double new_snow_density_pahaut(double air_temp_k, double wind_m_s)
{
    return detail::new_snow_density_pahaut_of(air_temp_k - kZeroCelsiusK, wind_m_s);
}

double new_snow_density_hedstrom_pomeroy(double air_temp_k)
{
    const double t_c = detail::smaller(air_temp_k - kZeroCelsiusK, 0.0);
    return 67.92 + 51.25 * detail::exponential(t_c / 2.59);
}

double new_snow_density(const SnowParams& params, double air_temp_k, double wind_m_s)
{
    switch (params.new_density) {
        case NewSnowDensity::HedstromPomeroy:
            return new_snow_density_hedstrom_pomeroy(air_temp_k);
        case NewSnowDensity::Constant:
            return params.constant_density_kg_m3;
        case NewSnowDensity::Pahaut:
            break;
    }
    return new_snow_density_pahaut(air_temp_k, wind_m_s);
}

double settled_density(double density, double limit, double dt_s)
{
    if (density >= limit) return density;
    return limit + (density - limit) * detail::exponential(-dt_s / (200.0 * 3600.0));
}

double compaction_rate(double density, double load_kg_m2, double temp_k)
{
    const double cold = kZeroCelsiusK - temp_k;
    const double viscosity = 3.7e7 * detail::exponential(0.081 * cold + 0.018 * density);
    const double breaking =
        2.8e-6 * detail::exponential(-cold / 23.8 - detail::larger(density - 150.0, 0.0) / 21.7);
    return density * (kGravity_m_s2 * load_kg_m2 / viscosity + breaking);
}

double aged_albedo(const SnowParams& p, double albedo, double dt_s, bool melting)
{
    const double hours = melting ? p.albedo_melting_h : p.albedo_cold_h;
    return p.albedo_min + (albedo - p.albedo_min) * detail::exponential(-dt_s / (3600.0 * hours));
}

double refreshed_albedo(const SnowParams& p, double albedo, double snowfall_kg_m2)
{
    return albedo + (p.albedo_max - albedo) *
                        (1.0 - detail::exponential(-snowfall_kg_m2 / p.albedo_refresh_kg_m2));
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
    return detail::larger(1000.0 * params.irreducible_water * (depth_m - ice_kg_m2 / kIceDensity),
                          0.0);
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
