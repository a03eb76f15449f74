#include "weather/physics/horizon.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather {

namespace {

constexpr std::int64_t kQuarter_us = 900LL * 1000000;
constexpr std::size_t kMostDirections = 3600;
constexpr double kDegree = kPi / 180.0;

}  // namespace

double horizon_elevation(std::span<const double> horizon, double azimuth_rad)
{
    if (horizon.empty()) return 0.0;
    const double count = static_cast<double>(horizon.size());
    const double turn = azimuth_rad / (2.0 * kPi);
    const double at = (turn - std::floor(turn)) * count;
    const auto i = std::min(static_cast<std::size_t>(at), horizon.size() - 1);
    const double next = horizon[(i + 1) % horizon.size()];
    return horizon[i] + (next - horizon[i]) * (at - static_cast<double>(i));
}

double horizon_sky_view(std::span<const double> horizon)
{
    if (horizon.empty()) return 1.0;
    double sum = 0.0;
    for (const double elevation : horizon) {
        const double cosine = detail::sine_cosine(elevation).cos;
        sum += cosine * cosine;
    }
    return sum / static_cast<double>(horizon.size());
}

Skyline::Skyline(std::span<const double> horizon) : horizon_(horizon)
{
    if (horizon.empty()) return;
    const auto [lowest, highest] = std::minmax_element(horizon.begin(), horizon.end());
    // Between neighbours it is no lower than the lower, no higher than the higher, but for rounding.
    sin_lowest_ = detail::sine_cosine(*lowest).sin - 1e-9;
    sin_highest_ = detail::sine_cosine(*highest).sin + 1e-9;
}

// In portable arithmetic: whether a hill hides the sun must not depend on the machine.
bool Skyline::shows(const SunDirection& sun) const
{
    if (horizon_.empty() || sun.up > sin_highest_) return true;
    if (sun.up < sin_lowest_) return false;
    const double flat = std::sqrt(sun.east * sun.east + sun.north * sun.north);
    const double angle = flat > 1e-9 ? detail::arc_cosine(sun.north / flat) : 0.0;
    const double azimuth = sun.east < 0.0 ? 2.0 * kPi - angle : angle;
    return sun.up > detail::sine_cosine(horizon_elevation(horizon_, azimuth)).sin;
}

double beam_share(const Skyline& skyline, std::int64_t begin_us, std::int64_t length_us,
                  const Observer& observer, const SunNear& middle)
{
    const std::int64_t parts =
        std::max<std::int64_t>(4, (length_us + kQuarter_us - 1) / kQuarter_us);
    // The sun's place on its yearly way is found once an hour.
    const bool long_one = length_us > 4 * kQuarter_us;
    const std::int64_t hourly =
        long_one ? std::max<std::int64_t>(1, 4 * kQuarter_us * parts / length_us) : parts;
    SunNear track = middle;
    double up = 0.0, past = 0.0;
    for (std::int64_t i = 0; i < parts; ++i) {
        const std::int64_t at_us = begin_us + length_us * (2 * i + 1) / (2 * parts);
        if (long_one && i % hourly == 0)
            track = SunNear(std::min(at_us + 2 * kQuarter_us, begin_us + length_us), observer);
        const SunDirection sun = track.at(at_us);
        if (!(sun.up > 0.0)) continue;
        up += sun.up;
        if (skyline.shows(sun)) past += sun.up;
    }
    return up > 0.0 ? past / up : 1.0;
}

double beam_share(std::span<const double> horizon, std::int64_t begin_us, std::int64_t length_us,
                  double latitude_deg, double longitude_deg)
{
    const Observer observer(latitude_deg, longitude_deg);
    return beam_share(Skyline(horizon), begin_us, length_us, observer,
                      SunNear(begin_us + length_us / 2, observer));
}

void check_horizon(std::span<const double> horizon)
{
    if (horizon.size() > kMostDirections)
        throw Error("horizon: " + std::to_string(horizon.size()) + " azimuths, at most 3600",
                    "A tenth of a degree is fine enough.");
    for (const double elevation : horizon) {
        if (!(elevation >= 0.0 && elevation <= 0.5 * kPi + 1e-9))
            throw Error("horizon: an elevation of " + std::to_string(elevation / kDegree) +
                            " degrees, accepted are 0..90",
                        "Give the elevation of the horizon in degrees above the level.");
    }
}

}  // namespace petrichor::weather
