#ifndef PETRICHOR_FILM_SCENES_DRIP_SCENE_H
#define PETRICHOR_FILM_SCENES_DRIP_SCENE_H

#include <memory>
#include <string>
#include <vector>

#include "base/content_cache.h"
#include "scene/drips/drip_points.h"

namespace petrichor::film {

/// Where water drips from the edges of a scene's solid things; leaves and lawns let none go. Found in the cache under
/// the fingerprint of all that rays meet. The scene must still hold its encoded images.
std::shared_ptr<const std::vector<scene::DripPoint>> prepare_drips(const scene::Scene& scene,
                                                                   const ContentCache& cache,
                                                                   std::vector<std::string>& notes);

}  // namespace petrichor::film

#endif
