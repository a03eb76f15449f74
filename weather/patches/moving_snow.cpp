#include "weather/patches/moving_snow.h"

#include <algorithm>

#include "weather/physics/constants.h"
#include "weather/physics/detail/formulas.h"
#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather {

double slide_pull(double tilt_deg, double rest_deg)
{
    const auto tilt = detail::sine_cosine(tilt_deg * kPi / 180.0);
    const auto rest = detail::sine_cosine(rest_deg * kPi / 180.0);
    return std::max(0.0, (tilt.sin * rest.cos - rest.sin * tilt.cos) / rest.cos);
}

double snow_friction_m_s(double wind_10m_m_s)
{
    constexpr double kLogHeight = 9.210340371976184;  // of 10 m over 1 mm
    return 0.4 * wind_10m_m_s / kLogHeight;
}

double saltation_kg_m_s(double friction, double threshold, double air_density)
{
    if (!(friction > threshold)) return 0.0;
    return 0.68 * air_density * threshold / (friction * kGravity_m_s2) *
           (friction * friction - threshold * threshold);
}

double lee_share_1_m(double distance_m, double height_m)
{
    if (!(height_m > 0.0) || !(distance_m < 1e6 * height_m)) return 0.0;
    const double heights = distance_m / height_m;
    return heights * detail::exponential(-0.5 * heights) / (4.0 * height_m);
}

}  // namespace petrichor::weather
