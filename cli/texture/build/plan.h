#ifndef PETRICHOR_CLI_TEXTURE_BUILD_PLAN_H
#define PETRICHOR_CLI_TEXTURE_BUILD_PLAN_H

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/texture/build/recipe.h"

namespace petrichor::cli {

struct PlannedOutput {
    OutputRule rule;
    std::string stem;                ///< relative to the output folder, without extension
    std::vector<std::string> roles;  ///< roles that its channels take, each once
    bool prefiltered = false;        ///< some of its levels come from the prefilter
    std::string file() const { return stem + "." + rule.format; }
};

/// One material and what will be made of it.
struct PlannedMaterial {
    std::string name;  ///< with its folder: "walls/brick"
    MaterialFiles files;
    std::shared_ptr<const Recipe> recipe;
    std::vector<PlannedOutput> outputs;
    std::vector<std::string>
        left_out;                    ///< outputs whose maps are not there: "FILE: there is no ROLE"
    std::vector<std::string> baked;  ///< roles made from other maps
};

/// What the command line says over the recipes.
struct BuildChoice {
    std::vector<std::string> engines;
    std::string rule, quality, format;  ///< empty: as the recipe says
    int size = 0;
    bool no_score = false;
};

/// Everything that `inputs` (recipes and folders) ask for, in order. Reads recipes and the names of
/// files, no pixels. Throws Error for a bad recipe, a map that does not exist, a material without
/// outputs, and two outputs of one name.
std::vector<PlannedMaterial> plan_build(const std::vector<std::filesystem::path>& inputs,
                                        const BuildChoice& choice);

/// The plan for people: sources, outputs, channels.
std::string to_text(const PlannedMaterial& material);

}  // namespace petrichor::cli

#endif
