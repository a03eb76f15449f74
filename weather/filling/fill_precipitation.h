#ifndef PETRICHOR_WEATHER_FILLING_FILL_PRECIPITATION_H
#define PETRICHOR_WEATHER_FILLING_FILL_PRECIPITATION_H

#include <vector>

#include "weather/forcing/forcing.h"

// The part of fill_forcing that concerns precipitation, in the order in which it is done.
namespace petrichor::weather {

/// Rows in which the file says how much fell; to be asked before anything is filled.
std::vector<bool> known_precipitation(const ForcingTable& table);

/// The total from rain and snow, or nothing at all, where it is missing.
void fill_precipitation(ForcingTable& table, ReadReport& report);

/// Rates where the file has no amount and the sky is such that it may well fall; needs humidity and
/// cloud.
void estimate_precipitation(ForcingTable& table, ReadReport& report,
                            const std::vector<bool>& known);

/// A warning that counts the rows without an amount.
void warn_of_dry_gaps(ReadReport& report, const std::vector<bool>& known, bool estimated);

}  // namespace petrichor::weather

#endif
