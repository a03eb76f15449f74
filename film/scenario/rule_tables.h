// Keys by their tables, each in a file of its own.
#ifndef PETRICHOR_FILM_SCENARIO_RULE_TABLES_H
#define PETRICHOR_FILM_SCENARIO_RULE_TABLES_H

#include <vector>

#include "film/scenario/rules.h"

namespace petrichor::film {

std::vector<Rule> scene_rules();  ///< [scene]
std::vector<Rule> camera_rules();  ///< [camera]
std::vector<Rule> sky_rules();  ///< [sun], [sky], [moon], [fog]
std::vector<Rule> weather_rules();  ///< [weather]
std::vector<Rule> light_rules();  ///< [lights]
std::vector<Rule> ground_rules();  ///< [ground]
std::vector<Rule> render_rules();  ///< [render]
std::vector<Rule> output_rules();  ///< [output]

}  // namespace petrichor::film

#endif
