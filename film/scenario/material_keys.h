#ifndef PETRICHOR_FILM_SCENARIO_MATERIAL_KEYS_H
#define PETRICHOR_FILM_SCENARIO_MATERIAL_KEYS_H

#include <string>
#include <vector>

#include "film/scenario/scenario.h"
#include "film/toml/toml_value.h"
#include "scene/material_table.h"
#include "scene/scene.h"

namespace petrichor::film {

/// The keys of [materials."glob"]: one for each row of scene/material_table.h, by its name, one for
/// each of its texture slots, and lighting_model.
std::vector<ScenarioKey> material_keys();

/// Reads the tables under [materials]. Throws Error for an unknown key and for a value of the wrong
/// type or out of the row's range.
std::vector<MaterialOverride> read_material_overrides(const toml::table& materials,
                                                      const std::string& file);

struct AppliedOverrides {
    std::vector<std::string> unmatched;  ///< globs that match no material, with a hint, for the log
    std::string textures;  ///< fingerprint of the textures' files; "" without
};

/// Applies the overrides in the order of the file (a later one wins); what has keys over time gets
/// its first. Files they name are looked for in `folder`; textures are read now, are added to the
/// scene's and keep the coordinates and the wrapping of what they replace. Throws Error for one
/// that cannot be read.
AppliedOverrides apply_material_overrides(const std::vector<MaterialOverride>& overrides,
                                          const std::filesystem::path& folder,
                                          scene::Scene& scene);

/// The values of a moment of all that has keys over time: by material, then by name.
std::vector<scene::MaterialChange> material_changes(const std::vector<MaterialOverride>& overrides,
                                                    const std::vector<scene::Material>& materials,
                                                    double time_s);

}  // namespace petrichor::film

#endif
