#include "weather/physics/longwave.h"

#include <cmath>

#include "weather/physics/constants.h"
#include "weather/physics/detail/formulas.h"
#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather {

namespace {

// Emissivity of a sky full of cloud.
constexpr double kOvercast = 0.955;

}  // namespace

double clear_sky_emissivity(double temp_k, double vapour_pa)
{
    const double water_kg_m2 = 4.65 * vapour_pa / temp_k;
    const double warm = temp_k / 273.16;
    const double square = temp_k * temp_k, warm3 = warm * warm * warm;
    const double sent = 59.38 + 113.7 * (warm3 * warm3) +
                        96.96 * std::sqrt(detail::larger(water_kg_m2, 0.0) / 25.0);
    return detail::clamped(sent / (kStefanBoltzmann * (square * square)), 0.0, 1.0);
}

double emissivity_of_hour(std::int64_t time_us, double longitude_deg)
{
    constexpr std::int64_t kDay_us = 86400LL * 1000000;
    const std::int64_t of_day = ((time_us % kDay_us) + kDay_us) % kDay_us;
    const double days = static_cast<double>(of_day) / static_cast<double>(kDay_us);
    const double turn = days + longitude_deg / 360.0;
    return 0.013 * detail::sine_cosine(2.0 * kPi * (turn - std::floor(turn))).cos;
}

double longwave_from_sky_w_m2(double temp_k, double vapour_pa, double cloud_fraction,
                              double of_hour)
{
    const double cloud = detail::clamped(cloud_fraction, 0.0, 1.0);
    const double share = cloud * cloud * std::sqrt(cloud);
    const double clear = clear_sky_emissivity(temp_k, vapour_pa) + of_hour;
    // Very damp warm air alone may radiate more than cloud: it never makes a sky colder.
    const double emissivity = clear + detail::larger(kOvercast - clear, 0.0) * share;
    return emissivity * kStefanBoltzmann * (temp_k * temp_k) * (temp_k * temp_k);
}

double cloud_of_longwave(double temp_k, double vapour_pa, double longwave_w_m2, double of_hour)
{
    const double clear = clear_sky_emissivity(temp_k, vapour_pa) + of_hour;
    const double black = kStefanBoltzmann * (temp_k * temp_k) * (temp_k * temp_k);
    if (clear >= kOvercast) return 0.0;
    const double share = (longwave_w_m2 / black - clear) / (kOvercast - clear);
    return share > 0.0 ? detail::power(detail::smaller(share, 1.0), 1.0 / 2.5) : 0.0;
}

}  // namespace petrichor::weather
