#ifndef PETRICHOR_FILM_SCENARIO_TAPS_H
#define PETRICHOR_FILM_SCENARIO_TAPS_H

#include <vector>

#include "film/scenario/scenario.h"
#include "film/toml/toml_value.h"

namespace petrichor::film {

/// Reads [[ground.tap]]. Throws Error for unknown keys, values out of range and taps without a
/// place or a flow.
std::vector<ScenarioTap> read_taps(const TomlValue& value);

/// Reads [[ground.drain]]: x, z and radius, m. Throws Error likewise.
std::vector<glm::dvec3> read_drains(const TomlValue& value);

}  // namespace petrichor::film

#endif
