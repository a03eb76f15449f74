#ifndef PETRICHOR_CLI_SCENE_BAKE_LIGHT_H
#define PETRICHOR_CLI_SCENE_BAKE_LIGHT_H

#include <string>

#include "cli/scene/scene_view.h"
#include "film/scenes/light_bake.h"

namespace CLI {
class App;
}

namespace petrichor::cli {

/// What is baked, and under which light.
struct BakeArguments {
    std::string what;  ///< empty: nothing
    film::BakeConditions light;
    int size = 512;
    int rays = 256;
    std::string named;  ///< the first of its options that was given; empty: none
};

/// Adds --bake and the options of its light.
void add_bake_options(CLI::App& command, BakeArguments& arguments);

/// Refuses what cannot be baked, and options of a bake without one.
void check_bake(const BakeArguments& arguments, const std::string& output);

/// Bakes into the folder; returns a line of the report for each file, and notes.
std::string bake_light_maps(const SceneView& view, const SceneViewOptions& options,
                            const BakeArguments& arguments, const std::string& folder);

}  // namespace petrichor::cli

#endif
