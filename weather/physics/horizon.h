#ifndef PETRICHOR_WEATHER_PHYSICS_HORIZON_H
#define PETRICHOR_WEATHER_PHYSICS_HORIZON_H

#include <cstdint>
#include <span>
#include <vector>

#include "weather/physics/solar.h"

namespace petrichor::weather {

/// What hills, houses and trees hide of the sky: the elevation, rad in 0..pi/2, at equal azimuths
/// from north over east. Empty: an open plain.
using Horizon = std::vector<double>;

/// Elevation at an azimuth (rad from north over east), linear between the given ones.
double horizon_elevation(std::span<const double> horizon, double azimuth_rad);

/// Share of an even sky's light that flat ground gets: the mean of cos^2 of the elevation; 1 in the
/// open.
double horizon_sky_view(std::span<const double> horizon);

/// A horizon made ready to be asked whether it hides the sun. The elevations stay where they are.
class Skyline {
public:
    Skyline() = default;
    explicit Skyline(std::span<const double> horizon);
    bool empty() const { return horizon_.empty(); }
    bool shows(const SunDirection& sun) const;

private:
    std::span<const double> horizon_;
    double sin_lowest_ = 0.0, sin_highest_ = 0.0;
};

/// Share of the sun's beam on flat ground that gets past the horizon between two times: positions
/// at least every quarter of an hour, weighted by the sine of the sun's elevation. 1 where the sun
/// does not rise.
///   middle  the sun about the middle between them
double beam_share(const Skyline& skyline, std::int64_t begin_us, std::int64_t length_us,
                  const Observer& observer, const SunNear& middle);
/// .. of one time alone.
double beam_share(std::span<const double> horizon, std::int64_t begin_us, std::int64_t length_us,
                  double latitude_deg, double longitude_deg);

/// Throws Error when an elevation is not in 0..pi/2 or there are more than 3600.
void check_horizon(std::span<const double> horizon);

}  // namespace petrichor::weather

#endif
