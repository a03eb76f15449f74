#ifndef PETRICHOR_CLI_SCENE_SCENE_VIEW_H
#define PETRICHOR_CLI_SCENE_SCENE_VIEW_H

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/scene/ground_map.h"
#include "film/scenes/transport.h"
#include "scene/patches/lookup.h"
#include "scene/patches/tracer.h"
#include "scene/patches/triangles.h"
#include "scene/scene.h"

namespace petrichor::cli {

/// A scene as the program sees it: what light meets, cut into patches.
struct SceneView {
    std::unique_ptr<scene::Scene> scene;  ///< does not move: triangles point into it
    film::SceneTransport transport;
    std::unique_ptr<scene::Triangles> triangles;
    GroundView ground;         ///< where SceneViewOptions asked for it
    double cpu_seconds = 0.0;  ///< of patches, all threads
    /// What is close to them, lamps and glow: for fresh ones alone, since only renders want it.
    struct Close {
        std::size_t polygons = 0, sources = 0;
        double cpu_seconds = 0.0;
    };
    std::optional<Close> close;

    const scene::Patches& patches() const { return transport.patches; }
};

struct SceneViewOptions {
    std::string file;  ///< .glb, .gltf, or demo:street
    double cell_m = 0.0;
    int rays = 128;
    int threads = 0;
    bool fresh = false;  ///< neither looks into the cache nor writes to it
    bool quiet = false;  ///< no progress
    bool ground = true;  ///< hollows are found, while patches are
    bool holes = false;  ///< triangles know their holes: for rays of one's own
};

/// Reads the scene and its patches. Throws Error for a missing or damaged scene.
SceneView open_scene(const SceneViewOptions& options);

/// Level ground that the scene stands on: the height at which most upward surface lies.
struct Ground {
    bool found = false;
    double height_m = 0.0;
    double area_m2 = 0.0;  ///< upward, within half a metre of that height
    double share = 0.0;    ///< of all upward surface
};
Ground find_ground(const scene::Patches& patches);

/// What is worth knowing, in lines or as JSON.
std::string scene_report(const SceneView& view);
std::string scene_json(const SceneView& view);

}  // namespace petrichor::cli

#endif
