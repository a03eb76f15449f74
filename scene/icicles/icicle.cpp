#include "scene/icicles/icicle.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"

namespace petrichor::scene {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kProfile = 110.0;  // way over radius to the power of 4/3, m^(-1/3)
constexpr double kLeast_m2 = 1.0e-4;

double power(double base, double exponent)
{
    return base > 0.0 ? portable_exp(exponent * portable_log(base)) : 0.0;
}

// Of the profile, the way below the tip where it would end in a point.
double blunt_m()
{
    return kProfile * power(static_cast<double>(kIcicleTip_m), 4.0 / 3.0);
}

}  // namespace

float icicle_radius_m(float from_tip_m)
{
    const double s = std::max(static_cast<double>(from_tip_m), 0.0) + blunt_m();
    return static_cast<float>(power(s / kProfile, 0.75));
}

// The integral of pi r^2 = pi (s / k)^(3/2).
double icicle_volume_m3(double length_m)
{
    const double s0 = blunt_m(), s1 = s0 + std::max(length_m, 0.0);
    return 0.4 * kPi * power(kProfile, -1.5) * (power(s1, 2.5) - power(s0, 2.5));
}

double icicle_length_m(double volume_m3)
{
    if (!(volume_m3 > 0.0)) return 0.0;
    const double s0 = blunt_m();
    const double whole = volume_m3 / (0.4 * kPi * power(kProfile, -1.5)) + power(s0, 2.5);
    return std::max(power(whole, 0.4) - s0, 0.0);
}

// The integral of 2 pi r, and half a ball.
double icicle_area_m2(double length_m)
{
    const double s0 = blunt_m(), s1 = s0 + std::max(length_m, 0.0);
    const auto tip = static_cast<double>(kIcicleTip_m);
    return 2.0 * kPi * power(kProfile, -0.75) * (power(s1, 1.75) - power(s0, 1.75)) / 1.75 + 2.0 * kPi * tip * tip;
}

bool IcicleLengths::any() const
{
    return std::any_of(length_m.begin(), length_m.end(), [](float l) { return l >= kShortestIcicle_m; });
}

double icicle_class_m2(std::size_t number)
{
    return kLeast_m2 * power(kIcicleClassStep, static_cast<double>(number));
}

float icicle_length_m(const IcicleLengths& lengths, float drained_m2)
{
    const auto area = static_cast<double>(drained_m2);
    if (!(area > 0.0)) return 0.0f;
    const double at = portable_log(area / kLeast_m2) / portable_log(kIcicleClassStep);
    if (at < 0.0) {
        const double volume = icicle_volume_m3(static_cast<double>(lengths.length_m.front()));
        return static_cast<float>(icicle_length_m(volume * area / kLeast_m2));
    }
    const auto i = std::min(static_cast<std::size_t>(at), kIcicleClasses - 1);
    const std::size_t next = std::min(i + 1, kIcicleClasses - 1);
    const auto u = static_cast<float>(std::min(at - static_cast<double>(i), 1.0));
    return lengths.length_m[i] + (lengths.length_m[next] - lengths.length_m[i]) * u;
}

}  // namespace petrichor::scene
