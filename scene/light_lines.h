#ifndef PETRICHOR_SCENE_LIGHT_LINES_H
#define PETRICHOR_SCENE_LIGHT_LINES_H

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace petrichor::scene {

/// The shape of a light as lines in the world, metres, each a run of points: of a sphere three great
/// circles, of a tube its ends and sides, of a disc or rectangle its edge and which way it faces, of a spot
/// the cone of its outer angle, of a point a cross. `size_m` is that of what has no size of its own: the
/// arms of a cross, the length of a cone without a range. Directional lights have none.
std::vector<std::vector<glm::vec3>> light_lines(const Light& light, float size_m = 0.25f);

}  // namespace petrichor::scene

#endif
