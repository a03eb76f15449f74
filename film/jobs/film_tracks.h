#ifndef PETRICHOR_FILM_JOBS_FILM_TRACKS_H
#define PETRICHOR_FILM_JOBS_FILM_TRACKS_H

#include <memory>
#include <string>

#include "film/jobs/sequence.h"

namespace petrichor::film {

/// All tracks of a film in snow, listed ones and those of nodes. With nodes among them TrackMap::over_time.
gpu::TrackMap all_tracks(const Sequence& sequence);

/// Draws what of them is there at a second of the film under a variant's weather; null where no node leaves
/// any. It needs no sequence afterwards.
std::shared_ptr<const gpu::TrackSource> track_source(const Sequence& sequence, const std::string& variant);

/// What of the tracks of nodes is there at a second of the film; "" where no node leaves any.
std::string tracks_at(const Sequence& sequence, const std::string& variant, double film_s);

}  // namespace petrichor::film

#endif
