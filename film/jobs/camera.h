#ifndef PETRICHOR_FILM_JOBS_CAMERA_H
#define PETRICHOR_FILM_JOBS_CAMERA_H

#include <glm/glm.hpp>

#include "film/scenario/scenario.h"
#include "scene/scene.h"

namespace petrichor::film {

/// Where the detail of a scene is: its bounds, or, when they are much larger because of a few far
/// points (an endless ground plane, a sky dome), the bounds of the middle 96 % of its vertices on
/// each axis.
scene::Bounds content_bounds(const scene::Scene& scene);

/// A camera that sees all of the bounds from the front right and above (three-quarter view), as
/// near as the frame allows: from 20 degrees, and what is wide and low (40 m, height at most 0.15 of it) from less,
/// with the horizon in the upper fifth of the picture. aspect = width / height. Empty bounds are taken as 1 m around the
/// origin.
scene::Camera framing_camera(const scene::Bounds& bounds, double aspect);

/// A camera at a place that looks at a point, +y up (or -z when it looks straight up or down).
scene::Camera camera_towards(const glm::dvec3& position_m, const glm::dvec3& look_at_m,
                             double fov_rad);

/// The camera of a moment: the scenario's own path, else the named camera of the scene, else its
/// first one, else a framing camera. Throws Error when the name does not exist.
scene::Camera camera_at(const ScenarioCamera& camera, const scene::Scene& scene,
                        const scene::Bounds& bounds, double aspect, double time_s);

}  // namespace petrichor::film

#endif
