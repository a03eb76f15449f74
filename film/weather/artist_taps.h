#ifndef PETRICHOR_FILM_WEATHER_ARTIST_TAPS_H
#define PETRICHOR_FILM_WEATHER_ARTIST_TAPS_H

#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "film/scenario/weather_script.h"
#include "film/weather/tap_sites.h"
#include "scene/basins/hierarchy.h"

namespace petrichor::film {

/// How the clock of a film goes with that of its script, and how long taps are followed.
struct KeyedTaps {
    double hours_per_second = 1.0;  ///< of the time in which water is let in, > 0
    double offset_s = 0.0;          ///< time of the script at 0 s of the film
    double until_s = 0.0;           ///< of the script
};

/// When water runs over a place, in seconds of the script, and how warm it is.
struct TapSpan {
    double from_s = -std::numeric_limits<double>::infinity();
    double to_s = std::numeric_limits<double>::infinity();
    double water_c = 10.0;
    bool operator==(const TapSpan&) const = default;
};

/// The script of a place that water of taps runs over: while it does, all of it is as wet as in full
/// rain, and no colder than the water.
///   open  the script without the factors of the place, `here` with them
WeatherScript script_below_taps(const WeatherScript& open, WeatherScript here,
                                const std::vector<TapSpan>& spans);

/// Water of taps under keys of the artist model, whose puddles are 20 mm of rain where they are full: it
/// runs along its stretches as under a weather file, and is lost from its hollows as puddles dry.
/// Followed once, in steps of an eighth of a second, or more for long scripts.
class ArtistTaps {
public:
    ArtistTaps(const std::vector<TapSite>& sites, const scene::Basins& basins,
               const WeatherScript& script, const KeyedTaps& clock);

    /// Patches that water runs over at some time, and when.
    const std::map<std::uint32_t, std::vector<TapSpan>>& wetted() const { return wetted_; }
    /// What of it stands over the pits at a time, m3 by label; empty: none anywhere.
    std::vector<double> in_pits_m3(double time_s) const;

private:
    using Stood = std::vector<std::pair<std::uint32_t, double>>;  // pit, m3
    std::map<std::uint32_t, std::vector<TapSpan>> wetted_;
    std::size_t pits_ = 0;
    double start_s_ = 0.0, step_s_ = 1.0;
    std::vector<Stood> steps_;
};

}  // namespace petrichor::film

#endif
