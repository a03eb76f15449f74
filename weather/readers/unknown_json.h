#ifndef PETRICHOR_WEATHER_READERS_UNKNOWN_JSON_H
#define PETRICHOR_WEATHER_READERS_UNKNOWN_JSON_H

#include "weather/readers/json.h"

namespace petrichor::weather {

/// Refuses JSON that no reader knows: an Error that says what it holds and which kinds are read.
[[noreturn]] void refuse_unknown_json(const Json& whole);

}  // namespace petrichor::weather

#endif
