#ifndef PETRICHOR_FILM_SCENARIO_TRACKS_H
#define PETRICHOR_FILM_SCENARIO_TRACKS_H

#include <vector>

#include "film/scenario/scenario.h"
#include "film/toml/toml_value.h"

namespace petrichor::film {

/// Reads `tracks` of [ground]. Throws Error for unknown keys, values out of range and ways that
/// lead nowhere: less than two different points, and no node that goes.
std::vector<ScenarioTrack> read_tracks(const TomlValue& value);

}  // namespace petrichor::film

#endif
