#ifndef PETRICHOR_FILM_WEATHER_ARTIST_ICE_H
#define PETRICHOR_FILM_WEATHER_ARTIST_ICE_H

#include <vector>

#include "formulas/weather/moment.h"
#include "weather/models/artist/exact.h"

namespace petrichor::film {

/// Water of the artist model that has frozen where it stood. The model itself (Lux 2.02) turns it into
/// snow; pictures keep it as ice in cracks and puddles, which a thaw gives back.
struct ArtistIce {
    double cracks = 0.0, puddles = 0.0;  ///< on top of the model's: ice, and what has melted of it
    double not_snow = 0.0;               ///< of the model's snow: was water, and has not fallen
    double film = 0.0;                   ///< clear ice of its wetness and of rain that fell in the cold, 0..1 as that
};

/// A moment of the model with that ice in its cracks and puddles, its film where clear ice is that, and less snow.
shared::WeatherMoment with_ice(shared::WeatherMoment moment, const ArtistIce& ice);

/// The ice of a script over time: solved once, in steps of a sixteenth of a second and more for films
/// longer than two minutes, from the start of the script; linear between.
class ArtistIceTimeline {
public:
    explicit ArtistIceTimeline(const weather::ArtistTimeline& weather);

    ArtistIce at(double time_s) const;
    /// How thick its film is then, mm.
    double glaze_mm(double time_s) const;

private:
    double start_s_ = 0.0, step_s_ = 1.0;
    std::vector<ArtistIce> steps_;
};

}  // namespace petrichor::film

#endif
