#ifndef PETRICHOR_FILM_SCENARIO_RULES_H
#define PETRICHOR_FILM_SCENARIO_RULES_H

#include <vector>

#include "film/scenario/scenario.h"
#include "film/toml/toml_value.h"

namespace petrichor::film {

/// A key and what reading it does: the one place where a key is declared.
struct Rule {
    ScenarioKey key;
    void (*apply)(Scenario&, const TomlValue&);
};

/// The keys of the tables that have no table of rows of their own ([look], [materials]), in the
/// order in which they are documented.
const std::vector<Rule>& rules();

}  // namespace petrichor::film

#endif
