#include "weather/patches/driving_rain.h"

#include <algorithm>
#include <cmath>

#include "weather/physics/constants.h"
#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather {

namespace {

constexpr double kLeastRate_mm_h = 1e-3;  // drizzle below this behaves like it
constexpr double kSplashHeight_m = 0.10, kSplashNil_m = 0.5, kSplashShare = 0.15;
constexpr double kDripTerminal_m_s = 9.14;

}  // namespace

double rain_fall_speed_m_s(double diameter_mm)
{
    if (diameter_mm < 0.5) return std::max(0.0, 4.5 * diameter_mm - 0.18);
    return 9.65 - 10.3 * detail::exponential(-0.6 * diameter_mm);
}

double median_drop_mm(double rate_mm_h)
{
    return 1.10 * detail::power(std::max(rate_mm_h, kLeastRate_mm_h), 0.19);
}

double lacy_s_m(double rate_mm_h)
{
    return 0.222 * detail::power(std::max(rate_mm_h, kLeastRate_mm_h), -0.12);
}

double rain_on_plane(const Direction& n, double wind_x, double wind_z, double rate_mm_h)
{
    return std::max(0.0, n.y - lacy_s_m(rate_mm_h) * (n.x * wind_x + n.z * wind_z));
}

double wall_rain_factor(double height_share, bool near_edge)
{
    const double up = std::clamp(height_share, 0.0, 1.0);
    return 0.25 + 0.5 * up * up + (near_edge ? 0.2 : 0.0);
}

RainFan rain_fan(double wind_x, double wind_z, double rate_mm_h)
{
    RainFan fan;
    const double median = median_drop_mm(rate_mm_h);
    constexpr double kTurn_rad[3] = {-20.0 * kPi / 180.0, 0.0, 20.0 * kPi / 180.0};
    constexpr double kGust[3] = {0.25, 0.5, 0.25};
    std::size_t at = 0;
    for (const double quantile : kDropQuantiles) {
        const double v = std::max(rain_fall_speed_m_s(quantile * median), 0.05);
        for (std::size_t g = 0; g < 3; ++g) {
            const auto turn = detail::sine_cosine(kTurn_rad[g]);
            const double x = wind_x * turn.cos - wind_z * turn.sin;
            const double z = wind_x * turn.sin + wind_z * turn.cos;
            const double scale = 1.0 / std::sqrt(x * x + v * v + z * z);
            fan.from[at] = visible_lookup({-x * scale, v * scale, -z * scale});
            fan.weight[at] = kGust[g] / static_cast<double>(kDropQuantiles.size());
            ++at;
        }
    }
    return fan;
}

double rain_share(const VisibleBits& bits, const RainFan& fan)
{
    double hidden = 0.0;
    for (std::size_t i = 0; i < fan.from.size(); ++i)
        hidden += fan.weight[i] * (1.0 - visible_share(bits, fan.from[i]));
    return std::max(0.0, 1.0 - hidden);
}

double drip_speed_m_s(double height_m)
{
    const double vt2 = kDripTerminal_m_s * kDripTerminal_m_s;
    return kDripTerminal_m_s *
           std::sqrt(1.0 - detail::exponential(-2.0 * kGravity_m_s2 * height_m / vt2));
}

double splash_share(double height_m, double hardness)
{
    if (!(height_m < kSplashNil_m)) return 0.0;
    return kSplashShare * hardness *
           detail::exponential(-std::max(height_m, 0.0) / kSplashHeight_m);
}

Direction snow_direction(double wind_x, double wind_z)
{
    const double x = -0.4 * wind_x, z = -0.4 * wind_z;
    const double scale = 1.0 / std::sqrt(x * x + 1.0 + z * z);
    return {x * scale, scale, z * scale};
}

double snow_holds(double tilt_rad)
{
    return std::clamp((60.0 - tilt_rad * (180.0 / kPi)) / 30.0, 0.0, 1.0);
}

}  // namespace petrichor::weather
