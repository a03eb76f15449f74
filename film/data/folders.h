#ifndef PETRICHOR_FILM_DATA_FOLDERS_H
#define PETRICHOR_FILM_DATA_FOLDERS_H

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace petrichor::film {

/// The project's data (scenarios, weather presets): PETRICHOR_DATA when set, else found from where
/// the program lies, in a source tree (data/) or installed (share/petrichor/). None when not there.
std::optional<std::filesystem::path> find_data_folder();

/// The same; throws Error when there is none.
std::filesystem::path data_folder();

/// Creates the folder where needed and tries to write in it. Throws Error that names it when not
/// possible.
void require_writable_folder(const std::filesystem::path& folder);

/// A lighting model as a renderer takes it: a file NAME.glsl is looked for in `folder`, then among
/// the shaders of the data; any other name stays what it is, and a
/// file that is nowhere is named in `folder`, for the message that refuses it.
std::string find_lighting_model(const std::string& name, const std::filesystem::path& folder);

/// Names (without .toml) of the files in data/<kind>, sorted; empty without a data folder.
std::vector<std::string> preset_names(const std::string& kind);

}  // namespace petrichor::film

#endif
