#ifndef PETRICHOR_CLI_RENDER_SCENARIO_INPUT_H
#define PETRICHOR_CLI_RENDER_SCENARIO_INPUT_H

#include <string>

#include "cli/rooms.h"
#include "film/scenario/scenario.h"

namespace petrichor::cli {

/// The scenario of a word on the command line: a .toml file, a scene (.glb, .gltf, demo:street)
/// with defaults around it, or the name of one of ours; "" is the demo.
///   what    the command, for messages
///   throws  Error when it is none of these, with the nearest name
Scenario scenario_of(const std::string& input, const std::string& what);

}  // namespace petrichor::cli

#endif
