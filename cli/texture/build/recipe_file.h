#ifndef PETRICHOR_CLI_TEXTURE_BUILD_RECIPE_FILE_H
#define PETRICHOR_CLI_TEXTURE_BUILD_RECIPE_FILE_H

#include <filesystem>
#include <string>
#include <vector>

#include "texproc/material/recipe.h"

namespace petrichor::cli {

/// Reads a recipe; paths in it are relative to its folder. Throws Error with file and line.
texproc::Recipe read_recipe(const std::filesystem::path& file);

/// The outputs of an engine, from data/recipes/NAME.toml. Throws Error that lists the names.
std::vector<texproc::OutputRule> engine_outputs(const std::string& name);
/// Those of several, each in a folder of its own when there is more than one.
std::vector<texproc::OutputRule> engine_outputs(const std::vector<std::string>& names);

struct EngineInfo {
    std::string name, note;
    std::vector<texproc::OutputRule> outputs;
};
std::vector<EngineInfo> engines();

}  // namespace petrichor::cli

#endif
