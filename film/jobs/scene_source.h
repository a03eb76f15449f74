#ifndef PETRICHOR_FILM_JOBS_SCENE_SOURCE_H
#define PETRICHOR_FILM_JOBS_SCENE_SOURCE_H

#include "film/jobs/sequence.h"

namespace petrichor::film {

/// Loads what the scenario shows into the sequence: its scene (a glTF file, or the generated demo
/// "demo:street"), the bounds, and the fingerprints of scene and environment pictures.
/// Throws Error for a missing or damaged scene, and for one without triangles.
void load_sequence_scene(Sequence& sequence, int threads);

}  // namespace petrichor::film

#endif
