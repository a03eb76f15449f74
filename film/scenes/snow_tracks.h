#ifndef PETRICHOR_FILM_SCENES_SNOW_TRACKS_H
#define PETRICHOR_FILM_SCENES_SNOW_TRACKS_H

#include <string>
#include <vector>

#include "film/scenario/scenario.h"
#include "gpu/frame/weather_maps.h"

namespace petrichor::film {

/// Draws tracks from above, 1 cm a texel, coarser where they go further than 19 m. Feet of 28 by 10 cm
/// step every 0.75 m; fresh snow of 100 kg/m3 is pressed to 400 by feet and 550 by tyres, with rims beside
/// them (Shapiro et al. 1997, CRREL 97-3). The same list gives the same bytes.
gpu::TrackMap draw_tracks(const std::vector<ScenarioTrack>& tracks);

/// Of the list; "" without any.
std::string tracks_fingerprint(const std::vector<ScenarioTrack>& tracks);

}  // namespace petrichor::film

#endif
