#ifndef PETRICHOR_CLI_TEXTURE_BUILD_BUILD_SCENE_H
#define PETRICHOR_CLI_TEXTURE_BUILD_BUILD_SCENE_H

#include <filesystem>

#include "cli/texture/build/plan_build.h"

namespace petrichor::cli {

struct SceneBuild {
    std::filesystem::path in, out;
    BuildChoice choice;
    bool fallback = false, dry_run = false;
    int threads = 0;
};

/// texture build of a .glb or .gltf: with an engine, the maps of its materials as that engine takes
/// them, into the folder `out`, true when all were made; else writes the scene again with
/// prefiltered KTX2 textures and prints what was made, and how its materials shimmered before and
/// after.
bool build_scene(const SceneBuild& build);

}  // namespace petrichor::cli

#endif
