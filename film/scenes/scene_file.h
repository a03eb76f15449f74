#ifndef PETRICHOR_FILM_SCENES_SCENE_FILE_H
#define PETRICHOR_FILM_SCENES_SCENE_FILE_H

#include <filesystem>
#include <string>
#include <vector>

#include "gpu/renderer.h"
#include "scene/animation/settle.h"
#include "scene/scene.h"

namespace petrichor::film {

/// A scene from disk with the fingerprint of every byte that it is made of.
struct LoadedScene {
    scene::Scene scene;
    std::string fingerprint;
    std::vector<std::string> notes = {};  ///< which of its animations play
};

struct SceneFileOptions {
    bool allow_outside = false;
    std::string variant = {};  ///< of KHR_materials_variants; empty: the file's own materials
    scene::Playing playing = {.animation = "none"};
};

/// Reads a .glb or .gltf file; files that it names are looked for in its folder and nowhere else: a
/// link there may not lead out of it, unless `allow_outside`. Only regular files are opened, of at
/// most 4 GiB. Throws Error when the file or one that it names is missing or damaged.
LoadedScene read_scene(const std::filesystem::path& file, const SceneFileOptions& options = {});

/// Fingerprint of the bytes of a file. Throws Error when it cannot be read.
std::string file_fingerprint(const std::filesystem::path& file);

}  // namespace petrichor::film

#endif
