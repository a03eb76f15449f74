#ifndef PETRICHOR_FILM_SCENARIO_WEATHER_TABLE_H
#define PETRICHOR_FILM_SCENARIO_WEATHER_TABLE_H

#include "film/scenario/weather_script.h"
#include "film/toml/toml_value.h"

namespace petrichor::film {

/// A [weather] table that is parsed already: film/scenario/weather_script.h describes it.
WeatherScript weather_script_from(const TomlValue& weather);

/// An [artist] or [weather.artist] table over the values of `settings`.
ArtistSettings artist_settings_from(const TomlValue& artist, ArtistSettings settings = {});

}  // namespace petrichor::film

#endif
