#ifndef PETRICHOR_CLI_TEXTURE_MAPS_MATERIAL_FILE_H
#define PETRICHOR_CLI_TEXTURE_MAPS_MATERIAL_FILE_H

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "texproc/generate/generate.h"

namespace petrichor::cli {

/// A material that is to be made, under its name.
struct NamedMaterial {
    std::string name;  ///< of its files: the kind's, or the preset's
    std::string kind;
    std::string note;
    texproc::MaterialRecipe recipe;
};

/// Reads a preset of a material:
///
///     kind = "asphalt"       # as in `petrichor texture generate --list`
///     note = "patched road"  # optional
///     color = "#6e6a64"      # optional: mean albedo as an sRGB colour
///     [parameters]           # each optional, in the units of --list
///     tile_m = 4
///     cracks = 0.8
///
/// Throws Error with file and line for anything else.
NamedMaterial read_material_file(const std::filesystem::path& file);

/// Names of the presets in data/materials.
std::vector<std::string> material_presets();

/// A kind, a preset of the project, or a file whose name ends in .toml. Throws Error that lists the names.
NamedMaterial named_material(const std::string& text);

/// Linear colour of "#rrggbb" or "#rgb". Throws Error.
glm::vec3 parse_color(std::string_view text, const std::string& what);

/// "name=value" of --set, checked against the kind when the material is made. Throws Error.
void set_parameter(texproc::MaterialRecipe& recipe, const std::string& assignment);

/// The preset that makes the material again (all its parameters, and its colour).
std::string material_file_text(const NamedMaterial& material);

}  // namespace petrichor::cli

#endif
