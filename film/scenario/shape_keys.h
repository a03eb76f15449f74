#ifndef PETRICHOR_FILM_SCENARIO_SHAPE_KEYS_H
#define PETRICHOR_FILM_SCENARIO_SHAPE_KEYS_H

#include <string>
#include <vector>

#include "film/scenario/scenario.h"
#include "film/toml/toml_value.h"

namespace petrichor::film {

/// The keys of [shapes."name"].
std::vector<ScenarioKey> shape_keys();

/// Shapes of this kind have the key.
bool has_key(int kind, const std::string& key);

/// Reads the tables under [shapes], in the order of the file. Throws Error for an unknown key or kind, and for a
/// value of the wrong type or out of its range. What does not fit its kind is refused when the scene is loaded.
std::vector<ScenarioShape> read_shapes(const toml::table& shapes, const std::string& file);

}  // namespace petrichor::film

#endif
