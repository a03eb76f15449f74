#ifndef PETRICHOR_WEATHER_PHYSICS_CLOUD_OF_AIR_H
#define PETRICHOR_WEATHER_PHYSICS_CLOUD_OF_AIR_H

#include <cstdint>
#include <span>
#include <vector>

namespace petrichor::weather {

/// Cloud that a day of air tells of, 0..1: half a cover where its mean humidity is 45 % or less, a
/// full one where it is 97 % or more, 0.5 + 0.5 ((RH - 45) / 52)^2 between.
///
/// Humidity of an hour follows the hour's temperature; that of a day follows the sky. Fitted to what
/// clouds sent and took (longwave, sunlight) at Bondville and in nine winters of Col de Porte
/// (docs/weather.md): neither has half a cover in the mean, as is taken where nothing is known.
double cloud_of_humidity(double mean_rel_humidity_pct);

/// The same for every row of a series, of the mean over the rows within twelve hours of it.
///   time_us            increasing
///   rel_humidity_pct   as many; NaN says nothing
///   returns            NaN where no row within twelve hours has a humidity
std::vector<double> cloud_of_air(std::span<const std::int64_t> time_us,
                                 std::span<const double> rel_humidity_pct);

}  // namespace petrichor::weather

#endif
