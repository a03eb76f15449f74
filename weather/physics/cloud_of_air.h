#ifndef PETRICHOR_WEATHER_PHYSICS_CLOUD_OF_AIR_H
#define PETRICHOR_WEATHER_PHYSICS_CLOUD_OF_AIR_H

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace petrichor::weather {

/// Highest less lowest temperature of a day of that humidity in the mean: 12 K to 60 %, 0.18 K less
/// for each per cent above (Bondville, Col de Porte, Denver, Greensboro).
double ordinary_range_k(double mean_rel_humidity_pct);

/// What a day of air at two metres says of its sky.
struct DayOfAir {
    double mean_rel_humidity_pct = 0.0;  ///< of the 24 hours around
    double range_k = std::numeric_limits<double>::quiet_NaN();  ///< highest less lowest temperature
                                                                 ///< of these hours; NaN: unknown
    double damper_pct = 0.0;  ///< humidity of the five hours around less that mean; 0 says nothing
};

/// Cloud that a day of air tells of, 0..1:
/// 0.70 + 0.22 x^2 - 0.025 (range - 8 K) + 0.0046 damper, x = (RH - 45) / 52 within 0 and 1.
///
/// Humidity of an hour follows the hour's temperature; that of a day follows the sky. Sunlight warms
/// the air and a clear night cools it: a day of small range was overcast (Bristow & Campbell 1984),
/// and air that stays damp by day has no sun in it. The four numbers are fitted to what clouds sent
/// and took (longwave, sunlight) at Bondville and in eight winters of Col de Porte
/// (docs/weather.md); those of one place serve the other.
double cloud_of_day(const DayOfAir& day);

/// Rows of air, increasing in time; NaN says nothing.
struct AirRows {
    std::span<const std::int64_t> time_us;
    std::span<const double> rel_humidity_pct;  ///< as many
    std::span<const double> air_temp_k;        ///< as many, as measured: a line has no range
    std::span<const double> sine;  ///< of the sun's elevation, as many; or none: not known
};

/// The same for every row of a series, of the rows within twelve hours of it. A range counts in full
/// where temperatures at most three hours apart span a whole day, not at all (but an ordinary one)
/// where they span half of one; damper air where the sun is up.
///   returns            NaN where no row within twelve hours has a humidity
std::vector<double> cloud_of_air(const AirRows& rows);

}  // namespace petrichor::weather

#endif
