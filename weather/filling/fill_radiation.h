#ifndef PETRICHOR_WEATHER_FILLING_FILL_RADIATION_H
#define PETRICHOR_WEATHER_FILLING_FILL_RADIATION_H

#include <vector>

#include "weather/forcing/forcing.h"

// The part of fill_forcing that concerns sun, sky and cloud.
namespace petrichor::weather {

/// Divides rows of more than an hour and at most two days into hours where the file has no
/// shortwave, and gaps that are longer than those bridged by a line and at most 100 days long (not
/// where they would be most of the table); adds to the report how many rows that makes. Columns may have gaps.
void divide_for_the_sun(ForcingTable& table, ReadReport& report, const FillOptions& options);

/// Cloud, then shortwave, then longwave: each from what is there. Needs air temperature and
/// humidity; net shortwave, where it is used, follows the shortwave made here.
///   measured_air_k  air temperature of each row, NaN where the file has none of its own
void fill_radiation(ForcingTable& table, ReadReport& report,
                    const std::vector<double>& measured_air_k);

}  // namespace petrichor::weather

#endif
