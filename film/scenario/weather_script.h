#ifndef PETRICHOR_FILM_SCENARIO_WEATHER_SCRIPT_H
#define PETRICHOR_FILM_SCENARIO_WEATHER_SCRIPT_H

#include <string>
#include <string_view>

#include "weather/models/artist/exact.h"
#include "weather/models/artist/model.h"
#include "weather/models/artist/timeline.h"
#include "weather/moment.h"

namespace petrichor::film {

/// A weather preset, or the [weather] table of a scenario: what drives the artist model, and the
/// sky that goes with it.
///
///   name = "drizzle"                      # optional, top level
///   description = "A grey afternoon."     # optional, top level
///
///   [weather]
///   model = "artist"                      # the default, and the only model of these files
///   interpolation = "linear"              # hold, linear (default) or smooth
///   duration_s = 48.0                     # default: time of the last key
///   loop = false                          # true: the keys begin again after duration_s
///   keys = [
///     { time_s =  0, temperature_c = 12, rainfall = 0.0, cloud_cover = 0.3 },
///     { time_s = 10, temperature_c = 11, rainfall = 0.6 },   # a key may leave out what does not
///     change
///   ]
///
///   [weather.artist]                      # parameters of the model, as in [artist] of --params
///   time_scale = 0.5
///   [weather.artist.initial]              # state at 0 s
///   water_to_snow = 0.0
///
/// A key holds time_s (ascending) and any of: temperature_c (-100..60), rainfall (0..1: rain or
/// snow), cloud_cover (0 clear .. 1 overcast), wind_m_s (0..80), wind_from_deg (where it comes
/// from; 0 north, 90 east; may pass 360 to keep turning), visibility_m (20..200000, 2 % contrast),
/// sun_elevation_deg (-90..90) and sun_azimuth_deg (where [sun] of the scenario does not say),
/// and any number of [artist]; script_controlled (1 on, 0 off: the state is set by hand) and, for
/// while it is off, wetness, cracks, puddles, snow, water_to_snow (0..1). In SI, by the inverse of
/// part C's maps on asphalt: rain_mm_h for rainfall (0..50), film_mm for wetness (0..9.5),
/// snow_depth_m for snow (0..1.9), puddle_depth_m for puddles (0..0.015). Each quantity is
/// interpolated between the keys that name it; one that no key names keeps the default below, or
/// the parameter's own value. With interpolation "smooth" a quantity that is not in SI may bring its
/// tangents: [value, slope] or [value, slope_in, slope_out], a change a second, instead of those
/// that never overshoot; what then leaves the quantity's range is an error.
struct WeatherScript {
    std::string name;
    std::string description;
    double duration_s = 0.0;
    bool loop = false;  ///< the keys begin again after duration_s; the state goes on
    weather::Timeline timeline;
    weather::ArtistParams params;
    weather::ArtistState initial;
    weather::SkyChannels sky;
    /// Where the sun stands; empty: the scenario says. Azimuth clockwise from north.
    weather::Channel sun_elevation_deg, sun_azimuth_deg;

    /// The solved weather, for any time.
    weather::ArtistTimeline solve() const
    {
        return weather::ArtistTimeline(timeline, params, initial);
    }
};

/// Reads [weather] (and name, description) from TOML text; other tables are not looked at, so the
/// text may be a whole scenario. `file` names the text in messages. Throws Error for syntax,
/// unknown names (with the nearest that exists), types, ranges and order.
WeatherScript read_weather_script(std::string_view toml_text, const std::string& file);

/// [artist] and [artist.initial] of a parameter file (petrichor simulate --params); a [site] is
/// left to others. `time_scale` is that of the model where the file does not say.
struct ArtistSettings {
    weather::ArtistParams params;
    weather::ArtistState initial;
};
ArtistSettings read_artist_settings(std::string_view toml_text, const std::string& file,
                                    double time_scale = 1.0);

}  // namespace petrichor::film

#endif
