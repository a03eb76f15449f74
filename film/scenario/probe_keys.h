#ifndef PETRICHOR_FILM_SCENARIO_PROBE_KEYS_H
#define PETRICHOR_FILM_SCENARIO_PROBE_KEYS_H

#include "film/scenario/scenario.h"
#include "film/toml/toml_value.h"

namespace petrichor::film {

/// Reads `probes` of [render]. Throws Error for unknown words and keys, values out of range, walls that a
/// probe does not stand between, and more probes than there may be.
ScenarioProbes read_probes(const TomlValue& value);

}  // namespace petrichor::film

#endif
