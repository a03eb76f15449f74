#include "weather/physics/snow_simple.h"

#include "weather/physics/constants.h"
#include "weather/physics/detail/canopy_kernel.h"
#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather {

double positive_degree_seconds(double from_k, double to_k, double dt_s)
{
    const double from = from_k - kZeroCelsiusK;
    const double to = to_k - kZeroCelsiusK;
    if (from <= 0.0 && to <= 0.0) return 0.0;
    if (from >= 0.0 && to >= 0.0) return 0.5 * (from + to) * dt_s;
    const double high = detail::larger(from, to);
    const double low = detail::smaller(from, to);
    return high * high * dt_s / (2.0 * (high - low));
}

double degree_day_melt_kg_m2(double from_k, double to_k, double dt_s, double melt_kg_m2_k_day)
{
    return positive_degree_seconds(from_k, to_k, dt_s) * melt_kg_m2_k_day / 86400.0;
}

double radiation_melt_kg_m2_h(double temp_k, double albedo, double shortwave_w_m2)
{
    const double t_c = temp_k - kZeroCelsiusK;
    if (!(t_c > 1.0)) return 0.0;
    return 0.05 * t_c + 0.0094 * (1.0 - albedo) * shortwave_w_m2;
}

double drift_threshold_m_s(double temp_k, bool wet_snow)
{
    const double t_c = temp_k - kZeroCelsiusK;
    return wet_snow ? 9.9 : 9.43 + 0.18 * t_c + 0.0033 * t_c * t_c;
}

double canopy_interception_kg_m2(double held_kg_m2, double snowfall_kg_m2,
                                 double vegetation_area_index)
{
    const double most = detail::kCanopyHolds_kg_m2 * vegetation_area_index;
    if (!(most > held_kg_m2)) return 0.0;
    return detail::caught_by_canopy(held_kg_m2, snowfall_kg_m2, most);
}

double canopy_unloading_kg_m2(double held_kg_m2, double dt_s, bool melting)
{
    return held_kg_m2 * detail::unloaded_share(
                            dt_s, melting ? detail::kUnloadingMelting_s : detail::kUnloadingCold_s);
}

}  // namespace petrichor::weather
