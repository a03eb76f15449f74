#ifndef PETRICHOR_FILM_SCENARIO_NODE_KEYS_H
#define PETRICHOR_FILM_SCENARIO_NODE_KEYS_H

#include <string>
#include <vector>

#include "film/scenario/scenario.h"
#include "film/toml/toml_value.h"

namespace petrichor::film {

/// The keys of [nodes."glob"].
std::vector<ScenarioKey> node_keys();

/// Reads the tables under [nodes], in the order of the file. Throws Error for an unknown key and for a
/// value of the wrong type or out of its range.
std::vector<NodeOverride> read_node_overrides(const toml::table& nodes, const std::string& file);

/// Gives the instances of nodes whose names match their own values; later tables win. Returns a warning
/// for every table that matches none.
std::vector<std::string> apply_node_overrides(const std::vector<NodeOverride>& overrides,
                                              scene::Scene& scene);

}  // namespace petrichor::film

#endif
