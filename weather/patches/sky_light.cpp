#include "weather/patches/sky_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "weather/physics/constants.h"
#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather {

namespace {

constexpr double kPerezEdge[] = {1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2};
// f11 f12 f13 f21 f22 f23, by bin of clearness
constexpr double kPerez[8][6] = {
    {-.008, .588, -.062, -.060, .072, -.022},   {.130, .683, -.151, -.019, .066, -.029},
    {.330, .487, -.221, .055, -.064, -.026},    {.568, .187, -.295, .109, -.152, -.014},
    {.873, -.392, -.362, .226, -.462, .001},    {1.132, -1.237, -.412, .288, -.823, .056},
    {1.060, -1.600, -.359, .264, -1.127, .131}, {.678, -.327, -.250, .156, -1.377, .251},
};

}  // namespace

double relative_air_mass(double zenith_rad)
{
    const double degrees = std::min(zenith_rad * (180.0 / kPi), 90.0);
    return 1.0 / (detail::sine_cosine(zenith_rad).cos +
                  0.50572 * detail::power(96.07995 - degrees, -1.6364));
}

double clear_beam_w_m2(double outside, double zenith_rad, double height_m)
{
    constexpr double kTurbidity = 2.0, kAirHeight_m = 8434.5;
    const double above_m = std::isfinite(height_m) ? height_m : 0.0;
    const double m = relative_air_mass(zenith_rad) * detail::exponential(-above_m / kAirHeight_m);
    const double inverse_depth =
        m > 20.0 ? 10.4 + 0.718 * m
                 : 6.6296 + m * (1.7513 + m * (-0.1202 + m * (0.0065 - 0.00013 * m)));
    return outside * detail::exponential(-0.8662 * kTurbidity * m / inverse_depth);
}

SkyGlow perez_glow(double diffuse, double direct, double outside, double zenith_rad)
{
    const double z3 = 1.041 * zenith_rad * zenith_rad * zenith_rad;
    const double clearness = ((diffuse + direct) / diffuse + z3) / (1.0 + z3);
    std::size_t bin = 0;
    while (bin < 7 && clearness > kPerezEdge[bin]) ++bin;
    const double brightness = diffuse * relative_air_mass(zenith_rad) / outside;
    const double* f = kPerez[bin];
    SkyGlow glow;
    glow.sun = std::max(0.0, f[0] + f[1] * brightness + f[2] * zenith_rad);
    glow.horizon = f[3] + f[4] * brightness + f[5] * zenith_rad;
    return glow;
}

SkyGlow glow_below(SkyGlow glow, double diffuse, double all, double most)
{
    glow.sun = std::min(glow.sun * diffuse, std::max(0.0, most)) / all;
    glow.horizon *= diffuse / all;
    return glow;
}

double sky_light_w_m2(double diffuse, const SkyGlow& glow, const SkySeen& seen)
{
    return std::max(0.0, diffuse * ((1.0 - glow.sun) * seen.sky + glow.sun * seen.sun +
                                    glow.horizon * seen.horizon * seen.sine_tilt));
}

double warm_horizon_w_m2(double log_secant, double cloud_fraction, double air_temp_k)
{
    const double squared = air_temp_k * air_temp_k;
    return 0.09 * (log_secant - 0.5) * (1.0 - cloud_fraction) * kStefanBoltzmann * squared *
           squared;
}

}  // namespace petrichor::weather
