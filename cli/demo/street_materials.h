#ifndef PETRICHOR_CLI_DEMO_STREET_MATERIALS_H
#define PETRICHOR_CLI_DEMO_STREET_MATERIALS_H

#include "cli/demo/street.h"
#include "cli/demo/street_parts.h"

namespace petrichor::cli {

/// Generates the textures of the street (in parallel) and appends one material a slot, in the order
/// of Slot, to the scene. The kit's builders get the tile sizes, its cobble height the relief.
void add_street_materials(const DemoOptions& options, gpu::Scene& scene, Kit& kit);

}  // namespace petrichor::cli

#endif
