#ifndef PETRICHOR_FILM_WEATHER_WEATHER_INPUT_H
#define PETRICHOR_FILM_WEATHER_WEATHER_INPUT_H

#include <optional>
#include <string>
#include <vector>

#include "film/scenario/weather_script.h"
#include "film/weather/inputs.h"
#include "weather/readers/read_weather.h"

namespace petrichor::film {

/// What the command line says about a weather file. What is not given comes from the file, then
/// from defaults.
struct SiteOptions {
    std::optional<double> latitude_deg, longitude_deg, elevation_m, temp_height_m, wind_height_m;
    std::optional<double> sky_view, canopy_vai;  ///< as in weather::PhysicalParams
    std::string surface = "asphalt";
    std::string station;                 ///< of a METAR file
    std::string month;                   ///< "2024-02": of METAR reports, which name only the day
    std::string missing_precip = "dry";  ///< dry or estimate
    std::string ignore;                  ///< columns that may stay unread, by comma, or all
    double max_gap_days = 60.0;          ///< between two rows; longer ones are asked about
    std::string taf = "expected";        ///< expected, prevailing or worst: TEMPO and PROB groups
};

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

/// Lines of text, for notes.
std::vector<std::string> lines_of(const std::string& text);

}  // namespace petrichor::film

#endif
