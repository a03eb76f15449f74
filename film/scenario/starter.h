#ifndef PETRICHOR_FILM_SCENARIO_STARTER_H
#define PETRICHOR_FILM_SCENARIO_STARTER_H

#include <string>

namespace petrichor::film {

/// The text of a new scenario: every key with its meaning, those a beginner changes active, the
/// others commented out with a valid value. It parses as it stands.
///
///   all_active   true: nothing is commented out (for the test that every documented key is
///   accepted;
///                keys that exclude each other are then both there)
std::string starter_scenario(const std::string& name, const std::string& scene_file,
                             bool all_active = false);

}  // namespace petrichor::film

#endif
