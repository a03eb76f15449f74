#ifndef PETRICHOR_CLI_DETAIL_WEATHER_TABLE_H
#define PETRICHOR_CLI_DETAIL_WEATHER_TABLE_H

#include "cli/detail/toml_value.h"
#include "cli/weather_file.h"

namespace petrichor::cli {

/// A [weather] table that is parsed already: cli/weather_file.h describes it.
WeatherScript weather_script_from(const TomlValue& weather);

/// An [artist] or [weather.artist] table over the values of `settings`.
ArtistSettings artist_settings_from(const TomlValue& artist, ArtistSettings settings = {});

}  // namespace petrichor::cli

#endif
