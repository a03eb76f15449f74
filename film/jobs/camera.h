#ifndef PETRICHOR_FILM_JOBS_CAMERA_H
#define PETRICHOR_FILM_JOBS_CAMERA_H

#include <glm/glm.hpp>
#include <vector>

#include "film/scenario/scenario.h"
#include "scene/scene.h"

namespace petrichor::film {

/// Where the detail of a scene is.
struct Framing {
    scene::Bounds bounds;
    std::vector<glm::vec3> points;  ///< vertices inside the bounds, m: a few thousand, evenly taken; may be empty
};

/// Where the detail of a scene is: its bounds, or, when they are much larger because of a few far
/// points (an endless ground plane, a sky dome), the bounds of the middle 96 % of its vertices on
/// each axis.
scene::Bounds content_bounds(const scene::Scene& scene);
Framing framing_of(const scene::Scene& scene);

/// A camera that looks from the front right and above (three-quarter view): at a thing from 20 degrees, as near as all
/// of its bounds allow. A land (wide and low: 40 m, height at most 0.15 of it) is taken from among it, with its horizon
/// in the upper fifth of the picture: three quarters of its points are seen around their middle, or more where something
/// stands in the camera's place. aspect = width / height. Empty bounds are taken as 1 m around the origin.
scene::Camera framing_camera(const Framing& framing, double aspect);

/// A camera at a place that looks at a point, +y up (or -z when it looks straight up or down).
scene::Camera camera_towards(const glm::dvec3& position_m, const glm::dvec3& look_at_m,
                             double fov_rad);

/// The camera of a moment: the scenario's own path, else the named camera of the scene, else its
/// first one, else a framing camera. Throws Error when the name does not exist.
scene::Camera camera_at(const ScenarioCamera& camera, const scene::Scene& scene,
                        const Framing& framing, double aspect, double time_s);

}  // namespace petrichor::film

#endif
