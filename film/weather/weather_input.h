#ifndef PETRICHOR_FILM_WEATHER_WEATHER_INPUT_H
#define PETRICHOR_FILM_WEATHER_WEATHER_INPUT_H

#include <string>
#include <vector>

#include "film/scenario/site_options.h"
#include "film/scenario/weather_script.h"
#include "film/weather/inputs.h"
#include "weather/readers/read_weather.h"

namespace petrichor::film {

/// The [site] table of a parameter TOML under what the command line says. Other tables but [artist]
/// are errors.
SiteOptions with_site_table(SiteOptions options, const std::string& toml_text);

/// Reads weather files as one series, filled, with the sensor heights of the options.
///   throws  Error as weather::read_weather_files, for heights or months out of range, and for a
///           gap of more than max_gap_days: years without weather are a slip more often than a wish
weather::ReadResult read_forcing(const std::vector<Input>& files, const SiteOptions& options);

/// The artist model's script of a weather file: the map of artist_keys(). time_s counts seconds of
/// the file; an hour of the file is a second of the model (time_scale 1/3600) unless `params` say
/// otherwise.
WeatherScript script_of_forcing(const weather::ForcingTable& table, const std::string& name);

/// The same weather in less time: every key `factor` times as early, the model as much faster. For
/// films: with 3600 an hour of a weather file is a second.
WeatherScript faster_script(WeatherScript script, double factor);

/// The script with its keys repeated every duration_s until `end_s`, where it says `loop`; else as
/// it is. A loop ends where the next begins: there the inputs jump.
///   throws  Error when that takes more than a million keys
WeatherScript looped_script(WeatherScript script, double end_s);

/// Lines of text, for notes.
std::vector<std::string> lines_of(const std::string& text);

}  // namespace petrichor::film

#endif
