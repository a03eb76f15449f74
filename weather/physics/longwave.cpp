#include "weather/physics/longwave.h"

#include <cmath>

#include "weather/physics/constants.h"
#include "weather/physics/detail/formulas.h"

namespace petrichor::weather {

double clear_sky_emissivity(double temp_k, double vapour_pa)
{
    const double x = 46.5 * (0.01 * vapour_pa) / temp_k;
    return 1.0 - (1.0 + x) * detail::exponential(-std::sqrt(1.2 + 3.0 * x));
}

double longwave_from_sky_w_m2(double temp_k, double vapour_pa, double cloud_fraction)
{
    const double cloud = cloud_fraction > 0.0 ? detail::power(cloud_fraction, 2.75) : 0.0;
    const double emissivity =
        detail::smaller(clear_sky_emissivity(temp_k, vapour_pa) * (1.0 + 0.22 * cloud), 1.0);
    return emissivity * kStefanBoltzmann * (temp_k * temp_k) * (temp_k * temp_k);
}

double cloud_of_longwave(double temp_k, double vapour_pa, double longwave_w_m2)
{
    const double clear = longwave_from_sky_w_m2(temp_k, vapour_pa, 0.0);
    const double cloud = (longwave_w_m2 / clear - 1.0) / 0.22;
    return cloud > 0.0 ? detail::smaller(detail::power(cloud, 1.0 / 2.75), 1.0) : 0.0;
}

}  // namespace petrichor::weather
