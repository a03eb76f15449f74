#ifndef PETRICHOR_FILM_JOBS_SCENE_PLACES_H
#define PETRICHOR_FILM_JOBS_SCENE_PLACES_H

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "film/frames/frames_jsonl.h"
#include "film/jobs/sequence.h"
#include "film/weather/artist_places.h"
#include "film/weather/hollows.h"
#include "film/weather/patch_weather.h"

namespace petrichor::film {

/// The weather of the places of a sequence's scene: of every variant that runs a weather file under
/// the physical model and of keys of the artist model, unless [ground] patches is off. Keys of scenes
/// whose light is not of patches have no places unless that is on.
class ScenePlaces {
public:
    /// Cuts the scene into patches, or finds them in the cache; the scene must still hold its
    /// encoded images. Notes are appended. Throws Error, and Interrupted when `stop` says so.
    ScenePlaces(const Sequence& sequence, int threads, const StopRequest& stop,
                const scene::PatchProgress& progress, std::vector<std::string>& notes);

    /// Gives a frame the weather of its places, and the facts the sums over them.
    void place(const Sequence& sequence, const Job& job, SequenceFrame& frame, FrameFacts& facts);

private:
    std::optional<SceneSites> sites_;
    std::optional<Hollows> hollows_;                  // where there are no sites
    std::map<std::string, PlaceWeatherOfFile> runs_;  // by variant
    std::map<std::string, ArtistPlaces> keyed_;       // likewise
    int threads_ = 1;
};

}  // namespace petrichor::film

#endif
