#ifndef PETRICHOR_WEATHER_READERS_ROAD_EVENTS_TEXT_H
#define PETRICHOR_WEATHER_READERS_ROAD_EVENTS_TEXT_H

#include <string>
#include <string_view>
#include <vector>

#include "weather/models/physical/road_events.h"

namespace petrichor::weather {

/// Events from text: lines "time,salt|brine|plough,amount", times as 2004-01-30T14:00 or with a
/// zone; a heading and lines that begin with # are passed over. Sorted by time, in the order of the
/// lines where times are equal.
///   utc_offset_s  of times without a zone
///   name          of the file, for errors
///   throws        Error with the line for what cannot be read or is out of range
std::vector<RoadEvent> read_road_events(std::string_view text, const std::string& name,
                                        double utc_offset_s);

}  // namespace petrichor::weather

#endif
