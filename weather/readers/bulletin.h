#ifndef PETRICHOR_WEATHER_READERS_BULLETIN_H
#define PETRICHOR_WEATHER_READERS_BULLETIN_H

#include <string_view>
#include <vector>

#include "weather/readers/collector.h"
#include "weather/readers/metar.h"
#include "weather/readers/taf.h"

namespace petrichor::weather {

/// The reports and forecasts of a text, in its order, of all stations.
struct Bulletin {
    std::vector<MetarReport> reports;
    std::vector<TafForecast> forecasts;
};

/// Finds the reports in the lines: wrapped or not, with or without the word METAR, headings and the
/// = at the end. What begins like a report and is none becomes a bad row of `rows`.
Bulletin read_bulletin(std::string_view text, RowCollector& rows);

}  // namespace petrichor::weather

#endif
