#ifndef PETRICHOR_TEXPROC_MATERIAL_IMPORT_SETTINGS_H
#define PETRICHOR_TEXPROC_MATERIAL_IMPORT_SETTINGS_H

#include <filesystem>
#include <string>
#include <vector>

#include "texproc/material/plan.h"

namespace petrichor::texproc {

/// What an engine takes a texture for.
enum class TextureUse {
    Color,   ///< sRGB
    Normal,  ///< nothing but normals
    Grey,    ///< one channel of data
    Mask,    ///< several channels of data
};
TextureUse use_of(const PlannedOutput& output);
const char* name_of(TextureUse use);  ///< "color", "normal", "grey", "mask"

/// The settings file that OutputRule::import asks for beside a texture file, as its engine reads
/// it:
///
///   unity   FILE.meta. DDS goes through IHVImageFormatImporter, which keeps formats and mips and
///           knows sRGB and wrapping; png, tga, tif and exr through TextureImporter, which makes
///           its own mips and has a type for normals. The GUID is a hash of the name of the file:
///           the same after every build, so what refers to the asset keeps it.
///   godot   FILE.import for png, tga and exr, which Godot compresses itself. It loads DDS as it
///           is, without one.
///
/// Empty where the engine takes the file without. `file` is its name below the output folder.
std::string import_settings(const PlannedOutput& output, const std::string& file,
                            const MipOptions& edges);

/// Writes those of some files of an output below `folder`; returns their names.
std::vector<std::string> write_import_settings(const std::filesystem::path& folder,
                                               const PlannedOutput& output,
                                               const std::vector<std::string>& files,
                                               const MipOptions& edges);

}  // namespace petrichor::texproc

#endif
