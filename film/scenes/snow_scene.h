#ifndef PETRICHOR_FILM_SCENES_SNOW_SCENE_H
#define PETRICHOR_FILM_SCENES_SNOW_SCENE_H

#include <memory>
#include <string>
#include <vector>

#include "base/content_cache.h"
#include "base/interrupted.h"
#include "gpu/frame/weather_maps.h"
#include "scene/snow/snow_caps.h"

namespace petrichor::film {

/// What deep snow takes its shape from: the caps of a scene, fine near where cameras stand over the film.
/// What has gone through it has pressed it down. Found in the cache under the fingerprint of all this. The scene must still hold its encoded images. Adds notes:
/// how many triangles, and whether they are coarser than they should be. Throws Interrupted after a stop.
std::shared_ptr<const scene::SnowCaps> prepare_snow(const scene::Scene& scene,
                                                    const std::vector<glm::vec3>& eyes_m,
                                                    const gpu::TrackMap& tracks,
                                                    const ContentCache& cache, const StopRequest& stop,
                                                    std::vector<std::string>& notes);

}  // namespace petrichor::film

#endif
