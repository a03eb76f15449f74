#ifndef PETRICHOR_FILM_JOBS_BRIDGE_H
#define PETRICHOR_FILM_JOBS_BRIDGE_H

#include <glm/glm.hpp>

#include "film/scenario/weather_script.h"
#include "formulas/weather/moment.h"
#include "weather/models/artist/exact.h"
#include "weather/models/artist/timeline.h"

namespace petrichor::film {

// The one place that knows the types of two rooms: the state of the weather becomes what the
// renderer draws. What the artist model does not have (frost, clouds, sight) is derived here, each
// in one function of the timeline and the time, so that any frame can be rendered alone.

/// What a frame needs to know about its weather.
struct WeatherMoment {
    shared::WeatherMoment surface{.cloud_fraction = 0.1f};
};

/// Hoar frost, 0..1: grows in the cold while nothing falls, faster the colder (full after about 12
/// s of clear -10 C), goes four times as fast above zero. time_scale speeds it up as it does the
/// model. The minute before the time decides; a fixed grid of quarter seconds keeps frames
/// independent.
double frost_at(const weather::Timeline& timeline, double time_s, double time_scale);

/// Clouds come a little before rain and leave a little after: the rainfall around the time, spread
/// over a twelfth of the timeline, mapped from 0.12 (dry) to 0.95.
double cloud_cover_at(const weather::Timeline& timeline, double time_s);

/// How far one sees at 2 % contrast, metres: 20 km in clear air, about 3 km in full rain and 600 m
/// in full snowfall (extinctions add up, Koschmieder's law).
double visibility_m(double rain, double snowfall);

/// Where the air goes, x and z, from where it comes from: 0 degrees north (-z), 90 east (+x).
glm::vec2 wind_vector_m_s(double speed_m_s, double from_deg);

/// The weather of a moment. Clouds and sight are those of the script where it has keys for them.
WeatherMoment weather_moment(const WeatherScript& script, const weather::ArtistTimeline& weather,
                             double time_s);

}  // namespace petrichor::film

#endif
