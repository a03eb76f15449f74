#ifndef PETRICHOR_FILM_JOBS_WEATHER_SOURCE_H
#define PETRICHOR_FILM_JOBS_WEATHER_SOURCE_H

#include <filesystem>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "film/scenario/scenario.h"
#include "weather/moment.h"

namespace petrichor::film {

/// Weather as a sequence needs it: a function of the time.
struct WeatherSource {
    std::string name;         ///< of the preset or file
    double duration_s = 0.0;  ///< of the clock, to the last key; 0 for weather that never changes
    std::function<weather::Moment(double time_s)> at;
    std::vector<std::string> notes;  ///< what was guessed, filled and spun up; a line each
    /// Of a weather file under the physical model: what it runs on, for every patch of a scene.
    std::shared_ptr<const weather::ForcingTable> table = nullptr;
    weather::PhysicalParams physical = {};
    std::function<std::int64_t(double time_s)> utc_us = nullptr;
    /// Under the artist model: its keys, repeated where they loop, and the film's 0 s on them.
    std::shared_ptr<const WeatherScript> script = nullptr;
    double script_offset_s = 0.0;
};

/// The weather of a scenario's [weather]: a preset, keys, or a weather file under the physical
/// (default) or the artist model; a dry clear day when there is none of them.
///
/// The physical model runs over the whole file from its first row (or spin_up_days before `start`),
/// so that the film begins with the ground as the weather before left it. Before the file's first
/// and after its last row the ground stays as it is there; the sun goes on.
///
///   folder   where relative names of files are looked for first
///   end_s    of the clock: weather that loops is repeated until then
///   throws   Error when there is no such preset or file, for the physical model without a file,
///            and for times outside of the file
WeatherSource weather_source(const ScenarioWeather& weather, const std::filesystem::path& folder,
                             const std::string& scenario_name, double end_s);

/// What a name on the command line means, put into `weather` in place of what is there: a preset, a
/// .toml file, or a weather file. The other options (model, start ..) stay.
void name_weather(ScenarioWeather& weather, const std::string& name,
                  const std::filesystem::path& folder);

}  // namespace petrichor::film

#endif
