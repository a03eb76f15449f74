#ifndef PETRICHOR_GPU_PASSES_FALLING_SPLASHES_H
#define PETRICHOR_GPU_PASSES_FALLING_SPLASHES_H

#include <vector>

#include "gpu/passes/falling/falling_field.h"

namespace petrichor::gpu {

/// Drops that have just hit something near the camera, as points at about the height of the ground;
/// the shader moves them along the fall to what they hit. Stateless as falling_drops. The larger ones hit where and when
/// rings of the frame's rain begin (formulas/weather/drop_births.h), as many as half of those; for the rest each
/// cell of the ground and fiftieth of a second has its own.
std::vector<shared::FallingSplash> falling_splashes(const FallingPlan& plan, const Frame& frame,
                                                    const FallingView& view,
                                                    const std::vector<Light>& lamps);

}  // namespace petrichor::gpu

#endif
