#ifndef PETRICHOR_SCENE_BASINS_BASIN_MAP_H
#define PETRICHOR_SCENE_BASINS_BASIN_MAP_H

#include <span>

#include "base/image.h"
#include "scene/basins/hierarchy.h"

namespace petrichor::scene {

/// What the hollows of a scene look like from above, for people: linear RGB, one pixel a cell, row
/// 0 at the least z (north, where -z is north). Ground is grey and lit from the north-west; the
/// area that drains into a hollow of more than a litre is tinted, a hue a pit; water is blue, the
/// deeper the darker (5 cm and more: full). Voids are black, solid cells brown.
///   level_m  of levels_m; empty: as after rain without end
///   throws   Error when the scene has no ground
Image basin_map(const HeightField& field, const Basins& basins,
                std::span<const float> level_m = {});

}  // namespace petrichor::scene

#endif
