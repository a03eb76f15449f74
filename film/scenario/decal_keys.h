#ifndef PETRICHOR_FILM_SCENARIO_DECAL_KEYS_H
#define PETRICHOR_FILM_SCENARIO_DECAL_KEYS_H

#include <string>
#include <vector>

#include "film/scenario/scenario.h"
#include "film/toml/toml_value.h"

namespace petrichor::film {

/// The keys of [decals."name"].
std::vector<ScenarioKey> decal_keys();

/// Reads the tables under [decals], in the order of the file. Throws Error for an unknown key and for a
/// value of the wrong type or out of its range.
std::vector<ScenarioDecal> read_decals(const toml::table& decals, const std::string& file);

}  // namespace petrichor::film

#endif
