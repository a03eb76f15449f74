#ifndef PETRICHOR_FILM_SCENES_DEMO_SCENE_H
#define PETRICHOR_FILM_SCENES_DEMO_SCENE_H

#include <string>

#include "base/content_cache.h"
#include "demo/street.h"
#include "film/scenes/scene_file.h"

namespace petrichor::film {

/// The street of the demo as a reader of its .glb file gets it. It is made once and kept in the
/// cache: with a cold, a warm or no cache the scene has the same bytes. A cache that cannot be
/// written is noted in the scene's warnings.
LoadedScene load_demo_street(const demo::DemoOptions& options, const ContentCache& cache);

/// The scene of a name: demo:street or demo:stage (demo/stage.h). Throws Error for another one that begins with demo:.
///
///   who  names the asker in the error
LoadedScene load_demo(const std::string& name, const demo::DemoOptions& options, const ContentCache& cache,
                      const std::string& who);

}  // namespace petrichor::film

#endif
