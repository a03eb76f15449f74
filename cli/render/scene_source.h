#ifndef PETRICHOR_CLI_SCENE_SOURCE_H
#define PETRICHOR_CLI_SCENE_SOURCE_H

#include "cli/render/sequence.h"

namespace petrichor::cli {

/// Loads what the scenario shows into the sequence: its scene (a glTF file, or the generated demo
/// "demo:street"), the bounds, and the fingerprint of scene and environment picture.
/// Throws Error for a missing or damaged scene, and for one without triangles.
void load_sequence_scene(Sequence& sequence, int threads);

}  // namespace petrichor::cli

#endif
