#ifndef PETRICHOR_WEATHER_FORCING_CUT_FORCING_H
#define PETRICHOR_WEATHER_FORCING_CUT_FORCING_H

#include "weather/forcing/forcing.h"

namespace petrichor::weather {

/// The rows inside ]begin, end[ with a row at either: "at" fields as value_at, a rate as that of
/// the row before (0 before the first row). `begin_us` must be below `end_us`.
ForcingTable cut_forcing(const ForcingTable& table, std::int64_t begin_us, std::int64_t end_us);

}  // namespace petrichor::weather

#endif
