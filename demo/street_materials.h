#ifndef PETRICHOR_DEMO_STREET_MATERIALS_H
#define PETRICHOR_DEMO_STREET_MATERIALS_H

#include "demo/street.h"
#include "demo/street_parts.h"

namespace petrichor::demo {

/// Generates the textures of the street (in parallel) and appends one material a slot, in the order
/// of Slot, to the scene. The kit's builders get the tile sizes, its cobble height the relief.
void add_street_materials(const DemoOptions& options, scene::Scene& scene, Kit& kit);

}  // namespace petrichor::demo

#endif
