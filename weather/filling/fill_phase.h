#ifndef PETRICHOR_WEATHER_FILLING_FILL_PHASE_H
#define PETRICHOR_WEATHER_FILLING_FILL_PHASE_H

#include "weather/forcing/forcing.h"

namespace petrichor::weather {

/// Where the observed snow depth rises by a centimetre or more, within a day and below 4 C, what
/// fell in between was snow: SnowShare becomes 1 there, where the file does not tell the phase. A
/// depth that stays or falls says nothing. To be asked before gaps are filled; adds to the report.
void phase_from_depth(ForcingTable& table, ReadReport& report);

}  // namespace petrichor::weather

#endif
