#include "weather/physics/longwave.h"

#include <cmath>

#include "weather/physics/constants.h"
#include "weather/physics/detail/formulas.h"

namespace petrichor::weather {

namespace {

// Emissivity of a sky full of cloud.
constexpr double kOvercast = 0.955;

}  // namespace

double clear_sky_emissivity(double temp_k, double vapour_pa)
{
    const double x = 46.5 * (0.01 * vapour_pa) / temp_k;
    return 1.0 - (1.0 + x) * detail::exponential(-std::sqrt(1.2 + 3.0 * x));
}

double longwave_from_sky_w_m2(double temp_k, double vapour_pa, double cloud_fraction)
{
    const double share = detail::clamped(cloud_fraction * cloud_fraction, 0.0, 1.0);
    const double clear = clear_sky_emissivity(temp_k, vapour_pa);
    // Very damp warm air alone may radiate more than cloud: it never makes a sky colder.
    const double emissivity = clear + detail::larger(kOvercast - clear, 0.0) * share;
    return emissivity * kStefanBoltzmann * (temp_k * temp_k) * (temp_k * temp_k);
}

double cloud_of_longwave(double temp_k, double vapour_pa, double longwave_w_m2)
{
    const double clear = clear_sky_emissivity(temp_k, vapour_pa);
    const double black = kStefanBoltzmann * (temp_k * temp_k) * (temp_k * temp_k);
    if (clear >= kOvercast) return 0.0;
    const double share = (longwave_w_m2 / black - clear) / (kOvercast - clear);
    return std::sqrt(detail::clamped(share, 0.0, 1.0));
}

}  // namespace petrichor::weather
