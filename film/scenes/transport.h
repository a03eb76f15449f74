#ifndef PETRICHOR_FILM_SCENES_TRANSPORT_H
#define PETRICHOR_FILM_SCENES_TRANSPORT_H

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/content_cache.h"
#include "base/interrupted.h"
#include "gpu/frame/patch_scene.h"
#include "scene/patches/patches.h"
#include "scene/patches/radiosity.h"
#include "scene/patches/surfaces.h"
#include "scene/patches/triangles.h"
#include "scene/scene.h"

namespace petrichor::film {

/// What a scene's surfaces send each other, whatever the weather and the hour.
struct SceneTransport {
    scene::Patches patches;
    std::vector<scene::PatchSurface> surfaces;  ///< a leaf each, dry
    std::string key;  ///< fingerprint of what rays see and of the options
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

/// The same with what the scene's lamps reach and where its glowing surfaces shine, as the renderer
/// wants it; one note says what was chosen and how long it took. Surfaces within half a metre of a
/// lamp do not glow: a lantern's glass and the lamp in it are the same light.
std::shared_ptr<gpu::PatchScene> prepare_patch_scene(const scene::Scene& scene,
                                                     const TransportOptions& options,
                                                     std::vector<std::string>& notes);

/// Of patches that are there already; what was traced or found is not noted.
std::shared_ptr<gpu::PatchScene> prepare_patch_scene(const scene::Scene& scene, SceneTransport transport,
                                                     const TransportOptions& options,
                                                     std::vector<std::string>& notes);

/// Share 0..1 of all tracing, from what scene::PatchOptions::progress is told.
double traced_share(std::string_view stage, float share);

/// Fingerprint of all that rays meet in a scene: its triangles, and by their encoded bytes the images that
/// cut holes.
std::string what_rays_see(const scene::Scene& scene, const scene::Triangles& triangles);

/// Small pictures of the textures that patches are coloured by, by texture index.
std::vector<scene::ColorImage> color_images(const scene::Scene& scene, int threads,
                                            std::vector<std::string>& notes);

/// Alpha of the textures that cut holes, by texture index; empty entries for all others.
std::vector<scene::AlphaImage> alpha_images(const scene::Scene& scene,
                                            std::vector<std::string>& notes);

}  // namespace petrichor::film

#endif
