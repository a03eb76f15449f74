#ifndef PETRICHOR_TEXPROC_MATERIAL_PLAN_H
#define PETRICHOR_TEXPROC_MATERIAL_PLAN_H

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "texproc/material/recipe.h"

namespace petrichor::texproc {

/// The role of a texture that no map is given for: the second lobe of a texel, RGBA as
/// formulas/light/second_lobe.h reads it.
inline constexpr const char* kSecondLobe = "second_lobe";

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

/// What a recipe makes of the maps of a material: outputs whose maps are not there are left out.
/// Reads no pixels. Throws Error for a map that does not exist.
PlannedMaterial plan_material(const MaterialFiles& files,
                              const std::shared_ptr<const Recipe>& recipe);

/// Throws Error when two materials have one name, or two outputs are one file.
void check_output_names(const std::vector<PlannedMaterial>& plan);

/// The plan for people: sources, outputs, channels.
std::string to_text(const PlannedMaterial& material);

}  // namespace petrichor::texproc

#endif
