#ifndef PETRICHOR_FILM_SCENARIO_LOOK_KEYS_H
#define PETRICHOR_FILM_SCENARIO_LOOK_KEYS_H

#include <cstddef>
#include <string>
#include <vector>

#include "film/scenario/scenario.h"
#include "formulas/weather/moment.h"

namespace petrichor::film {

/// A key of [look]: a field of shared::WeatherLook. Each is keyed; a new one is a field and a row.
struct LookKey {
    std::string name;
    std::size_t count = 1;  ///< numbers
    double low = 0.0;
    double high = 1.0;
    std::string example;  ///< the default, as TOML
    std::string meaning;
    std::size_t offset = 0;  ///< in WeatherLook, bytes
};
const std::vector<LookKey>& look_keys();

/// The look of a moment: the defaults, with what the scenario says.
shared::WeatherLook look_at(const ScenarioLook& look, double time_s);

}  // namespace petrichor::film

#endif
