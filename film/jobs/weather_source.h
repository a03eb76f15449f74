#ifndef PETRICHOR_FILM_JOBS_WEATHER_SOURCE_H
#define PETRICHOR_FILM_JOBS_WEATHER_SOURCE_H

#include <functional>
#include <string>

#include "film/jobs/bridge.h"
#include "film/scenario/scenario.h"

namespace petrichor::film {

/// Weather as the sequence needs it: a function of the time.
struct WeatherSource {
    std::string name;         ///< of the preset or file
    double duration_s = 0.0;  ///< to the last key; 0 for weather that never changes
    std::function<WeatherMoment(double time_s)> at;
};

/// The weather that a command asks for: `asked` (the name of a preset, a .toml file, or any weather
/// file, of which an hour is a second of the film), else the scenario's [weather], else a dry clear
/// day. Throws Error when there is no such preset or file.
WeatherSource weather_source(const Scenario& scenario, const std::string& asked);

}  // namespace petrichor::film

#endif
