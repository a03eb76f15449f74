#ifndef PETRICHOR_FILM_SCENARIO_MATERIAL_KEYS_H
#define PETRICHOR_FILM_SCENARIO_MATERIAL_KEYS_H

#include <string>
#include <vector>

#include "film/scenario/scenario.h"
#include "film/toml/toml_value.h"
#include "scene/scene.h"

namespace petrichor::film {

/// The keys of [materials."glob"]: one for each row of scene/material_table.h, by its name, and
/// lighting_model.
std::vector<ScenarioKey> material_keys();

/// Reads the tables under [materials]. Throws Error for an unknown key and for a value of the wrong
/// type or out of the row's range.
std::vector<MaterialOverride> read_material_overrides(const toml::table& materials,
                                                      const std::string& file);

/// Applies the overrides in the order of the file (a later one wins) and returns the globs that
/// match no material, with a hint, for the log. Files they name are looked for in `folder`.
std::vector<std::string> apply_material_overrides(const std::vector<MaterialOverride>& overrides,
                                                  const std::filesystem::path& folder,
                                                  std::vector<scene::Material>& materials);

}  // namespace petrichor::film

#endif
