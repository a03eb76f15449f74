#ifndef PETRICHOR_WEATHER_READERS_STATION_REGIONS_H
#define PETRICHOR_WEATHER_READERS_STATION_REGIONS_H

#include <optional>
#include <string_view>

namespace petrichor::weather {

/// The middle of the region that the first letters of an ICAO station name stand for.
struct StationRegion {
    std::string_view name;
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
};

/// A few degrees to a few tens of degrees off: good for day and night and the season, not for
/// shadows. Nothing for letters that are not assigned. Source: ICAO Doc 7910, regions of letters.
std::optional<StationRegion> region_of_station(std::string_view station);

}  // namespace petrichor::weather

#endif
