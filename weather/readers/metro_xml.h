#ifndef PETRICHOR_WEATHER_READERS_METRO_XML_H
#define PETRICHOR_WEATHER_READERS_METRO_XML_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "weather/forcing/forcing.h"
#include "weather/physics/ground.h"

namespace petrichor::weather {

// Files of METRo (Model of the Environment and Temperature of Roads, Environment Canada): a
// station, what it measured, the forecast of the air, and what METRo made of them. Missing values
// (nothing, 999, 9999) are NaN. All throw Error, with the line, for a text that is no such file.

/// A road weather station.
struct MetroStation {
    Site site;
    bool bridge = false;
    std::vector<GroundLayer> layers;  ///< from the top
    double subsurface_depth_m = 0.4;  ///< of the thermometer in the road (type 0; type 1: 0.2)
    std::vector<double> horizon_rad;  ///< elevation of the horizon at equal azimuths from north
};
MetroStation read_metro_station(std::string_view text);

/// What a station measured: air (K), dew point (K), wind (m/s) as a forcing table, the road, and
/// whether something falls (pi: 1 or 0, NaN where it does not say).
struct MetroObservation {
    ForcingTable table;
    std::vector<double> surface_c, subsurface_c, falling;
    /// Temperatures of the road that were exactly 0 between others that agree and are not near it: a sensor
    /// that said nothing. They are missing above.
    std::size_t fallen_to_zero = 0;
};
MetroObservation read_metro_observation(std::string_view text);
/// A sentence about what fell to zero.
std::string fallen_to_zero_text(const MetroObservation& observed);

/// The weather over the hours that were measured, not filled: air, dew point and wind as measured,
/// pressure that of `forecast` (stations measure none, and METRo's files know no height).
///
/// Clouds are those of `forecast`, full where rain or snow falls in it out of none at all. Before it
/// they are what the measured air tells (cloud_of_air) and the mean of its first kFirstCloud_h
/// hours, kForecastCloudWorth parts of this, the less the longer before: exp(-t /
/// kForecastCloudMemory_h). Were that mean the sky itself, .88 of it would be worth taking just before, .65
/// three hours, .5 six and .34 twelve (Bondville and eight winters of Col de Porte); a forecast is
/// taken to know two thirds of that. Where something falls the sky is overcast, and that fades
/// (kRainCloudMemory_h), never knowing what comes later.
///
/// The place is that of `forecast`; without one the air says less by day.
///
/// Rain, which darkens the sky and wets the road: none where the station says so; 1 mm/h where it
/// says that something falls, the air is above 2 C and within 2 K of its dew point; else that of
/// `forecast` in its hours. Snow is left out: a road that is ploughed is not as white as its sky.
/// Rows of `forecast` that come after the last measured one follow, without its radiation and snow.
inline constexpr double kForecastCloudWorth = 0.6, kForecastCloudMemory_h = 10.0,
                        kRainCloudMemory_h = 24.0, kFirstCloud_h = 3.0;
ForcingTable observed_weather(const MetroObservation& observed, const ForcingTable& forecast);

/// Forecast of the air. Amounts since the beginning (mm of rain, cm of snow) become rates of the
/// rows; sf and ir, where the file has them, are shortwave and longwave.
ForcingTable read_metro_forecast(std::string_view text);

/// METRo's own answer: the road's temperature, its condition, and the fluxes it used. Its sf and ir
/// are what the road takes up.
struct MetroRoadcast {
    std::vector<std::int64_t> time_us;
    std::vector<double> air_c, dew_point_c, wind_m_s, surface_c, subsurface_c;
    std::vector<double> shortwave_w_m2, longwave_w_m2, rain_mm_h, snow_mm_h;
    std::vector<int> condition;
};
MetroRoadcast read_metro_roadcast(std::string_view text);

/// A layer of a material that METRo knows (asphalt, cement, concrete, crushed rock, gravel, sand;
/// blanks and hyphens do not matter) with METRo's values (sand: dry), or nothing for another word.
std::optional<GroundLayer> road_layer(std::string_view material, double thickness_m);

/// True for a text that begins like one of these files.
bool looks_like_metro(std::string_view text);

}  // namespace petrichor::weather

#endif
