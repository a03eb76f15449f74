#ifndef PETRICHOR_FILM_SCENARIO_LAMP_KEYS_H
#define PETRICHOR_FILM_SCENARIO_LAMP_KEYS_H

#include <string>
#include <vector>

#include "film/scenario/scenario.h"
#include "film/toml/toml_value.h"

namespace petrichor::film {

/// The keys of [lamps."glob"]: one for each row of scene/light_shape.h, colour, intensity, reach and the
/// distribution or picture before the lamp.
std::vector<ScenarioKey> lamp_keys();

/// Reads the tables under [lamps]. Throws Error for an unknown key and for a value of the wrong type or
/// out of its range.
std::vector<LampOverride> read_lamp_overrides(const toml::table& lamps, const std::string& file);

}  // namespace petrichor::film

#endif
