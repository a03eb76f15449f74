#ifndef PETRICHOR_FILM_SCENES_SHAPES_H
#define PETRICHOR_FILM_SCENES_SHAPES_H

#include <string>
#include <vector>

#include "film/scenario/scenario.h"

namespace petrichor::film {

/// Puts the shapes of [shapes] into the scene, as they are at 0 s; a material that it does not have is added, for
/// [materials."glob"] to describe. Call it before those are applied and before bounds are asked for. Throws Error
/// for a table without a kind, for a key or a count that its kind does not have and for a material that nothing
/// describes. Returns a fingerprint; "" without any.
std::string add_shapes(const std::vector<ScenarioShape>& shapes, const std::vector<MaterialOverride>& materials,
                       scene::Scene& scene);

/// After materials were described. Throws Error for one that no shape can show (scene/shapes.h).
void check_shapes(const scene::Scene& scene);

/// Where they are at a moment; empty when none ever is elsewhere.
std::vector<scene::ShapeMoment> shape_moments(const std::vector<ScenarioShape>& shapes, const scene::Scene& scene,
                                              double time_s);

}  // namespace petrichor::film

#endif
