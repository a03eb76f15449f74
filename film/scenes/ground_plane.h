#ifndef PETRICHOR_FILM_SCENES_GROUND_PLANE_H
#define PETRICHOR_FILM_SCENES_GROUND_PLANE_H

#include "scene/scene.h"

namespace petrichor::film {

/// Whether a scene stands on ground of its own: surfaces that face up fill at least four fifths of the
/// rectangle around it, and it is at least twice as wide as high.
bool brings_ground(const scene::Scene& scene, const scene::Bounds& content);

/// Lays level ground below a scene, out to the horizon, as a backdrop. Water and snow lie on it as on
/// any material; it is asphalt of some years (texproc/generate). The material is named "default ground".
void add_ground(scene::Scene& scene, const scene::Bounds& content);

}  // namespace petrichor::film

#endif
