#ifndef PETRICHOR_FILM_SCENES_SCENE_PROBES_H
#define PETRICHOR_FILM_SCENES_SCENE_PROBES_H

#include <filesystem>
#include <string>
#include <vector>

#include "film/scenario/scenario.h"
#include "film/scenes/transport.h"

namespace petrichor::film {

/// The reflection probes of a scene, traced or found in the cache. `made` holds its patches and surfaces.
/// The scene must still hold its encoded images. One that stands inside a body is kept, with a note.
/// Pictures of probes lie below `folder`.
std::vector<scene::TracedProbe> prepare_probes(const scene::Scene& scene,
                                               const gpu::PatchScene& made,
                                               const ScenarioProbes& wanted,
                                               const std::filesystem::path& folder,
                                               const TransportOptions& options,
                                               std::vector<std::string>& notes);

}  // namespace petrichor::film

#endif
