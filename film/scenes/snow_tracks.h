#ifndef PETRICHOR_FILM_SCENES_SNOW_TRACKS_H
#define PETRICHOR_FILM_SCENES_SNOW_TRACKS_H

#include <string>
#include <vector>

#include "film/scenario/scenario.h"
#include "gpu/frame/weather_maps.h"

namespace petrichor::film {

/// A way that feet or tyres have gone.
struct TrackWay {
    bool tyre = true;
    bool one_print = false;           ///< a foot is set down once, in the middle
    double width_m = 0.22;            ///< of a tyre or a foot
    double gauge_m = 0.0;             ///< between two tyres; 0: one alone
    double depth = 1.0;               ///< 0 nothing .. 1 as deep as the snow lets them
    std::vector<glm::dvec2> points;   ///< world x and z
    std::vector<double> left;         ///< of the depth at each of them, 0..1; empty: all
    double low_y_m = 0.0, high_y_m = 0.0;
};

/// A way of the list, which has points.
TrackWay listed_way(const ScenarioTrack& track);

/// The map that these ways need, without its texels. Listed ways are told by their points.
gpu::TrackMap track_area(const std::vector<ScenarioTrack>& listed, const std::vector<TrackWay>& others);
/// The ways on it. They may be any part of those that the area was made for.
gpu::TrackMap draw_ways(gpu::TrackMap area, const std::vector<TrackWay>& ways);

/// Draws tracks from above, 1 cm a texel, coarser where they go further than 19 m. Feet of 28 by 10 cm
/// step every 0.75 m; fresh snow of 100 kg/m3 is pressed to 400 by feet and 550 by tyres, with rims beside
/// them; tyres throw it aside, soles leave a fifth of it packed below them. The same list gives the same bytes.
gpu::TrackMap draw_tracks(const std::vector<ScenarioTrack>& tracks);

/// Of the list; "" without any.
std::string tracks_fingerprint(const std::vector<ScenarioTrack>& tracks);
/// Of ways and what is left of them.
std::string ways_fingerprint(const std::vector<TrackWay>& ways);

}  // namespace petrichor::film

#endif
