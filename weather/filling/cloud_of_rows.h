#ifndef PETRICHOR_WEATHER_FILLING_CLOUD_OF_ROWS_H
#define PETRICHOR_WEATHER_FILLING_CLOUD_OF_ROWS_H

#include <cstddef>
#include <vector>

#include "weather/forcing/forcing.h"

namespace petrichor::weather {

/// How many rows got their cloud in each way.
struct CloudFills {
    std::size_t from_sun = 0, from_sky = 0, falling = 0, from_air = 0;
};

/// Whether 0.1 mm/h or more falls in a row.
bool falls_in(const ForcingTable& table, std::size_t row);

/// What the hour of a row adds to the emissivity of its clear sky (emissivity_of_hour); 0: no place
/// is known.
double emissivity_of_row(const ForcingTable& table, std::size_t row);

/// Cloud of all rows, 0..1: the file's own where it has one; 1 where something falls or in fog;
/// else from shortwave (from the diffuse share of it where that is known), else from longwave.
///
/// Rows without any of these lie between two that have one. Where those know it from the sun, it is
/// the light that clouds took in the six hours of sun before and in the six after, weighted by the
/// clear sky, and between the two a line: a low sun alone tells little. Otherwise it is kept from
/// the row before, and without one told by the air of a day (cloud_of_air).
///   sine  of the sun's elevation, of each row; unused where the file has cloud
///   sun_is_known  the file has a place
///   measured_air_k  air temperature of each row, NaN where the file has none of its own
std::vector<double> cloud_of_rows(const ForcingTable& table, const std::vector<double>& sine,
                                  bool sun_is_known, const std::vector<double>& measured_air_k,
                                  CloudFills& fills);

}  // namespace petrichor::weather

#endif
