#ifndef PETRICHOR_CLI_TEXTURE_MAPS_PACK_FILE_H
#define PETRICHOR_CLI_TEXTURE_MAPS_PACK_FILE_H

#include <filesystem>
#include <string>

#include "texproc/material/pack.h"

namespace petrichor::cli {

/// Reads a pack preset of one's own:
///
///     note = "R wetness, G occlusion"              # optional
///     channels = ["wetness | 0", "occlusion | 1"]  # 1 to 4, see `petrichor texture pack --help`
///     srgb = false                                 # optional: RGB holds sRGB colour
///
/// Throws Error with file and line for anything else.
texproc::PackPreset read_pack_file(const std::filesystem::path& file);

/// A preset of the project by name, or the one in a file whose name ends in .toml.
texproc::PackPreset pack_preset_or_file(const std::string& text,
                                        const std::filesystem::path& relative_to = {});

/// All roles that the channels of a preset name, each once, in order.
std::vector<std::string> preset_roles(const texproc::PackPreset& preset);

}  // namespace petrichor::cli

#endif
