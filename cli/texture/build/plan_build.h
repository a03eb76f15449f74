#ifndef PETRICHOR_CLI_TEXTURE_BUILD_PLAN_BUILD_H
#define PETRICHOR_CLI_TEXTURE_BUILD_PLAN_BUILD_H

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "texproc/material/plan.h"

namespace petrichor::cli {

/// What the command line says over the recipes.
struct BuildChoice {
    std::vector<std::string> engines;
    std::string rule, quality, format;  ///< empty: as the recipe says
    std::string wrap;                   ///< wrap, clamp, mirror; empty: as the recipe says
    std::string normal_green;           ///< up, down; empty: as the recipe says
    int size = 0;
    int lobes = 0;  ///< 1 or 2; 0: as the recipe says
    std::optional<float> rdo, rdo_most;  ///< of all outputs in blocks; none: as the recipe says
    bool no_score = false;
};

/// Everything that `inputs` (recipes and folders) ask for, in order. Reads recipes and the names of
/// files, no pixels. Throws Error for a bad recipe, a map that does not exist, a material without
/// outputs, and two outputs of one name.
std::vector<texproc::PlannedMaterial> plan_build(const std::vector<std::filesystem::path>& inputs,
                                                 const BuildChoice& choice);

/// The same for materials whose maps are known, as those of a scene.
std::vector<texproc::PlannedMaterial> plan_materials(
    const std::vector<texproc::MaterialFiles>& materials, const BuildChoice& choice);

}  // namespace petrichor::cli

#endif
