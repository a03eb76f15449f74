#ifndef PETRICHOR_FILM_JOBS_SCENE_SOURCE_H
#define PETRICHOR_FILM_JOBS_SCENE_SOURCE_H

#include "film/jobs/sequence.h"

namespace petrichor::film {

/// Loads what the scenario shows into the sequence: its scene (a glTF file, or the generated demo
/// "demo:street") with the scenario's materials, the bounds, and the fingerprints of scene, textures
/// and environment pictures. Overrides that match no material are among the scene's warnings.
/// Throws Error for a missing or damaged scene, and for one without triangles.
void load_sequence_scene(Sequence& sequence, int threads);

/// Fingerprint of the GLSL files that the scene's materials name as their lighting models; "" when
/// all are built in. Throws Error for one that cannot be read.
std::string own_models_fingerprint(const scene::Scene& scene);

}  // namespace petrichor::film

#endif
