#ifndef PETRICHOR_FILM_WEATHER_ARTIST_PLACES_H
#define PETRICHOR_FILM_WEATHER_ARTIST_PLACES_H

#include <memory>

#include "film/scenario/weather_script.h"
#include "film/weather/artist_taps.h"
#include "film/weather/patch_weather.h"
#include "weather/patches/place_factors.h"

namespace petrichor::film {

/// The script as it is at a place: rain, drying, freezing and snow by its factors, what is set by
/// hand too.
WeatherScript script_at_place(const WeatherScript& script, const weather::PlaceFactors& factors);

/// Keys of the artist model on the patches of a scene: places whose factors are nearly the same
/// (steps of a quarter, or finer) share a solved script. Copies share their scripts.
class ArtistPlaces {
public:
    /// Factors are means over the script, by how much falls at its times: of its winds.
    ///   clock  of the taps among the sites
    ArtistPlaces(const SceneSites& sites, const WeatherScript& script, double latitude_deg,
                 double north_deg, const KeyedTaps& clock = {});

    /// The weather of every patch at a time of the script. Hollows hold what a film of puddles,
    /// 20 mm where they are full, has left in them.
    std::shared_ptr<const gpu::PlaceWeather> at(double time_s) const;
    std::size_t scripts() const;  ///< solved

private:
    struct Impl;
    std::shared_ptr<const Impl> impl_;
};

}  // namespace petrichor::film

#endif
