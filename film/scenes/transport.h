#ifndef PETRICHOR_FILM_SCENES_TRANSPORT_H
#define PETRICHOR_FILM_SCENES_TRANSPORT_H

#include <memory>
#include <string>
#include <vector>

#include "base/interrupted.h"
#include "film/data/content_cache.h"
#include "scene/patches/patches.h"
#include "scene/patches/radiosity.h"
#include "scene/patches/surfaces.h"
#include "scene/scene.h"

namespace petrichor::film {

/// What a scene's surfaces send each other, whatever the weather and the hour.
struct SceneTransport {
    scene::Patches patches;
    std::vector<scene::PatchSurface> surfaces;  ///< a leaf each, dry
    bool kept = false;                          ///< all of it was found in the cache
    double seconds = 0.0;
    std::vector<std::string> notes;  ///< what a user should know: textures that could not be read
};

struct TransportOptions {
    scene::PatchOptions patches = {};  ///< threads, progress and stop are read too
    ContentCache cache{};              ///< patches are kept here; the default keeps nothing
};

/// Cuts a scene into patches and traces what they see, or finds that in the cache under the
/// fingerprint of positions, sides, holes and options. The scene must still hold its encoded images.
/// An image that cannot be decoded counts as opaque and white, with a note.
SceneTransport prepare_transport(const scene::Scene& scene, const TransportOptions& options);

/// Alpha of the textures that cut holes, by texture index; empty entries for all others.
std::vector<scene::AlphaImage> alpha_images(const scene::Scene& scene,
                                            std::vector<std::string>& notes);

}  // namespace petrichor::film

#endif
